import csv
import io
import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.match.compare import COLUMNS, Compared, _advice, _turns
from evenbreak.cli.program import program
from evenbreak.games import Rack
from evenbreak.matches import crossings, match_format, match_odds


@pytest.fixture
def compare(run):
    def ask(*words):
        result = run("compare", "--json", *words)
        assert (result.exit_code, result.stderr) == (0, "")
        answer = json.loads(result.stdout)
        assert set(answer) == {"formats", "crossings", "schema_version"}
        return answer

    return ask


def test_negotiation_of_p5_8(compare):
    answer = compare("--p", str(2 / 3), "9:5", "3:1 of 3:3", "ahead 5:3")
    wins = {row["format"]: row["p_win_a"] for row in answer["formats"]}
    assert wins["9:5"] == pytest.approx(0.552, abs=0.0005)
    assert wins["3:1 of 3:3"] == pytest.approx(0.493, abs=0.0005)
    assert [row["format_2"] for row in answer["crossings"]] == ["3:1 of 3:3"] + ["ahead 5:3"] * 2


def test_curves_of_p5_7(compare):
    answer = compare("--p", "0.6", "2:1", "4:2")
    (found,) = answer["crossings"]
    assert found["points"][0]["p1"] == (1 + math.sqrt(17)) / 8
    assert found["better_for_a"] == ["2:1", "4:2"]
    assert found["exact"]
    assert answer["formats"][1]["even"][0]["p1"] == pytest.approx(0.6861898, abs=5e-8)


def test_ratings_may_stand_anywhere_between_the_formats(compare):
    right = compare("30", "-20", "5:3", "ahead 2:2")
    assert compare("5:3", "30", "ahead 2:2", "-20") == right
    assert [row["format"] for row in right["formats"]] == ["5:3", "ahead 2:2"]


BREAKS = ["--p1", "0.6", "--p2", "0.55", "--breaks", "winner"]


def test_break_formats_side_by_side(compare):
    answer = compare(*BREAKS, "7:7", "7:7 loser breaks", "7:7 alternate breaks")
    (win,) = {round(row["p_win_a"], 12) for row in answer["formats"]}
    assert win == pytest.approx(0.5906, abs=5e-5)
    assert [row["better_for_a"] for row in answer["crossings"]] == [[None]] * 3
    lengths = [row["mean_games"] for row in answer["formats"]]
    assert lengths == sorted(set(lengths), key=lengths.index)


def test_what_stays_as_p1_varies(compare):
    (at_p2,) = compare(*BREAKS, "9:7")["formats"][0]["even"]
    assert at_p2["p2"] == 0.55
    (at_break,) = compare(*BREAKS, "--hold", "break", "9:7")["formats"][0]["even"]
    odds = at_break["p1"] / (1 - at_break["p1"]) * at_break["p2"] / (1 - at_break["p2"])
    assert odds == pytest.approx(0.6 / 0.4 * 0.55 / 0.45)
    assert at_break["p_win_a"] == pytest.approx(0.5)


def test_csv_into_a_pipe(run):
    result = run("compare", "--p", "0.6", "9:5", "ahead 5:3", "3:1 of 3:3")
    table = list(csv.DictReader(io.StringIO(result.stdout)))
    assert list(table[0]) == list(COLUMNS)
    # 9:5 alone is a time of day to a spreadsheet.
    assert [row["format"] for row in table] == ["race 9:5", "ahead 5:3", "race 3:1 of 3:3"]
    assert [row["even_places"] for row in table] == ["1", "1", "1"]
    never = ["--p1", "0.5", "--p2", "0.9", "--breaks", "alternate"]
    result = run("compare", *never, "5:1")
    (row,) = csv.DictReader(io.StringIO(result.stdout))
    assert (row["even_p1"], row["even_places"]) == ("", "0")


