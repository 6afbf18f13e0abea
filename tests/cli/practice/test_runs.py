import json
import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.stats import InningsScore, RunLength
from rows import each_of

QUANTITIES = [
    "p_make",
    "safety",
    "innings",
    "mean",
    "median",
    "mode",
    "sd",
    "relative_sd",
    "median_estimate",
    "p_at_least",
    "p_between",
    "p_over",
    "p_not_over",
]


@pytest.fixture
def runs(run):
    def ask(line):
        result = run("runs", "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        answer = json.loads(result.stdout)
        assert [name for name in answer if name in QUANTITIES] == QUANTITIES
        return answer

    return ask


def test_a_player_who_runs_24(runs):
    answer = runs("--mean 24 --between 50..75 --at-least 100 --over 20")
    assert (answer["p_make"], answer["mean"], answer["median"], answer["mode"]) == (0.96, 24, 16, 0)
    assert round(answer["median_estimate"], 1) == 16.6
    assert round(answer["p_between"], 3) == 0.085
    assert round(answer["p_at_least"], 3) == 0.017
    assert (round(answer["p_over"], 3), round(answer["p_not_over"], 3)) == (0.424, 0.576)
    assert runs("--p 0.96 --between 50..75 --at-least 100 --over 20") == answer


def test_several_innings(runs):
    answer = runs("--mean 24 --innings 5 --at-least 120")
    law = InningsScore(Fraction(24, 25), 5)
    assert (answer["mean"], answer["median"], answer["mode"]) == (120, 112, 95)
    assert (answer["sd"], answer["relative_sd"]) == (law.sd, law.relative_sd)
    assert round(answer["median_estimate"]) == 112
    assert answer["p_at_least"] == law.at_least(120)
    assert answer["p_between"] is answer["p_over"] is None


def test_the_mean_is_what_the_player_runs_with_safety_play(runs):
    answer = runs("--mean 24 --safety 0.8 --over 10")
    law = RunLength.of_mean(24, 0.8)
    assert answer["mean"] == 24
    assert answer["p_make"] == float(law.p)
    assert answer["p_not_over"] == law.cumulative(10)
    assert runs("--p 0.96 --safety 0.8")["mean"] == pytest.approx(19.2)
    assert runs("--mean 24 --safety 0.8 --innings 3")["median_estimate"] is None


def test_nobody_makes_a_ball(runs):
    answer = runs("--mean 0 --at-least 0")
    assert (answer["mean"], answer["median"], answer["p_at_least"]) == (0, 0, 1)
    assert answer["relative_sd"] is None


def test_csv_into_a_pipe(run):
    lines = run("runs", "--p", "0.5", "--innings", "8", "--over", "6").stdout.splitlines()
    assert lines[0] == "quantity,value"
    assert [line.split(",")[0] for line in lines[1:]] == QUANTITIES
    assert {"median,7", "mode,6", "p_at_least,", "p_not_over,0.395264"} <= set(lines)


def test_a_line_between_two_scores_is_passed_by_the_next_one(runs):
    half, whole = (runs(f"--mean 24 --over {line}") for line in ("20.5", "20"))
    assert {name: half[name] for name in QUANTITIES} == {name: whole[name] for name in QUANTITIES}


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("line", ["--mean 24", "--p .9 --innings 20 --safety .8", "--mean 0"])
@pytest.mark.parametrize("name", ["runs.png", "runs.SVG"])
def test_plot(run, tmp_path, line, name):
    path = tmp_path / name
    result = run("runs", *line.split(), "--plot", str(path))
    assert result.exit_code == 0
    assert f"Wrote {path}\n" in result.stderr
    assert path.read_bytes().startswith(b"\x89PNG" if name.endswith("png") else b"<?xml")


@each_of(
    "line, wrong",
    [
        ("", "--mean or --p"),
        ("--mean 3 --p 0.5", "--mean or --p"),
        ("--mean -1", "'-1'"),
        ("--mean 1e9", "'1e9'"),
        ("--mean nan", "'nan'"),
        ("--p 2", "'2'"),
        ("--mean 5 --safety 1.1", "'1.1'"),
        ("--mean 5 --innings 0", "'0'"),
        ("--mean 5 --at-least -1", "'-1'"),
        ("--mean 5 --at-least x", "'x'"),
        ("--mean 5 --over -1", "'-1'"),
        ("--mean 24,5", "24.5"),
        ("--p 96%", "0.96"),
        ("--mean 5 --between 9..7", "'9..7'"),
        ("--mean 5 --between 9", "'9'"),
        ("--mean 5 --between 0..999999", "'0..999999'"),
        ("--mean 5 --plot runs.pdf", "runs.pdf"),
        ("--mean 5 --at-lest 3", "--at-lest"),
        ("--mean 5 3", "(3)"),
        ("--p 1", "p must be below 1"),
        ("--mean 24 --safety 0", "safety must be greater than 0; at 0 every run is 0"),
        ("--mean 1000 --innings 1000", "100,000"),
    ],
)
def test_wrong_use_is_named(run, line, wrong):
    result = run("runs", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert wrong in result.stderr


WORDS_OF_A_LINE = (
    "--mean --p --safety --innings --at-least --between --over --json 24 0.5 1..3 0 3 -2"
)
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("runs", *line).exit_code in (0, 2)


@given(st.just(0.0) | st.floats(1e-290, 5000), st.integers(1, 20))
def test_any_average_gives_itself_back(run, mean, innings):
    result = run("runs", "--json", "--mean", repr(mean), "--innings", str(innings))
    answer = json.loads(result.stdout)
    assert math.isclose(answer["mean"], innings * mean, rel_tol=1e-12)
