"""Refitting day by day against a fit of all results at once."""

import numpy as np

from evenbreak.ratings.covariance import count_pairs
from evenbreak.ratings.posterior import find_mode
from evenbreak.ratings.validation.walk_forward import DailyRefit

RNG = np.random.default_rng(4)
PLAYERS, MATCHES = 12, 60
A = RNG.integers(0, PLAYERS, MATCHES)
B = (A + RNG.integers(1, PLAYERS, MATCHES)) % PLAYERS
WON, LOST = RNG.integers(0, 8, MATCHES), RNG.integers(0, 8, MATCHES)


def refitted(until, times=1):
    league = DailyRefit(PLAYERS, A, B, 2.0)
    for start in range(0, until, 10):
        rows = slice(start, start + 10)
        league.learn(rows, times * WON[rows], times * LOST[rows])
        league.begin_day()
    return league


def test_day_by_day_ends_where_one_fit_does():
    league = refitted(MATCHES)
    mode = find_mode(count_pairs(PLAYERS, A, B, WON, LOST), 2.0)
    np.testing.assert_allclose(league.skill, mode.point, atol=1e-6)


def test_the_variance_of_a_difference_is_that_of_the_inverse_hessian():
    league = refitted(40)
    pairs = count_pairs(PLAYERS, A[:40], B[:40], WON[:40], LOST[:40])
    covariance = np.linalg.inv(pairs.curvature(league.skill, 0.0, 2.0, None).matrix.toarray())
    a, b = np.array([0, 3, 5]), np.array([1, 7, 5])
    exact = covariance[a, a] + covariance[b, b] - 2 * covariance[a, b]
    np.testing.assert_allclose(league.difference_variance(a, b), exact, rtol=1e-6, atol=1e-12)


def test_before_any_game_the_prior_alone_is_known():
    league = DailyRefit(PLAYERS, A, B, 2.0)
    variance = league.difference_variance(np.array([0, 1]), np.array([1, 1]))
    np.testing.assert_allclose(variance, [1.0, 0.0], rtol=1e-6)


def test_faded_games_count_for_part_of_themselves():
    faded = refitted(MATCHES, times=2)
    faded.fade(0.5)
    faded.begin_day()
    np.testing.assert_allclose(faded.skill, refitted(MATCHES).skill, atol=1e-6)
