"""Variances of differences that are drawn, against those of the dense inverse."""

import numpy as np
import pytest

import evenbreak.ratings.covariance as module
from evenbreak.ratings import Beginning, Levels, fit
from evenbreak.ratings.beginning import Known, PriorMeans
from evenbreak.ratings.covariance import Curvature
from evenbreak.ratings.drawn_differences import DrawnDifferences
from ratings.validation.test_within_matches import league


def ratio(curvature, first, second):
    matrix = curvature.matrix
    inverse = np.linalg.inv(matrix.toarray())
    own = np.diagonal(inverse)
    exact = own[first] + own[second] - 2.0 * inverse[first, second]
    pairs = curvature.size, curvature.low, curvature.high
    return curvature.drawn(DrawnDifferences(*pairs, first, second)) / exact


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


# In leagues of clubs, with levels and earlier results.


def clubs_of(rng, players=150, clubs=5, games=1200, across=0.1):
    """Return the pairs of a league of clubs, some of whose players have not played."""
    a = rng.integers(0, players, games)
    own = (a // clubs + rng.integers(1, players // clubs, games)) % (players // clubs) * clubs
    b = np.where(rng.random(games) < across, rng.integers(0, players, games), own + a % clubs)
    a, b = a[a != b], b[a != b]
    codes, many = np.unique(np.minimum(a, b) * players + np.maximum(a, b), return_counts=True)
    low, high = np.divmod(codes, players)
    return low, high, 2.0 * many


def means_of(rng, players, *, levels, known):
    design = np.zeros((players, 3 if levels else 0))
    if levels:
        design[np.arange(players), rng.integers(0, 3, players)] = 1.0
    information = np.where(rng.random(players) < 0.5, 3.0, 0.0)
    return PriorMeans(
        np.zeros(players),
        design,
        np.full(design.shape[1], 0.4),
        known=Known(information, information) if known else None,
    )


@pytest.mark.parametrize("precision", [0.5, 2.0, 8.0])
@pytest.mark.parametrize(("levels", "known"), [(False, False), (True, False), (True, True)])
def test_the_variance_is_nearly_that_of_the_inverse(precision, levels, known):
    rng = np.random.default_rng(3)
    players = 150
    low, high, weight = clubs_of(rng, players)
    means = means_of(rng, players, levels=levels, known=known) if levels or known else None
    curvature = Curvature(players, low, high, weight, precision, means=means)
    first = rng.integers(0, players, 300)
    second = (first + rng.integers(1, players, 300)) % players
    first, second = np.append(first, low), np.append(second, high)
    found = curvature.drawn(DrawnDifferences(players, low, high, first, second))
    exact = curvature.difference_variances(first, second)
    off = found / exact - 1.0
    # Each is off by what its draws are; all use the same draws.
    assert np.sqrt((off**2).mean()) < np.sqrt(2.0 / 32) / 2.0
    assert abs(off.mean()) < 0.05


def test_who_has_met_nobody_is_as_uncertain_as_before():
    nobody = np.zeros(0, dtype=np.intp)
    curvature = Curvature(3, nobody, nobody, np.zeros(0), 4.0)
    drawn = DrawnDifferences(3, nobody, nobody, np.array([0]), np.array([2]))
    assert curvature.drawn(drawn) == pytest.approx([0.5])
