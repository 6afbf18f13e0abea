"""Results as terms of a likelihood: its value by hand, its derivatives by differences."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import betainc, expit

from evenbreak.errors import InputError
from evenbreak.ratings import Results, race_slopes
from evenbreak.ratings.likelihood_terms import likelihood_terms
from rows import each_of

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


# What a race says of a difference: against Fractions, finite differences, and concavity.


NEEDS = st.integers(1, 40)


def exact(p, m, n):
    """Return W(p; m, n), its slope and second derivative in the log-odds, as Fractions."""
    q = 1 - p
    win = sum(math.comb(m - 1 + k, k) * p**m * q**k for k in range(n))
    # dW/dp = p^(m-1) q^(n-1) / B(m, n), and dp/dd = p q.
    per_log_odds = p**m * q**n * m * math.comb(m + n - 1, m)
    slope = per_log_odds / win
    return win, slope, slope * (m * q - n * p - slope)


@each_of("odds", [Fraction(1, 1000), Fraction(1, 3), 1, 2, Fraction(40), 5000])
@each_of("m, n", [(1, 1), (9, 5), (2, 11), (17, 17)])
def test_against_fractions(odds, m, n):
    win, slope, curvature = exact(Fraction(odds) / (1 + odds), m, n)
    got = race_slopes(math.log(odds), m, n)
    assert got.log_win == pytest.approx(
        math.log(win.numerator) - math.log(win.denominator), rel=1e-11
    )
    assert got.slope == pytest.approx(float(slope), rel=1e-10)
    assert got.curvature == pytest.approx(float(curvature), rel=1e-7, abs=1e-11)


@given(st.floats(-60, 60), NEEDS, NEEDS)
def test_the_logarithm_is_concave_and_rises(difference, m, n):
    at = race_slopes(difference, m, n)
    assert at.log_win <= 0.0
    assert 0.0 <= at.slope <= m * (1 + 1e-9)
    assert at.curvature <= 0.0
    below, middle, above = (race_slopes(difference + step, m, n) for step in (-0.5, 0.0, 0.5))
    assert below.slope >= middle.slope * (1 - 1e-9)
    assert middle.slope >= above.slope * (1 - 1e-9)
    assert 2 * middle.log_win >= below.log_win + above.log_win - 1e-9 * abs(middle.log_win)


@given(st.floats(-8, 8), NEEDS, NEEDS)
def test_the_derivatives_are_those_of_the_logarithm(difference, m, n):
    step = 1e-5
    low, at, high = (race_slopes(difference + k * step, m, n) for k in (-1, 0, 1))
    assert (high.log_win - low.log_win) / (2 * step) == pytest.approx(
        float(at.slope), rel=1e-4, abs=1e-7
    )
    assert (high.slope - low.slope) / (2 * step) == pytest.approx(
        float(at.curvature), rel=1e-4, abs=1e-6
    )


def test_a_race_to_one_is_a_game():
    d = np.linspace(-30, 30, 13)
    got = race_slopes(d, 1, 1)
    np.testing.assert_allclose(got.log_win, -np.logaddexp(0, -d), rtol=1e-12)
    np.testing.assert_allclose(got.slope, 1 / (1 + np.exp(d)), rtol=1e-10)


@pytest.mark.parametrize("difference", [-2.0, -40.0, -500.0, -20_000.0])
def test_hopeless_races_keep_finite_logarithms(difference):
    """Far down W = C(m + n - 1, m) p^m but for terms of the order p."""
    got = race_slopes([difference - 1, difference, difference + 1], 90, 60)
    assert np.isfinite(got.log_win).all()
    assert (np.diff(got.log_win) > 0).all()
    if difference <= -40:
        log_chance = math.log(math.comb(149, 90)) + 90 * difference
        assert got.log_win[1] == pytest.approx(log_chance, rel=1e-12)
        assert got.slope[1] == pytest.approx(90, rel=1e-10)


def test_the_two_ways_to_a_tiny_chance_agree(monkeypatch):
    d = np.linspace(-12.0, -4.0, 30)
    plain = race_slopes(d, 20, 13)
    monkeypatch.setattr("evenbreak.ratings.likelihood_terms._FAR", 1e-5)
    far = race_slopes(d, 20, 13)
    for one, other in zip(plain, far, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ((math.nan, 1, 1), "difference must hold finite numbers"),
        ((math.inf, 1, 1), "difference must hold finite numbers"),
        ((0.0, 0, 1), "m or n is below 1"),
        ((0.0, 1, 0), "m or n is below 1"),
    ],
)
def test_wrong_numbers_are_refused(wrong, told):
    with pytest.raises(InputError, match=told):
        race_slopes(*wrong)
