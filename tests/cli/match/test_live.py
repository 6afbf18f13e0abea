import csv
import io
import json

import pytest
from evenbreak.cli.match.live_table import comeback_text
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.match.live import COLUMNS, OF_THE_TABLE
from evenbreak.games import Ahead, Race, Rack, winner_breaks
from evenbreak.matches import live_odds, race_win_probability


@pytest.fixture
def live(run):
    def ask(line):
        result = run("live", "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        answer = json.loads(result.stdout)
        assert set(answer) == {"now", "course", "comebacks", "schema_version"}
        return answer

    return ask


def rows(result):
    assert (result.exit_code, result.stderr) == (0, "")
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
    assert list(table[0]) == list(COLUMNS)
    assert [row["p_win_a"] for row in table] == ["0.250000", "0.500000", "0.000000"]
    assert table[-1]["leverage"] == ""
    table = rows(run("live", "--p", "0.5", "--race", "2:1", "--table"))
    assert list(table[0]) == list(OF_THE_TABLE)
    assert [(row["score_a"], row["score_b"], row["p_win_a"]) for row in table] == [
        ("0", "0", "0.250000"),
        ("1", "0", "0.500000"),
    ]


def test_racks_may_be_written_apart(run):
    together = run("live", "--p", "0.5", "--race", "3:3", "--racks", "abb").stdout
    assert run("live", "--p", "0.5", "--race", "3:3", "--racks", " A, b B").stdout == together


def test_the_table_with_breaks_in_words():
    race = Race(2, 1, Rack(0.6, 0.5), breaks=winner_breaks)
    assert comeback_text(race, live_odds(race)).splitlines() == [
        "A wins the match at each score with A to break, in %",
        "* is the score now",
        "",
        "         B 0",
        "  A 0  *36.0",
        "  A 1   60.0",
    ]


def test_the_table_of_leads_in_words():
    match = Ahead(2, 2, Rack(0.5))
    assert comeback_text(match, live_odds(match, [2])).splitlines()[1:] == [
        "* is the score now",
        "",
        "  B leads by 1  *25.0",
        "  level          50.0",
        "  A leads by 1   75.0",
    ]


def test_the_star_is_in_the_tables_that_have_the_score_now():
    def starred(winners, **match):
        odds = live_odds(played := Race(2, 2, **match), winners)
        return [
            part.count("*") == 2 for part in comeback_text(played, odds).split("A wins the")[1:]
        ]

    sets = Race(2, 2, Rack(0.5))
    assert starred([1], rack=sets) == [True, False]  # a set has begun
    assert starred([1, 1], rack=sets) == [True, True]  # and here the next one does
    broken = Rack(0.6, 0.5)
    assert starred([2], rack=broken, breaks=winner_breaks) == [False, True]


def test_the_table_comes_after_the_odds_and_the_course(run, monkeypatch):
    monkeypatch.setattr("evenbreak.cli.match.live.to_terminal", lambda: True)
    line = ("live", "--p", "0.6", "--race", "4:3", "--racks", "abb")
    alone, table = (run(*line, *more).stdout for more in ((), ("--table",)))
    assert table.startswith(alone.rstrip())
    assert "  A 1  *21.6\n" in table[len(alone) :]


def test_the_table_of_sets_in_words():
    match = Race(2, 2, Race(1, 2, Rack(0.5)))
    titles = [
        line for line in comeback_text(match, live_odds(match, [2])).splitlines() if "%" in line
    ]
    assert titles == [
        "A wins the match at each score of the set under way, in %",
        "A wins the match at each score in sets, as a set begins, in %",
    ]
    assert comeback_text(match, live_odds(match, [1, 1])).startswith("The match is over")


def test_wide_tables_are_cut_to_the_width_of_a_terminal():
    race = Race(4, 30, Rack(0.5))
    text = comeback_text(race, live_odds(race))
    assert max(map(len, text.splitlines())) <= 80
    assert text.count("A 0") == 3


def test_plot(run, tmp_path):
    path = tmp_path / "match.svg"
    result = run("live", "--p", "0.6", "--race", "3:3", "--racks", "abba", "--plot", str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert b"<svg" in path.read_bytes()


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        ("--p 0.6", "what is played is missing; give --race M:N or --ahead M:N"),
        ("--race 3:3", "who plays is missing"),
        ("--p 0.6 --race 3:3 --racks abc", "'c' is nobody; write a letter a rack, a or b"),
        ("--p 0.6 --race 2:2 --racks abba", "over after 3 of 4 racks, at 1:2; leave out"),
        ("--p 0.6 --race 3:3 --score 4:0", "cannot be reached"),
        ("--p 0.6 --race 3:3 --set-score 1:0", "there is no --set; leave it out"),
        ("--p 0.6 --race 3:3 --set 2:2 --set-score 2:0", "count it in the score"),
        ("--p 0.6 --race 3:3 --plot a.png", "give --racks, such as abbab"),
        ("--p 0.6 --race 3:3 --racks ab --plot a.gif", ".png or .svg"),
        ("--p 0.6 --race 200:200", "about 40,000 scores; ask for one with 10,000 at the most"),
        ("--p 0.6 --race 50:50 --set 9:9", "about 202,500 scores"),
        ("--p 0.6 --ahead 3:3 --win-by 2", "leave it out"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, line, remedy):
    result = run("live", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


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
