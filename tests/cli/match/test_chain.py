import json
import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rows import each_of

HEADER = "source,target,probability\n"
# One ball, two players: the nodes of the two-parameter infinite look-ahead.
ONE_BALL = HEADER + "S1,W,0.3\nS1,S2,0.7\nS2,L,0.2\nS2,S1,0.8\n"


def limits(output):
    head, *rows = output.splitlines()
    assert head == "state,probability"
    return {state: float(p) for state, p in (row.rsplit(",", 1) for row in rows)}


@pytest.fixture
def answer(ask):
    return lambda arcs, *words: ask("chain", "-", *words, stdin=arcs)


def test_one_ball_limit(run):
    W = Fraction(3, 10) / (1 - Fraction(7, 10) * Fraction(8, 10))
    result = run("chain", "-", stdin=ONE_BALL)
    assert result.exit_code == 0
    assert limits(result.stdout) == pytest.approx(
        {"S1": 0, "W": float(W), "S2": 0, "L": float(1 - W)}, rel=1e-14
    )


def test_start_is_the_source_of_the_first_row_unless_said(answer):
    assert answer(ONE_BALL)["start"] == "S1"
    assert answer(ONE_BALL, "--start-state", "S2")["limit"]["L"] == pytest.approx(0.2 / 0.44)


def test_numbers_read_back_exactly(run, answer):
    printed = limits(run("chain", "-", stdin=ONE_BALL).stdout)
    assert printed == answer(ONE_BALL)["limit"]


def test_names_are_safe_to_open_in_a_spreadsheet_and_numbers_stay_numbers(run):
    arcs = HEADER + "-1,=A1,0.5\n-1,+2,0.25\n-1,@x,0.25\n"
    rows = run("chain", "-", stdin=arcs).stdout.splitlines()
    assert rows[1:] == ["-1,0.0", "'=A1,0.5", "+2,0.25", "'@x,0.25"]
    assert run("chain", "-", stdin=HEADER + '"a,""b",c,1\n').stdout.endswith('"a,""b",0.0\nc,1.0\n')


def test_steps_give_the_density(run):
    result = run("chain", "-", "--steps", "2", stdin=ONE_BALL)
    assert limits(result.stdout) == pytest.approx({"S1": 0.56, "W": 0.3, "S2": 0, "L": 0.14})
    assert limits(run("chain", "-", "--steps", "0", stdin=ONE_BALL).stdout)["S1"] == 1.0


def test_a_billion_steps_are_as_soon_taken_as_ten(run):
    arcs = HEADER + "A,A,0.999999999\nA,B,0.000000001\n"
    told = limits(run("chain", "-", "--steps", "1000000000", stdin=arcs).stdout)
    assert told["A"] == pytest.approx(math.exp(-1), rel=1e-6)


def test_more_steps_than_can_be_followed_end_with_2_and_a_way_out(run):
    result = run("chain", "-", "--steps", "1" + "0" * 30, stdin=ONE_BALL)
    assert (result.exit_code, result.stdout) == (2, "")
    assert "ask for the stochastic limit" in result.stderr


def test_json_keys(answer):
    told = answer(ONE_BALL)
    assert set(told) == {
        "start",
        "limit",
        "states",
        "period",
        "mean_steps",
        "bound",
        "steps",
        "density",
        "probabilities",
    }
    assert (told["steps"], told["density"]) == (None, None)
    assert told["states"]["S2"] == {"class": told["states"]["S1"]["class"], "kind": "transient"}
    assert told["states"]["W"]["kind"] == "absorbing"
    assert (told["period"], told["bound"]) == (1, None)
    assert told["mean_steps"] == pytest.approx(1.7 / 0.44)


def test_json_holds_the_density_too_where_steps_are_given(answer):
    told = answer(ONE_BALL, "--steps", "1")
    assert (told["steps"], told["density"]["S2"]) == (1, 0.7)
    assert told["limit"]["S2"] == 0.0


def test_a_period(answer):
    arcs = HEADER + "A,B,1\nB,A,1\nX,A,1\n"
    told = answer(arcs, "--start-state", "X")
    assert (told["period"], told["limit"]) == (2, {"A": 0.5, "B": 0.5, "X": 0.0})
    assert {told["states"][state]["kind"] for state in "AB"} == {"recurrent"}


def test_period_is_the_least_common_multiple_of_what_is_reached(answer):
    arcs = HEADER + "S,A1,0.5\nS,B1,0.5\nA1,A2,1\nA2,A1,1\nB1,B2,1\nB2,B3,1\nB3,B1,1\n"
    assert answer(arcs)["period"] == 6
    assert answer(arcs, "--start-state", "B2")["period"] == 3


def test_mean_steps_is_null_where_absorption_may_never_come(answer):
    arcs = HEADER + "S,W,0.5\nS,A,0.5\nA,B,1\nB,A,1\n"
    assert answer(arcs)["mean_steps"] is None
    assert answer(arcs, "--start-state", "W")["mean_steps"] == 0


