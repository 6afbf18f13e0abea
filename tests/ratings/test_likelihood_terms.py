"""Results as terms of a likelihood: its value by hand, its derivatives by differences."""

import math

import numpy as np
import pytest
from scipy.special import betainc, expit

from evenbreak.ratings import Results
from evenbreak.ratings.likelihood_terms import likelihood_terms

NONE = np.zeros(0, dtype=int)
SCORED = Results.from_names(
    ["Ann", "Bo", "Cy"],
    ["Bo", "Ann", "Ann"],
    [4, 2, 3],
    [2, 4, 5],
    break_format=[4, 5, 0],  # a breaks, b breaks, not known
)
WON = Results(
    SCORED.players, [2, 1], [0, 2], [0, 0], [0, 0],
    race_a=[5, 3], race_b=[3, 3], winner=[1, 2], unscored=[True, True],
)  # fmt: skip
WEIGHTS = np.array([1.0, 0.5, 0.25]), np.array([0.8, 1.0])
SKILL, BETA = np.array([0.3, -0.2, 0.1]), 0.15


@pytest.fixture
def terms():
    return likelihood_terms(SCORED, WON, WEIGHTS, breaks=True)


def test_the_likelihood_is_the_product_of_games_and_races(terms):
    ann, bo, cy = SKILL
    p = expit(ann - bo + BETA)  # Ann breaks both matches with Bo
    by_hand = 4 * math.log(p) + 2 * math.log(1 - p)
    by_hand += 0.5 * (4 * math.log(p) + 2 * math.log(1 - p))
    p = expit(cy - ann)
    by_hand += 0.25 * (3 * math.log(p) + 5 * math.log(1 - p))
    by_hand += 0.8 * math.log(betainc(5, 3, expit(cy - ann)))
    by_hand += 1.0 * math.log(betainc(3, 3, expit(cy - bo)))
    assert terms.log_likelihood(SKILL, BETA) == pytest.approx(by_hand, rel=1e-12)


def test_matches_of_a_pair_with_the_same_breaker_are_one_term(terms):
    assert len(terms.won) == 2
    assert terms.amount == pytest.approx(6 + 3 + 2 + 1.8)
    assert terms.games_with_breaker == pytest.approx(9)


def test_derivatives_are_those_of_the_likelihood(terms):
    gradient, slope = terms.derivatives(SKILL, BETA)
    step = 1e-6
    for k in range(3):
        shift = step * (np.arange(3) == k)
        up, down = (terms.log_likelihood(SKILL + s, BETA) for s in (shift, -shift))
        assert -gradient[k] == pytest.approx((up - down) / (2 * step), rel=1e-6)
    up, down = (terms.log_likelihood(SKILL, BETA + s) for s in (step, -step))
    assert -slope == pytest.approx((up - down) / (2 * step), rel=1e-6)


def test_the_curvature_is_the_slope_of_the_derivatives(terms):
    curvature = terms.curvature(SKILL, BETA, 2.0, 3.0)
    step = 1e-6
    for k in range(3):
        shift = step * (np.arange(3) == k)
        up, down = (terms.derivatives(SKILL + s, BETA) for s in (shift, -shift))
        column = (up[0] - down[0]) / (2 * step) + 2.0 * (np.arange(3) == k)
        np.testing.assert_allclose(curvature.matrix.toarray()[:, k], column, rtol=1e-6, atol=1e-9)
        assert curvature.border[k] == pytest.approx((up[1] - down[1]) / (2 * step), rel=1e-6)
    up, down = (terms.derivatives(SKILL, BETA + s)[1] for s in (step, -step))
    assert curvature.corner == pytest.approx((up - down) / (2 * step) + 3.0, rel=1e-6)


def test_without_the_break_all_games_of_a_pair_are_one_term():
    terms = likelihood_terms(SCORED, WON.select(NONE), (np.ones(3), np.zeros(0)), breaks=False)
    assert (len(terms.won), terms.games_with_breaker) == (2, 0.0)
    assert terms.curvature(SKILL, 0.0, 1.0, None).border is None


def test_who_met_whom(terms):
    assert terms.graph.toarray().tolist() == [[0, 1, 1], [0, 0, 1], [0, 0, 0]]
