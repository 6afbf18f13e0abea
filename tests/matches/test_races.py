"""The odds of a race in plain numbers, against sums on paper."""

from math import comb, fsum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.games import Race, Rack, loser_breaks, winner_breaks
from evenbreak.matches import match_odds
from evenbreak.matches.races import next_breaks, race_odds
from rows import each_of

NEEDS = st.integers(1, 9)


@given(NEEDS, NEEDS, st.floats(0.01, 0.99))
def test_a_race_is_a_sum_of_binomials(m, n, p):
    q, race = 1 - p, race_odds(m, n, p)
    wins = [comb(k - 1, m - 1) * p**m * q ** (k - m) if m <= k < m + n else 0.0 for k in race.games]
    assert race.win_1 == pytest.approx(wins)
    assert race.p_win_1 + race.p_win_2 == pytest.approx(1.0)
    assert race.p_shutout_1 == pytest.approx(p**m)
    to_the_hill = comb(m + n - 2, m - 1) * p ** (m - 1) * q ** (n - 1)
    assert race.p_hill_hill == pytest.approx(to_the_hill)


@given(NEEDS, NEEDS, st.floats(0.0, 1.0))
def test_mean_and_sd_are_those_of_the_lengths(m, n, p):
    race = race_odds(m, n, p)
    mean = fsum(k * chance for k, chance in zip(race.games, race.probability, strict=True))
    square = fsum(k * k * chance for k, chance in zip(race.games, race.probability, strict=True))
    assert race.mean == pytest.approx(mean)
    assert race.sd**2 == pytest.approx(square - mean**2, abs=1e-9)


def test_the_break_passes_on():
    # Player 1 always wins the break, player 2 never does: winner breaks lets player 1 run out.
    assert race_odds(3, 3, Rack(1.0, 0.0), winner_breaks).p_win_1 == 1.0
    assert race_odds(2, 2, Rack(1.0, 1.0), loser_breaks).probability == [0.0, 1.0]


def test_a_score_is_a_shorter_race():
    assert race_odds(7, 7, 0.6, score=(2, 3)) == race_odds(5, 4, 0.6)
    over = race_odds(7, 5, 0.6, score=(7, 2))
    assert (over.p_win_1, over.mean, over.quantile(0.9)) == (1.0, 0.0, 0)


def test_the_next_breaker_by_place():
    assert next_breaks(Rack(0.75), winner_breaks) == [(0.75, 0.25, 0, 0)]
    assert next_breaks(Rack(0.75, 0.5), winner_breaks) == [(0.75, 0.25, 0, 1), (0.5, 0.5, 0, 1)]


def test_wins_and_lengths_are_one_distribution():
    race = race_odds(7, 5, Rack(0.6, 0.4), loser_breaks, 2, (1, 2))
    assert race.games == [3, 4, 5, 6, 7, 8]
    assert sum(race.probability) == pytest.approx(1.0, rel=1e-15)
    assert race.p_win_1 + race.p_win_2 == pytest.approx(1.0, rel=1e-15)
    odds = match_odds(
        Race(7, 5, Rack(0.6, 0.4), breaks=loser_breaks, first_breaker=2, score=(1, 2))
    )
    assert (odds.mean_games, odds.sd_games) == (race.mean, race.sd)
    assert odds.games_p90 == race.quantile(0.9)


@each_of(
    "changes, message",
    [
        ({"rack": 1.5}, r"p1 must be a number from 0 to 1; you gave 1\.5"),
        ({"rack": float("nan")}, "p1 must be a number from 0 to 1; you gave nan"),
        ({"rack": [0.5, 0.6]}, r"p1 must be one number\. For an array, loop over it\."),
        (
            {"rack": Rack(0.6, 0.5), "breaks": lambda b, w: b + w},
            r"breaks\(1, 2\), the next breaker, must be 1 or 2; you gave 3",
        ),
        (
            {"rack": Rack(0.6, 0.5), "breaks": "winner"},
            "breaks must be a break format such as winner_breaks; you gave 'winner'",
        ),
        ({"m": -1}, "m must be a whole number, 0 or more; you gave -1"),
        ({"m": 2.5}, r"m must be a whole number, 0 or more; you gave 2\.5"),
        ({"rack": Rack(0.6, 0.5)}, "breaks is missing"),
        ({"first_breaker": 0}, "first_breaker must be 1 or 2; you gave 0"),
        ({"score": (5, 5)}, "both players"),
        ({"score": (-1, 0)}, "score of player 1 must be a whole number, 0 or more; you gave -1"),
    ],
)
def test_wrong_parameters_are_refused(changes, message):
    with pytest.raises(InputError, match=message):
        race_odds(**({"m": 5, "n": 5, "rack": 0.6} | changes))


def test_a_level_outside_0_1_is_refused():
    with pytest.raises(InputError, match="q must be a number from"):
        race_odds(5, 5, 0.6).quantile(2)
