"""The mode of the plain model, where it can be worked out by hand."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import expit

from evenbreak.ratings.covariance import count_pairs
from evenbreak.ratings.posterior import find_mode


def two_players(won, lost):
    return count_pairs(2, np.array([0]), np.array([1]), np.array([won]), np.array([lost]))


@pytest.mark.parametrize("precision", [0.01, 1.0, 25.0])
def test_two_players_are_where_wins_and_prior_balance(precision):
    mode = find_mode(two_players(9, 3), precision)
    # Both skills are opposite: 12 expit(2x) - 9 + τx = 0.
    x = brentq(lambda x: 12 * expit(2 * x) - 9 + precision * x, 0, 5, xtol=1e-14)
    np.testing.assert_allclose(mode.point, [x, -x], atol=1e-8)
    assert mode.gradient <= 1e-8


def test_the_curvature_is_the_laplacian_of_games_plus_the_prior():
    skill = np.array([0.4, -0.2])
    weight = 12 * expit(0.6) * expit(-0.6)
    matrix = two_players(9, 3).curvature(skill, 0.0, 2.0, None).matrix.toarray()
    np.testing.assert_allclose(matrix, [[weight + 2, -weight], [-weight, weight + 2]])


def test_a_league_without_games_stays_at_the_prior():
    none = np.zeros(0, dtype=np.int64)
    mode = find_mode(count_pairs(3, none, none, none, none), 1.0)
    assert (mode.point.tolist(), mode.iterations) == ([0, 0, 0], 0)


def test_a_whitewash_has_a_finite_rating():
    mode = find_mode(two_players(1000, 0), 1.0)
    assert 0 < mode.point[0] < math.log(1000)


@pytest.mark.parametrize("opponents", [10, 15_000, 20_000, 50_000])
def test_a_player_with_very_many_opponents_is_rated(opponents):
    one, others = np.zeros(opponents, dtype=int), np.arange(1, opponents + 1)
    seven, three = np.full(opponents, 7), np.full(opponents, 3)
    mode = find_mode(count_pairs(opponents + 1, one, others, three, seven), 1.0)
    # Every opponent is at -x/n where the one player, who lost to all of them, is at x.
    x = brentq(
        lambda x: opponents * (10 * expit(x * (1 + 1 / opponents)) - 3) + x, -5, 0, xtol=1e-14
    )
    np.testing.assert_allclose(mode.point[:2], [x, -x / opponents], atol=1e-9)
    assert mode.iterations < 10
