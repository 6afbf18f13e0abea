import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.match.breaks import advice
from evenbreak.games import Rack
from evenbreak.practice import compare_break_formats

COLUMNS = [
    "breaks",
    "share_a",
    "points_per_rack",
    "sd_points",
    "fair_win",
    "first_break_racks",
    "memory",
]


@pytest.fixture
def breaks(run):
    def ask(line):
        result = run("breaks", "--json", *line.split())
        assert (result.exit_code, result.stderr) == (0, "")
        answer = json.loads(result.stdout)
        assert list(answer) == ["formats", "schema_version"]
        for row in answer["formats"]:
            assert list(row) == COLUMNS
        return {row["breaks"]: row for row in answer["formats"]}

    return ask


def test_stakes_of_p5_25(breaks):
    rows = breaks("0.9 0.5 --win 1 --lose 2")
    assert list(rows) == ["a", "winner", "alternate", "loser", "b"]
    points = {name: rows[name]["points_per_rack"] for name in ("winner", "loser", "alternate")}
    assert points == pytest.approx({"winner": 1 / 2, "loser": -1 / 14, "alternate": 1 / 10})
    # W = 9/14 in loser breaks, so that 2 x (5/14) / (9/14) makes it even.
    assert rows["loser"]["fair_win"] == pytest.approx(10 / 9)
    assert rows["winner"]["first_break_racks"] == pytest.approx(2 / 3)
    assert rows["a"]["first_break_racks"] is None
    assert rows["winner"]["memory"] == pytest.approx(0.4)


def test_fair_stakes_make_it_even(breaks):
    fair = breaks("0.7 0.6 --lose 3")["winner"]["fair_win"]
    assert breaks(f"0.7 0.6 --lose 3 --win {fair}")["winner"]["points_per_rack"] == pytest.approx(
        0.0, abs=1e-12
    )


def test_who_breaks_first_matters_where_the_break_never_passes_on(breaks):
    assert breaks("1 1")["winner"]["share_a"] == 1.0
    rows = breaks("1 1 --first-break b")
    assert rows["winner"]["share_a"] == 0.0
    assert rows["winner"]["fair_win"] is None
    assert rows["winner"]["first_break_racks"] is None
    assert breaks("0.7 0.6") == breaks("0.7 0.6 --first-break b")


def test_csv_into_a_pipe(run):
    assert run("breaks", "0.75", "0.75").stdout.splitlines() == [
        ",".join(COLUMNS),
        "a,0.750000,0.500000,0.866025,0.333333,,0.000000",
        "winner,0.500000,0.000000,1.732051,1.000000,1.000000,0.500000",
        "loser,0.500000,0.000000,0.577350,1.000000,0.333333,-0.500000",
        "alternate,0.500000,0.000000,0.866025,1.000000,0.250000,-1.000000",
        "b,0.250000,-0.500000,0.866025,3.000000,,0.000000",
    ]


@pytest.mark.parametrize(
    ("p1", "p2", "lose", "words"),
    [
        (0.5, 0.1, 1, "A is best off with loser breaks, B with winner breaks."),
        (0.95, 0.94, 1, "A is best off with winner breaks, B with loser breaks."),
        (0.6, 0.4, 1, "Winner, loser and alternate breaks are worth the same to both."),
        (0.7, 0.7, 1, "Winner, loser and alternate breaks are worth the same to both."),
        (1, 1, 1, "With winner breaks the break never passes on: all hangs on who breaks first."),
        (0, 0, 1, "With loser breaks the break never passes on: all hangs on who breaks first."),
        (
            0.9,
            0.5,
            3,
            "At these stakes A gains with winner breaks, and loses with alternate and loser "
            "breaks.",
        ),
    ],
)
def test_advice(p1, p2, lose, words):
    assert advice(compare_break_formats(Rack(p1, p2), lose=lose)).endswith(words)


def test_a_terminal_of_80_columns_is_wide_enough(run, monkeypatch):
    for module in ("output", "breaks"):
        monkeypatch.setattr(f"evenbreak.cli.{module}.to_terminal", lambda: True)
    text = run("breaks", "0.9", "0.5", "--lose", "2").stdout
    assert max(map(len, text.splitlines())) <= 80
    # W = 5/6 in winner breaks: 5/6 - 2/6 points a rack.
    assert "In 100 racks with winner breaks A gets 50 points on average, give or take" in text


def test_plot(run, tmp_path):
    path = tmp_path / "breaks.png"
    result = run("breaks", "0.9", "0.5", "--plot", str(path))
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        ("0.9", "Missing argument 'P2'"),
        ("0.9 5", "'5' is not a probability; give a number from 0 to 1"),
        ("60 55", "(60 % is 0.6)"),
        ("0,9 0.5", "(with a decimal point: 0.9)"),
        ("0.9 0.5 --win 1,5", "(with a decimal point: 1.5)"),
        ("-0.9 0.5", "'P1': '-0.9' is not a probability; give a number from 0 to 1"),
        ("0.9 0.5 --wins 1", "No such option '--wins'"),
        ("0.9 0.5 --win -1", "'-1' is no stake; give a number from 0 to 1000000"),
        ("0.9 0.5 --lose much", "'much' is no stake"),
        ("0.9 0.5 --lose inf", "'inf' is no stake"),
        ("0.9 0.5 --first-break c", "'a', 'b'"),
        ("0.9 0.5 --plot breaks", ".png or .svg"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, line, remedy):
    result = run("breaks", *line.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


WORDS_OF_A_LINE = "--win --lose --first-break a b --json 0.5 0 1 1e6 2 -1"
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("breaks", *line).exit_code in (0, 2)