@pytest.mark.parametrize(
    ("arcs", "limit"),
    [
        ("A,B,1e-320\nA,A,1\n", {"A": 0.0, "B": 1.0}),
        ("A,B,1e-300\nA,A,1\nB,C,1e-300\nB,A,1\n", {"A": 0.0, "B": 0.0, "C": 1.0}),
        (
            "".join(f"{k},{k + 1},1e-308\n{k},{k},1\n" for k in range(3)),
            {"0": 0.0, "1": 0.0, "2": 0.0, "3": 1.0},
        ),
    ],
)
def test_a_mean_beyond_all_floats_is_null_with_a_warning(run, arcs, limit):
    result = run("chain", "-", "--json", stdin=HEADER + arcs)
    told = json.loads(result.stdout)
    assert (told["limit"], told["mean_steps"]) == (limit, None)
    (warning,) = told["warnings"]
    assert result.stderr == f"Warning: {warning}\n"


def test_a_mean_whose_square_is_beyond_all_floats(answer):
    assert answer(HEADER + "A,B,1e-200\nA,A,1\n")["mean_steps"] == pytest.approx(1e200)


@pytest.mark.parametrize(
    "arcs",
    [
        ONE_BALL.replace("\n", "\r\n"),
        ONE_BALL.replace(",", ";"),
        ONE_BALL.replace(",", "\t"),
        "\ufeff" + ONE_BALL,
        ONE_BALL.replace("source,target,probability", "From,To,P"),
        ONE_BALL.replace("S1,W,0.3\n", '"S1", W ,0.3\n\n'),
    ],
)
def test_what_spreadsheets_write_is_read(answer, arcs):
    assert answer(arcs)["limit"] == answer(ONE_BALL)["limit"]


def test_cp1252_is_read_with_a_warning(run):
    result = run("chain", "-", stdin=ONE_BALL.replace("W", "Ä").encode("cp1252"))
    assert result.exit_code == 0
    assert "Ä,0.68" in result.stdout
    assert "Windows-1252" in result.stderr


@each_of(
    "arcs, told",
    [
        (b"", ["stdin: is empty"]),
        (b"\x00\x01", ["stdin:1: holds a NUL"]),
        (HEADER, ["stdin: has no arcs"]),
        ("a,b\n1,2\n", ["'source', 'target' and 'probability'"]),
        (HEADER + "S,W,x\n", ["stdin:2: probability 'x' isn't a number"]),
        (HEADER + "S,W,nan\n", ["stdin:2: probability 'nan' isn't a number"]),
        (
            HEADER + "S,W,1.5\nS,L,-0.5\n",
            ["stdin:2: probability '1.5'", "stdin:3: probability '-0.5'"],
        ),
        (
            HEADER + "S,W,0.5\nS,L,0.4\n",
            ["stdin:2: the probabilities of the arcs out of 'S' sum to 0.9"],
        ),
        (HEADER + "S,W,0.5\nS,W,0.5\n", ["stdin:3: the arc 'S' -> 'W' is already in line 2"]),
        (HEADER + ",W,1\nW,,1\n", ["stdin:2: source is empty", "stdin:3: target is empty"]),
        (HEADER + "S,W\n", ["stdin:2: has 2 cells"]),
        (
            HEADER + "S,W,x\nS,W,0.1\nS,T\n",
            ["stdin:2: probability", "stdin:3: the arc", "stdin:4: has 2 cells"],
        ),
    ],
)
def test_bad_files_end_with_3_and_a_line_for_each_problem(run, arcs, told):
    result = run("chain", "-", stdin=arcs)
    assert (result.exit_code, result.stdout) == (3, "")
    lines = result.stderr.splitlines()
    assert len(lines) == len(told)
    for line, part in zip(lines, told, strict=True):
        assert line.startswith("Error: stdin")
        assert part in line


def test_a_thousand_problems_are_shown_as_twenty(run):
    arcs = HEADER + "".join(f"s{k},t,0.5\n" for k in range(1000))
    told = run("chain", "-", stdin=arcs).stderr.splitlines()
    assert told[19].startswith("Error: stdin:21: ")
    assert told[20:] == ["Error: and 980 more problems"]


def test_a_missing_file_ends_with_3(run):
    result = run("chain", "nowhere.csv")
    assert result.exit_code == 3
    assert result.stderr.startswith("Error: nowhere.csv: there's no such file")


def test_an_unknown_start_ends_with_3(run):
    result = run("chain", "-", "--start-state", "Q", stdin=ONE_BALL)
    assert result.exit_code == 3
    assert "'Q'" in result.stderr
    assert "'S1', 'W'" in result.stderr


@pytest.mark.parametrize("words", [("--steps", "-1"), ("--steps", "x"), ("--nope",)])
def test_wrong_options_end_with_2(run, words):
    assert run("chain", "-", *words, stdin=ONE_BALL).exit_code == 2


@given(
    st.binary(max_size=60)
    | st.text(max_size=60).map(lambda text: HEADER.encode() + text.encode("utf-8", "replace"))
)
def test_no_file_makes_a_traceback(run, content):
    result = run("chain", "-", stdin=content)
    assert result.exit_code in (0, 3)
    assert (result.stdout == "") == (result.exit_code == 3)
