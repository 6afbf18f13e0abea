import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rows import each_of

COLUMNS = ["race_a", "race_b", "p_win_a", "mean_games", "games_p90"]


@pytest.fixture
def fair(ask):
    def races(line):
        told = ask("fair", *line.split())
        assert set(told) == {"target", "races"}
        for race in told["races"]:
            assert list(race) == COLUMNS
        return told["races"]

    return races


def binomial_win(p, m, n):
    """Return P(player 1 wins the race m:n), summed over player 2's games."""
    return math.fsum(math.comb(m - 1 + lost, lost) * p**m * (1 - p) ** lost for lost in range(n))


def test_races_come_nearest_first_and_are_those_of_the_span(fair):
    p = 1 / (1 + 2 ** (-91 / 100))
    races = fair("612 521 --scale fargo --games 7..13 --top 300")
    every = {(m, n) for m in range(1, 14) for n in range(1, 14) if 7 <= m + n - 1 <= 13}
    assert {(race["race_a"], race["race_b"]) for race in races} == every
    for race in races:
        assert race["p_win_a"] == pytest.approx(
            binomial_win(p, race["race_a"], race["race_b"]), rel=1e-12
        )
    distances = [abs(race["p_win_a"] - 0.5) for race in races]
    assert distances == sorted(distances)


def test_the_commonest_question(fair):
    for line in ("612 521 --scale fargo --race-to 7", "521 612 --scale fargo --race-to 7"):
        best = fair(line)[0]
        assert sorted((best["race_a"], best["race_b"])) == [4, 7]
    assert best["race_b"] == 7


def test_ties_are_shortest_first(fair):
    even = fair("--p 0.5 --games 1..9 --top 5")
    assert [(race["race_a"], race["race_b"]) for race in even] == [(n, n) for n in range(1, 6)]


def test_target(fair):
    assert fair("--p 0.5 --games 1..2 --target 0.75 --top 1")[0]["p_win_a"] == 0.75


def test_top(fair):
    assert len(fair("--p 0.6 --games 5..9")) == 5
    assert len(fair("--p 0.6 --games 5..9 --top 2")) == 2


def test_breaks_and_negative_ratings(fair):
    races = fair("--p1 1 --p2 1 --breaks winner --games 1..3 --top 100")
    assert {race["p_win_a"] for race in races} == {1.0}
    assert fair("-20 30 --games 3..5") == fair("0 50 --games 3..5")


def test_a_race_to_7_unless_asked_otherwise(fair):
    assert fair("85 40") == fair("85 40 --race-to 7")


def test_csv_into_a_pipe_with_the_scale_beside_it(run, fair):
    result = run("fair", "85", "40", "--race-to", "2")
    assert result.stdout.splitlines() == [
        ",".join(COLUMNS),
        *(
            f"2,{race['race_b']},{race['p_win_a']:.6f},{race['mean_games']:.6f},{race['games_p90']}"
            for race in fair("85 40 --race-to 2")
        ),
    ]
    assert "NPL" in result.stderr


@each_of(
    "line, named",
    [
        ("612 521 --games 7..9 --race-to 7", "--race-to"),
        ("612 521 --games 7", "such as 7..13"),
        ("612 521 --games 9..7", "such as 7..13"),
        ("612 521 --games 0..7", "such as 7..13"),
        ("612 521 --games 1..5000", "such as 7..13"),
        ("612 521 --race-to 0", "from 1 to 1000"),
        ("612 521 --games 7..9 --target 2", "'2'"),
        ("612 521 --games 7..9 --top 0", "from 1 to 300"),
        ("--games 7..9", "missing players: give two ratings"),
        ("612 521 --gmaes 7..9", "--games"),
    ],
)
def test_wrong_use(refused, line, named):
    assert named in refused("fair", *line.split())


WORDS_OF_A_LINE = (
    "--games --race-to --target --top --p --scale --json 7..9 1..1 3 0.5 1 2 -20 fargo"
)
words = st.sampled_from(WORDS_OF_A_LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=8))
def test_no_words_make_a_traceback(run, line):
    assert run("fair", *line).exit_code in (0, 2)
