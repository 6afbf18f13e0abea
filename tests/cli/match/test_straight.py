import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.matches import StraightPool, even_spot, straight_pool_odds
from evenbreak.stats import shot_chance
from rows import each_of

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
def straight(ask):
    def answer(line):
        told = ask("straight", *line.split())
        assert list(told) == QUANTITIES
        return told

    return answer


def test_averages(straight):
    answer = straight("--averages 9:4 --points 100")
    match = StraightPool(100, 100, 0.9, 0.8)
    odds, spot = straight_pool_odds(match), even_spot(match)
    assert (answer["p_make_a"], answer["p_make_b"]) == (0.9, 0.8)
    assert (answer["p_win_a"], answer["p_win_b"]) == (odds.p_win_1, odds.p_win_2)
    assert (answer["mean_innings"], answer["sd_innings"]) == (odds.mean_innings, odds.sd_innings)
    assert (answer["innings_p50"], answer["innings_p90"]) == (odds.innings_p50, odds.innings_p90)
    assert (answer["even_points_b"], answer["p_win_a_even"]) == (spot.points, spot.p_win_1)
    assert straight("--p1 0.9 --p2 0.8 --points 100:100") == answer


def test_the_stronger_player_keeps_their_points_in_the_even_match(straight):
    one = straight("--averages 9:4 --points 100:80 --first b")
    assert one["even_points_a"] == 100
    assert one["even_points_b"] < 80
    other = straight("--averages 4:9 --points 80:100 --first a")
    assert (other["even_points_a"], other["even_points_b"]) == (one["even_points_b"], 100)
    assert other["p_win_a_even"] == pytest.approx(1 - one["p_win_a_even"])


def test_safety_and_first(straight):
    answer = straight("--averages 24:19 --points 150 --safety 0.7 --first b")
    p_a, p_b = shot_chance(24, 0.7), shot_chance(19, 0.7)
    odds = straight_pool_odds(StraightPool(150, 150, p_a, p_b, safety_1=0.7, safety_2=0.7, first=2))
    assert answer["p_win_a"] == odds.p_win_1
    assert answer["safety"] == 0.7


def test_a_match_that_never_ends(straight):
    answer = straight("--averages 0:0 --points 5")
    assert answer["p_never_ends"] == 1
    assert {answer[key] for key in QUANTITIES[-7:]} == {None}


@pytest.mark.parametrize(
    "line",
    [
        "--averages 0:5 --points 100",
        "--averages 100000:1 --points 1000",
        "--p1 0.999 --p2 0.01 --points 50",
        "--averages 9:4 --points 1:1",
    ],
)
def test_no_spot_makes_it_even(straight, line):
    answer = straight(line)
    assert answer["p_never_ends"] == 0
    assert {answer[key] for key in QUANTITIES[-3:]} == {None}


def test_long_matches_are_no_trouble(straight):
    assert straight("--averages 24:19 --points 1000")["p_win_a"] == pytest.approx(0.8761, abs=5e-5)
    assert straight("--averages 0.2:0.15 --points 1000")["p_win_a"] > 0.999


def test_csv_into_a_pipe(run):
    lines = run("straight", "--averages", "9:4", "--points", "50").stdout.splitlines()
    assert lines[0] == "quantity,value"
    assert [line.split(",")[0] for line in lines[1:]] == QUANTITIES
    assert "points_b,50" in lines


@pytest.mark.slow_after(3)
@pytest.mark.parametrize(
    "line",
    ["--averages 9:4 --points 100:80", "--averages 4:9 --points 1", "--averages 0:5 --points 10"],
)
@pytest.mark.parametrize("name", ["spot.png", "spot.svg"])
def test_plot(run, tmp_path, line, name):
    path = tmp_path / name
    result = run("straight", *line.split(), "--plot", str(path), "--text")
    assert (result.exit_code, result.stderr) == (0, f"Wrote {path}\n")
    assert path.read_bytes().startswith(b"\x89PNG" if name.endswith("png") else b"<?xml")


@each_of(
    "line, named",
    [
        ("9 4", "--points"),
        ("9 --points 5", "such as 24:19"),
        ("9 4 3 --points 5", "9:4:3"),
        ("--points 5", "--p1 and --p2"),
        ("--p1 .5 --points 5", "--p1 and --p2"),
        ("9 4 --p1 .5 --points 5", "given twice"),
        ("9 x --points 5", "'x'"),
        ("--averages 9:-4 --points 5", "'-4'"),
        ("--averages 24,5:19 --points 5", "24.5"),
        ("9 1e9 --points 5", "from 0 to 100,000"),
        ("--averages 9:4 --points 0", "Give 1 to 1000"),
        ("--averages 9:4 --points 5:", "such as 7:5"),
        ("--averages 9:4 --points 2000:5", "Give 1 to 1000"),
        ("--averages 9:4 --points 5 --first c", "'--first'"),
        ("--averages 9:4 --points 5 --safety 2", "'2'"),
        ("--averages 0:0 --points 5 --plot spot.png", "--plot"),
        ("--p1 .5 --p2 .5 --safety 0 --points 5 --plot spot.png", "--plot"),
        ("9 4 --point 5 --ponts 3", "--points"),
    ],
)
def test_wrong_use(refused, line, named):
    assert named in refused("straight", *line.split())


WORDS_OF_A_LINE = "--p1 --p2 --points --safety --first --json 24 0.5 100:80 0 1 -2 a b"
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("straight", *line).exit_code in (0, 2)
