"""Variances of differences that are drawn, against those of the dense inverse."""

import numpy as np
import pytest

import evenbreak.ratings.covariance as module
from evenbreak.ratings import Beginning, Levels, fit
from evenbreak.ratings.drawn_differences import drawn_difference_variances
from ratings.validation.test_within_matches import league


def ratio(curvature, first, second):
    matrix = curvature.matrix
    inverse = np.linalg.inv(matrix.toarray())
    own = np.diagonal(inverse)
    exact = own[first] + own[second] - 2.0 * inverse[first, second]
    drawn = drawn_difference_variances(matrix, matrix.sum(axis=1), first, second)
    return drawn / exact


@pytest.mark.parametrize("half_life", [None, 20.0])
def test_drawn_variances_are_near_the_exact_ones(half_life):
    season = league(0.0, 1, players=400, days=12)
    curvature = fit(season, prior_sd=0.5, half_life=half_life)._curvature
    met = ratio(curvature, season.player_a, season.player_b)
    assert met.mean() == pytest.approx(1.0, abs=0.005)
    assert met.std() < 0.03
    a = np.random.default_rng(2).permutation(400)
    apart = ratio(curvature, a[:200], a[200:])
    assert apart.mean() == pytest.approx(1.0, abs=0.005)


def test_they_are_used_in_large_leagues_levels_and_earlier_ratings_included(monkeypatch):
    season = league(0.0, 2, players=60, days=20)
    rng = np.random.default_rng(3)
    known = Beginning(season.players[:30], rng.normal(80.0, 10.0, 30), np.full(30, 12.0))
    ratings = fit(season, prior_sd=0.5, levels=Levels(newcomers=0.2, beginning=known))
    a, b = np.arange(30), np.arange(30, 60)
    exact = ratings.difference_variances(a, b)
    monkeypatch.setattr(module, "_DENSE_UP_TO", 10)
    drawn = ratings.difference_variances(a, b)
    assert (drawn != exact).any()
    assert drawn == pytest.approx(exact, rel=0.1)
