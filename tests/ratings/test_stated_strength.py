"""Strengths by the races that a league makes its players play."""

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.matches.win import race_win_probability
from evenbreak.ratings import Results
from evenbreak.ratings.levels import StatedStrength, has_handicaps, implied_difference


def season(a, b, race_a, race_b):
    zeros = [0] * len(a)
    return Results.from_names(a, b, zeros, zeros, race_a=race_a, race_b=race_b)


def test_the_implied_difference_makes_the_race_even():
    results = season(["A"] * 3, ["B"] * 3, [7, 2, 5], [3, 6, 5])
    p = expit(implied_difference(results))
    np.testing.assert_allclose(race_win_probability(p, [7, 2, 5], [3, 6, 5]), 0.5, atol=1e-9)


def test_strengths_have_the_implied_differences():
    results = season(["A", "B", "C"], ["B", "C", "A"], [5, 4, 3], [4, 5, 5])
    known = StatedStrength(results)
    assert not known.strength().any()
    known.see(slice(0, 1))
    a, b, c = known.strength()
    assert c == 0
    assert a - b == pytest.approx(implied_difference(results)[0], rel=0.01)


def test_even_races_are_no_handicaps():
    assert not has_handicaps(season(["A"], ["B"], [5], [5]))
    assert has_handicaps(season(["A"], ["B"], [5], [4]))
