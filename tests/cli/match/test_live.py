import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.matches import race_win_probability
from rows import each_of

COURSE = [
    *("rack", "won_by", "score_a", "score_b", "set_a", "set_b", "next_break"),
    *("p_win_a", "p_win_b", "swing_a", "p_win_a_if_a", "p_win_a_if_b", "leverage"),
    *("mean_racks_left", "racks_left_p90"),
]
COMEBACKS = ["score_a", "score_b", "set_a", "set_b", "next_break", "p_win_a", "leverage"]


@pytest.fixture
def live(ask):
    def answer(line):
        told = ask("live", *line.split())
        assert set(told) == {"now", "course", "comebacks"}
        return told

    return answer


def rows(result):
    assert result.exit_code == 0
    return list(csv.DictReader(io.StringIO(result.stdout)))


def test_a_race_under_way(live):
    answer = live("--p 0.6 --race 7:5 --racks abbab")
    now = answer["now"]
    assert (now["score_a"], now["score_b"], now["rack"], now["won_by"]) == (2, 3, 5, "b")
    assert now["p_win_a"] == pytest.approx(race_win_probability(0.6, 5, 2))
    assert now["p_win_a_if_a"] == pytest.approx(race_win_probability(0.6, 4, 2))
    assert now["leverage"] == pytest.approx(now["p_win_a_if_a"] - now["p_win_a_if_b"])
    assert [row["won_by"] for row in answer["course"]] == [None, *"abbab"]
    assert len(answer["comebacks"]) == 5 * 2
    swings = [row["swing_a"] for row in answer["course"][1:]]
    assert sum(swings) == pytest.approx(now["p_win_a"] - answer["course"][0]["p_win_a"])


def test_the_score_and_racks_to_it_tell_the_same(live):
    by_racks = live("--p 0.6 --race 7:5 --racks abbab")["now"]
    by_score = live("--p 0.6 --race 7:5 --score 2:3")["now"]
    both = live("--p 0.6 --race 7:5 --score 1:2 --racks AB")["now"]
    for key in ("score_a", "score_b", "p_win_a", "leverage", "mean_racks_left", "racks_left_p90"):
        assert by_racks[key] == by_score[key] == both[key]


def test_the_break_goes_on_from_rack_to_rack(live):
    answer = live("--p1 0.7 --p2 0.6 --breaks alternate --first-break b --race 4:4 --racks aab")
    assert [row["next_break"] for row in answer["course"]] == ["b", "a", "b", "a"]


def test_sets_under_way(live):
    answer = live("--p 0.6 --set 3:2 --race 2:2 --score 1:0 --set-score 2:1 --racks ba")
    places = [
        (row["score_a"], row["score_b"], row["set_a"], row["set_b"]) for row in answer["course"]
    ]
    assert places == [(1, 0, 2, 1), (1, 1, 0, 0), (1, 1, 1, 0)]


def test_ratings_and_scales(live):
    now = live("30 0 --race 2:2")["now"]
    assert now["p_win_a"] == pytest.approx(race_win_probability(2 / 3, 2, 2))


def test_csv_into_a_pipe(run):
    table = rows(run("live", "--p", "0.5", "--race", "2:1", "--racks", "ab"))
    assert list(table[0]) == COURSE
    assert [row["p_win_a"] for row in table] == ["0.250000", "0.500000", "0.000000"]
    assert table[-1]["leverage"] == ""
    table = rows(run("live", "--p", "0.5", "--race", "2:1", "--comebacks"))
    assert list(table[0]) == COMEBACKS
    assert [(row["score_a"], row["score_b"], row["p_win_a"]) for row in table] == [
        ("0", "0", "0.250000"),
        ("1", "0", "0.500000"),
    ]


def test_racks_may_be_written_apart(run):
    together = run("live", "--p", "0.5", "--race", "3:3", "--racks", "abb").stdout
    assert run("live", "--p", "0.5", "--race", "3:3", "--racks", " A, b B").stdout == together


def test_plot(run, tmp_path):
    path = tmp_path / "match.svg"
    line = ["live", "--p", "0.6", "--race", "3:3", "--racks", "abba", "--text", "--plot"]
    result = run(*line, str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert b"<svg" in path.read_bytes()


@each_of(
    "line, named",
    [
        ("--p 0.6", "--race"),
        ("--race 3:3", "--p"),
        ("--p 0.6 --race 3:3 --racks abc", "'c'"),
        ("--p 0.6 --race 2:2 --racks abba", "3 of 4 racks, at 1-2"),
        ("--p 0.6 --race 3:3 --score 4:0", "4-0"),
        ("--p 0.6 --race 3:3 --set-score 1:0", "--set-score"),
        ("--p 0.6 --race 3:3 --set 2:2 --set-score 2:0", "2-0"),
        ("--p 0.6 --race 3:3 --plot a.png", "--racks"),
        ("--p 0.6 --race 3:3 --racks ab --plot a.gif", ".png or .svg"),
        ("--p 0.6 --race 200:200", "40,000 possible scores"),
        ("--p 0.6 --race 50:50 --set 9:9", "202,500 possible scores"),
        ("--p 0.6 --ahead 3:3 --win-by 2", "--win-by"),
    ],
)
def test_wrong_use(refused, line, named):
    assert named in refused("live", *line.split())


def test_the_end_of_a_long_race_is_short(live):
    now = live("--p 0.5 --race 1000:1000 --score 990:995")["now"]
    assert now["p_win_a"] == pytest.approx(race_win_probability(0.5, 10, 5))


WORDS_OF_A_LINE = (
    "--p 0.6 --race 3:3 --ahead 2:2 --set 2:1 --score 1:0 --set-score --racks ab bba --table "
    "--p1 --p2 --breaks winner 0.5 -1 --json"
)
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=9))
def test_no_words_make_a_traceback(run, line):
    assert run("live", *line).exit_code in (0, 2)
