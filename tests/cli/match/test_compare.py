import csv
import io
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rows import each_of

COLUMNS = [*("format", "p_win_a", "from_even", "mean_games", "games_p90", "even_p1", "even_places")]


@pytest.fixture
def compare(ask):
    def answer(*words):
        told = ask("compare", *words)
        assert set(told) == {"formats", "crossings"}
        return told

    return answer


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
    assert list(table[0]) == COLUMNS
    # 9:5 alone is a time of day to a spreadsheet.
    assert [row["format"] for row in table] == ["race 9:5", "ahead 5:3", "race 3:1 of 3:3"]
    assert [row["even_places"] for row in table] == ["1", "1", "1"]
    never = ["--p1", "0.5", "--p2", "0.9", "--breaks", "alternate"]
    result = run("compare", *never, "5:1")
    (row,) = csv.DictReader(io.StringIO(result.stdout))
    assert (row["even_p1"], row["even_places"]) == ("", "0")


def test_plot(run, tmp_path):
    path = tmp_path / "formats.png"
    result = run("compare", *BREAKS, "9:7", "7:6", "--text", "--plot", str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes()[:4] == b"\x89PNG"


def test_the_usage_line_names_ratings_and_formats(run):
    assert "compare [OPTIONS] [A B] FORMAT..." in run("compare", "--help").stdout


@each_of(
    "line, named",
    [
        (["--p", "0.6"], "such as 9:5"),
        (["9:5"], "--p"),
        (["--p", "0.6", "9:x"], "'9:x'"),
        (["--p", "0.6", "9:5", "0:3"], "from 1 to 1000"),
        (["--p", "0.6", "9:5", "--wins"], "--wins"),
        (["-30", "0", "9:5", "-x"], "-x"),
        (["--p", "0.6", "7", "9"], "7:7"),
        (["612", "521", "9", "--scale", "fargo", "9:5"], "9:9"),
        (["--p", "0.6", "9:5", "-30"], "-30"),
        (["--p", "0.6", "best of 8"], "5:5"),
        (["612", "9:5"], "612"),
        (["--p", "0.6", "9:5 winner breaks"], "--p1 and --p2"),
        (["--p", "0.6", "9:5", "--hold", "p2"], "--hold"),
        (["--p1", "1", "--p2", "0.5", "--breaks", "winner", "--hold", "break", "9:5"], "--hold p2"),
        (["--p", "0.6", *["2:1"] * 8], "you gave 8"),
        (["--p", "0.6", "99:99 win by 2"], "9,801 possible scores"),
        ([*BREAKS, "2:2 of 40:40"], "1,600 possible scores"),
        ([*BREAKS, "200:200"], "40,000 possible scores"),
    ],
)
def test_wrong_use(refused, line, named):
    assert named in refused("compare", *line)


WORDS_OF_A_LINE = "--p 0.6 3:3 9:5 2:1 --hold break 30 -20 --p1 --p2 --breaks winner --json"
words = st.sampled_from([*WORDS_OF_A_LINE.split(), "ahead 2:3", "2:1 of 2:2"]) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("compare", *line).exit_code in (0, 2)
