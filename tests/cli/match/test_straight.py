import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.matches import StraightPool, straight_pool_odds
from evenbreak.stats import shot_chance

QUANTITIES = [
    "p_make_a",
    "p_make_b",
    "safety",
    "points_a",
    "points_b",
    "p_win_a",
    "p_win_b",
    "p_never_ends",
    "mean_innings",
    "sd_innings",
    "innings_p50",
    "innings_p90",
    "even_points_a",
    "even_points_b",
    "p_win_a_even",
]


@pytest.fixture
def straight(run):
    def ask(line):
        result = run("straight", "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        answer = json.loads(result.stdout)
        assert list(answer) == [*QUANTITIES, "schema_version"]
        return answer

    return ask


def test_averages(straight):
    answer = straight("9 4 --points 100")
    odds = straight_pool_odds(StraightPool(100, 100, 0.9, 0.8))
    assert (answer["p_make_a"], answer["p_make_b"]) == (0.9, 0.8)
    assert (answer["p_win_a"], answer["p_win_b"]) == (odds.p_win_1, odds.p_win_2)
    assert (answer["mean_innings"], answer["sd_innings"]) == (odds.mean_innings, odds.sd_innings)
    assert (answer["innings_p50"], answer["innings_p90"]) == (odds.innings_p50, odds.innings_p90)
    assert straight("--p1 0.9 --p2 0.8 --points 100:100") == answer


def test_the_stronger_keeps_his_points_in_the_even_match(straight):
    one = straight("9 4 --points 100:80 --first b")
    assert one["even_points_a"] == 100
    assert one["even_points_b"] < 80
    other = straight("4 9 --points 80:100 --first a")
    assert (other["even_points_a"], other["even_points_b"]) == (one["even_points_b"], 100)
    assert other["p_win_a_even"] == pytest.approx(1 - one["p_win_a_even"])
    again = straight(f"9 4 --points 100:{one['even_points_b']} --first b")
    assert again["p_win_a"] == one["p_win_a_even"] == pytest.approx(0.5, abs=0.03)


def test_safety_and_first(straight):
    answer = straight("24 19 --points 150 --safety 0.7 --first b")
    p_a, p_b = shot_chance(24, 0.7), shot_chance(19, 0.7)
    odds = straight_pool_odds(StraightPool(150, 150, p_a, p_b, safety_1=0.7, safety_2=0.7, first=2))
    assert answer["p_win_a"] == odds.p_win_1
    assert answer["safety"] == 0.7


def test_a_match_that_never_ends(straight):
    answer = straight("0 0 --points 5")
    assert answer["p_never_ends"] == 1
    assert {answer[key] for key in QUANTITIES[-7:]} == {None}


@pytest.mark.parametrize(
    "line",
    [
        "0 5 --points 100",
        "100000 1 --points 1000",
        "--p1 0.999 --p2 0.01 --points 50",
        "9 4 --points 1:1",
    ],
)
def test_no_spot_makes_it_even(run, straight, monkeypatch, line):
    answer = straight(line)
    assert answer["p_never_ends"] == 0
    assert {answer[key] for key in QUANTITIES[-3:]} == {None}
    monkeypatch.setattr("evenbreak.cli.match.straight.to_terminal", lambda: True)
    assert run("straight", *line.split()).stdout.endswith("\nNo spot makes this match even.\n")


def test_long_matches_are_no_trouble(straight):
    assert straight("24 19 --points 1000")["p_win_a"] == pytest.approx(0.8761, abs=5e-5)
    assert straight("0.2 0.15 --points 1000")["p_win_a"] > 0.999


def test_csv_into_a_pipe(run):
    lines = run("straight", "9", "4", "--points", "50").stdout.splitlines()
    assert lines[0] == "quantity,value"
    assert [line.split(",")[0] for line in lines[1:]] == QUANTITIES
    assert "points_b,50" in lines


def test_text_on_a_terminal(run, monkeypatch):
    monkeypatch.setattr("evenbreak.cli.kit.output.to_terminal", lambda: True)
    text = run("straight", "0", "0", "--points", "5").stdout
    assert text.splitlines()[:2] == [
        "A runs 0 balls an inning, B 0; A shoots first",
        "A needs 5 points, B 5",
    ]
    assert "the match never ends" in text
    text = run("straight", "--p1", ".5", "--p2", ".6", "--points", "5", "--safety", ".5").stdout
    assert "the match never ends" not in text
    assert text.splitlines()[:2] == [
        "A makes a shot with 0.5, B with 0.6; A shoots first",
        "the first shot of an inning: 0.5 of the chance of the others",
    ]
    assert max(map(len, text.splitlines())) <= 80


@pytest.mark.parametrize("line", ["9 4 --points 100:80", "4 9 --points 1", "0 5 --points 10"])
@pytest.mark.parametrize("name", ["spot.png", "spot.svg"])
def test_plot(run, tmp_path, line, name):
    path = tmp_path / name
    result = run("straight", *line.split(), "--plot", str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes().startswith(b"\x89PNG" if name.endswith("png") else b"<?xml")


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        ("9 4", "Missing option '--points'"),
        ("9 --points 5", "1 average(s) given, 9; give two averages A B"),
        ("9 4 3 --points 5", "give two averages A B"),
        ("--points 5", "who plays is missing"),
        ("--p1 .5 --points 5", "who plays is missing"),
        ("9 4 --p1 .5 --points 5", "who plays is said twice"),
        ("9 x --points 5", "'x' is no average"),
        ("9 -4 --points 5", "'-4' is no average; give balls an inning from 0 to"),
        ("24,5 19 --points 5", "(with a decimal point: 24.5)"),
        ("9 1e9 --points 5", "balls an inning from 0 to 100000"),
        ("9 4 --points 0", "whole number from 1 to 1000"),
        ("9 4 --points 5:", "such as 7:5"),
        ("9 4 --points 2000:5", "whole number from 1 to 1000"),
        ("9 4 --points 5 --first c", "'a', 'b'"),
        ("9 4 --points 5 --safety 2", "give a number from 0 to 1"),
        ("0 0 --points 5 --plot spot.png", "nothing to draw; leave --plot out"),
        ("9 4 --point 5 --ponts 3", "Did you mean"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, line, remedy):
    result = run("straight", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


WORDS_OF_A_LINE = "--p1 --p2 --points --safety --first --json 24 0.5 100:80 0 1 -2 a b"
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("straight", *line).exit_code in (0, 2)
