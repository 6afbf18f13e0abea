import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar
from scipy.stats import chi2

from evenbreak.errors import InputError
from evenbreak.practice import DrillLog, fit_progressive
from evenbreak.practice.log_tests import deviance, likeliest_p

counts = st.lists(st.tuples(st.integers(0, 50), st.integers(0, 50)), min_size=2, max_size=9)


def log_of(counted: list[tuple[int, int]]) -> DrillLog:
    """Return a log with so many successes and misses at each level, each in its own session."""
    level = [i for i, pair in enumerate(counted, 1) for _ in range(sum(pair))]
    success = [won for s, f in counted for won in [True] * s + [False] * f]
    return DrillLog(level, success, range(len(level)))


def log_likelihood(p: float, counted: list[tuple[int, int]]) -> float:
    """Return the logarithm of the likelihood, term by term."""
    total = 0.0
    for shots, (won, lost) in enumerate(counted[1:], 1):
        total += won * shots * math.log(p) + lost * math.log(1 - p**shots)
    return total


def test_one_level_above_the_first_is_a_plain_fraction() -> None:
    fit = fit_progressive(log_of([(5, 2), (30, 10)]))
    assert fit.p == pytest.approx(0.75, rel=1e-14)
    assert (fit.attempts, fit.level_1_attempts, fit.level_1_misses) == (40, 7, 2)


def test_by_hand() -> None:
    # 3 log p + 2 log(1 - p^2) is greatest at p^2 = 3/7.
    assert fit_progressive(log_of([(1, 0), (3, 0), (0, 2)])).p == pytest.approx(math.sqrt(3 / 7))


@given(counts)
def test_no_other_p_is_likelier(counted: list[tuple[int, int]]) -> None:
    won, lost = (sum(pair[k] for pair in counted[1:]) for k in (0, 1))
    if not won or not lost:
        return
    p = fit_progressive(log_of(counted)).p
    best = minimize_scalar(
        lambda q: -log_likelihood(q, counted), bounds=(1e-9, 1 - 1e-9), method="bounded"
    )
    assert log_likelihood(p, counted) >= -best.fun - 1e-9 * abs(best.fun)


@given(counts, st.sampled_from([0.5, 0.95]))
def test_at_the_ends_of_the_interval_the_likelihood_is_down(
    counted: list[tuple[int, int]], confidence: float
) -> None:
    if not sum(map(sum, counted[1:])):
        return
    fit = fit_progressive(log_of(counted), confidence=confidence)
    assert fit.low <= fit.p <= fit.high
    allowed = chi2.ppf(confidence, 1) / 2
    top = log_likelihood(fit.p, counted) if 0 < fit.p < 1 else 0.0
    for end, bound in ((fit.low, 0.0), (fit.high, 1.0)):
        if end != bound:
            assert top - log_likelihood(end, counted) == pytest.approx(allowed, rel=1e-6)


def test_all_successes_and_no_success() -> None:
    allowed = chi2.ppf(0.95, 1) / 2
    sure = fit_progressive(log_of([(1, 0), (4, 0), (3, 0)]))
    assert (sure.p, sure.high) == (1.0, 1.0)
    assert sure.low == pytest.approx(math.exp(-allowed / 10))
    never = fit_progressive(log_of([(4, 0), (0, 4)]))
    assert (never.p, never.low) == (0.0, 0.0)
    assert never.high == pytest.approx(1 - math.exp(-allowed / 4))


def test_level_1_alone_tells_nothing() -> None:
    with pytest.raises(InputError, match="no attempt above level 1"):
        fit_progressive(log_of([(10, 5)]))
    assert np.isnan(likeliest_p(np.array([10, 0]), np.array([5, 0])))


@pytest.mark.parametrize("confidence", [0, 1, 95, math.nan])
def test_confidence_is_between_0_and_1(confidence: float) -> None:
    with pytest.raises(InputError, match="confidence is"):
        fit_progressive(log_of([(1, 0), (1, 1)]), confidence=confidence)


def test_many_logs_at_once() -> None:
    won = np.array([[9, 5, 2], [9, 8, 0], [9, 0, 0]])
    lost = np.array([[0, 5, 2], [0, 2, 0], [3, 4, 0]])
    p = likeliest_p(won, lost)
    assert p.tolist() == [likeliest_p(*row) for row in zip(won, lost, strict=True)]
    assert p[1:] == pytest.approx([0.8, 0.0])


def test_deviance_is_0_where_the_model_fits_and_as_by_hand_where_not() -> None:
    assert deviance(np.array([1, 8, 16]), np.array([0, 2, 9])) == pytest.approx(0.0, abs=1e-12)
    # Level 1 does not count: the model says nothing of it.
    assert deviance(np.array([1, 8, 16]), np.array([9, 2, 9])) == pytest.approx(0.0, abs=1e-12)
    counted = [(9, 0), (5, 5), (10, 0)]
    p = fit_progressive(log_of(counted)).p
    free = 10 * math.log(0.5)
    assert deviance(np.array([9, 5, 10]), np.array([0, 5, 0])) == pytest.approx(
        2 * (free - log_likelihood(p, counted))
    )
