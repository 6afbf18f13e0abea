import pytest
from hypothesis import given
from hypothesis import strategies as st

from rows import each_of

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
def breaks(ask):
    def answer(line):
        (rows,) = ask("breaks", *line.split()).values()
        for row in rows:
            assert list(row) == COLUMNS
        return {row["breaks"]: row for row in rows}

    return answer


def test_stakes_of_p5_25(breaks):
    rows = breaks("--p1 0.9 --p2 0.5 --win 1 --lose 2")
    assert list(rows) == ["a", "winner", "alternate", "loser", "b"]
    points = {name: rows[name]["points_per_rack"] for name in ("winner", "loser", "alternate")}
    assert points == pytest.approx({"winner": 1 / 2, "loser": -1 / 14, "alternate": 1 / 10})
    # W = 9/14 in loser breaks, so that 2 x (5/14) / (9/14) makes it even.
    assert rows["loser"]["fair_win"] == pytest.approx(10 / 9)
    assert rows["winner"]["first_break_racks"] == pytest.approx(2 / 3)
    assert rows["a"]["first_break_racks"] is None
    assert rows["winner"]["memory"] == pytest.approx(0.4)


def test_fair_stakes_make_it_even(breaks):
    fair = breaks("--p1 0.7 --p2 0.6 --lose 3")["winner"]["fair_win"]
    assert breaks(f"--p1 0.7 --p2 0.6 --lose 3 --win {fair}")["winner"][
        "points_per_rack"
    ] == pytest.approx(0.0, abs=1e-12)


def test_who_breaks_first_matters_where_the_break_never_passes_on(breaks):
    assert breaks("--p1 1 --p2 1")["winner"]["share_a"] == 1.0
    rows = breaks("--p1 1 --p2 1 --first-break b")
    assert rows["winner"]["share_a"] == 0.0
    assert rows["winner"]["fair_win"] is None
    assert rows["winner"]["first_break_racks"] is None
    assert breaks("--p1 0.7 --p2 0.6") == breaks("--p1 0.7 --p2 0.6 --first-break b")


def test_csv_into_a_pipe(run):
    assert run("breaks", "--p1", "0.75", "--p2", "0.75").stdout.splitlines() == [
        ",".join(COLUMNS),
        "a,0.750000,0.500000,0.866025,0.333333,,0.000000",
        "winner,0.500000,0.000000,1.732051,1.000000,1.000000,0.500000",
        "loser,0.500000,0.000000,0.577350,1.000000,0.333333,-0.500000",
        "alternate,0.500000,0.000000,0.866025,1.000000,0.250000,-1.000000",
        "b,0.250000,-0.500000,0.866025,3.000000,,0.000000",
    ]


@pytest.mark.slow
def test_plot(run, tmp_path):
    path = tmp_path / "breaks.png"
    result = run("breaks", "--p1", "0.9", "--p2", "0.5", "--plot", str(path), "--text")
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes()[:4] == b"\x89PNG"


@each_of(
    "line, named",
    [
        ("--p1 0.9", "--p2"),
        ("0.9", "unexpected extra argument (0.9)"),
        ("--p1 0.9 --p2 5", "'5'"),
        ("--p1 60 --p2 55", "0.6"),
        ("60 55", "0.6"),
        ("--p1 0,9 --p2 0.5", "0.9"),
        ("--p1 0.9 --p2 0.5 --win 1,5", "1.5"),
        ("--p1 -0.9 --p2 0.5", "'--p1': '-0.9'"),
        ("--p1 0.9 --p2 0.5 --wins 1", "--wins"),
        ("--p1 0.9 --p2 0.5 --win -1", "from 0 to 1000000"),
        ("--p1 0.9 --p2 0.5 --lose much", "'much'"),
        ("--p1 0.9 --p2 0.5 --lose inf", "'inf'"),
        ("--p1 0.9 --p2 0.5 --first-break c", "'--first-break'"),
        ("--p1 0.9 --p2 0.5 --plot breaks", ".png or .svg"),
    ],
)
def test_wrong_use(refused, line, named):
    assert named in refused("breaks", *line.split())


WORDS_OF_A_LINE = "--p1 --p2 --win --lose --first-break a b --json 0.5 0 1 1e6 2 -1"
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("breaks", *line).exit_code in (0, 2)


def test_chances_without_their_options_are_taken_with_a_note(run):
    told, now = run("breaks", "0.9", "0.5"), run("breaks", "--p1", "0.9", "--p2", "0.5")
    assert told.stdout == now.stdout
    assert told.stderr.startswith("Note: write --p1 0.9 --p2 0.5 in place of 0.9 0.5.\n")