@pytest.mark.parametrize(
    ("one", "two", "words"),
    [
        ("2:1", "4:2", "2:1 up to 0.6404, then 4:2"),
        ("4:2", "2:1", "2:1 up to 0.6404, then 4:2"),
        ("3:3", "3:2", "3:3, always"),
        ("1:1", "ahead 1:1", "the same for all"),
        ("ahead 6:1", "6:2", "6:2 up to 0.3106, ahead 6:1 up to 0.9372, then 6:2"),
    ],
)
def test_who_gains_in_words(one, two, words):
    assert _turns(crossings(one, two), one, two) == words


@pytest.mark.parametrize(
    ("texts", "words"),
    [
        (["1:1", "3:3"], "A is best off with 3:3; nearest to even: 1:1."),
        (["1:1", "ahead 1:1"], "all are worth the same to A."),
        (["1:1", "ahead 1:1", "4:1"], "best off with 1:1 and ahead 1:1; nearest to even: 1:1 and"),
    ],
)
def test_advice(texts, words):
    compared = [
        Compared(played, match_odds(played.match(Rack(0.6))), ())
        for played in map(match_format, texts)
    ]
    assert words in _advice(compared)


@pytest.mark.parametrize(
    "texts",
    [
        ["9:7", "9:7 alternate breaks", "7:6"],
        ["9:7 win by 2 of 3:3 alternate breaks", "ahead 6:1", "best of 3 of 15:14 loser breaks"],
    ],
)
def test_a_terminal_of_80_columns_holds_it(run, monkeypatch, texts):
    monkeypatch.setattr("evenbreak.cli.match.compare.to_terminal", lambda: True)
    lines = run("compare", *BREAKS, *texts).stdout.splitlines()
    assert max(map(len, lines)) <= 80


def test_plot(run, tmp_path):
    path = tmp_path / "formats.png"
    result = run("compare", *BREAKS, "9:7", "7:6", "--plot", str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes()[:4] == b"\x89PNG"


def test_the_usage_line_names_ratings_and_formats(run):
    assert program.name == "evenbreak"
    assert "compare [OPTIONS] [A B] FORMAT..." in run("compare", "--help").stdout


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        (["--p", "0.6"], "what is compared is missing; give formats such as 9:5"),
        (["9:5"], "missing"),
        (["--p", "0.6", "9:x"], "'9:x' is no match format; write 9:5"),
        (["--p", "0.6", "9:5", "0:3"], "from 1 to 1000"),
        (["--p", "0.6", "9:5", "--wins"], "No such option '--wins'"),
        (["-30", "0", "9:5", "-x"], "No such option '-x'"),
        (["--p", "0.6", "7", "9"], "7 was read as a rating; write 7:7 for a race to 7"),
        (["612", "521", "9", "--scale", "fargo", "9:5"], "9 was read as a rating; write 9:9"),
        (["--p", "0.6", "9:5", "-30"], "-30 was read as a rating; write 7:7 for a race to 7"),
        (["--p", "0.6", "best of 8"], "can end level; give an odd number, or write 5:5"),
        (["612", "9:5"], "612"),
        (["--p", "0.6", "9:5 winner breaks"], "only with --p1 and --p2; leave it out"),
        (["--p", "0.6", "9:5", "--hold", "p2"], "which are not given; leave it out"),
        (["--p1", "1", "--p2", "0.5", "--breaks", "winner", "--hold", "break", "9:5"], "--hold p2"),
        (["--p", "0.6", *["2:1"] * 8], "compare 7 at the most"),
        (["--p", "0.6", "99:99 win by 2"], "about 9,801 scores; compare such matches with 2,500"),
        ([*BREAKS, "2:2 of 40:40"], "about 1,600 scores; compare such matches with 900"),
        ([*BREAKS, "200:200"], "about 40,000 scores; compare such matches with 10,000"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, line, remedy):
    result = run("compare", *line)
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


WORDS_OF_A_LINE = "--p 0.6 3:3 9:5 2:1 --hold break 30 -20 --p1 --p2 --breaks winner --json"
words = st.sampled_from([*WORDS_OF_A_LINE.split(), "ahead 2:3", "2:1 of 2:2"]) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("compare", *line).exit_code in (0, 2)
