import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar
from scipy.stats import chi2

from evenbreak.errors import InputError
from evenbreak.practice import DrillLog, fit_progressive
from evenbreak.practice.drill_log import AFTER_MISS, AFTER_START, AFTER_SUCCESS
from evenbreak.practice.log_tests import (
    deviance,
    difference_test,
    likeliest_p,
    memory_test,
    model_test,
    play_again,
)


def outcomes(*logs: DrillLog) -> np.ndarray:
    return np.array([log.outcomes for log in logs])


def test_the_difference_is_the_fraction_at_another_level() -> None:
    # Of 4 attempts 2, 1, 1 at the levels; by 1/2, 1, 0 the limit is 0, 1/2, 1/2.
    log = DrillLog([1, 1, 2, 3], [0, 1, 1, 0])
    test = difference_test(log, outcomes(log))
    assert test.seen == pytest.approx(0.5)
    assert (test.by_chance, test.p_value) == (test.seen, 1.0)


def test_the_p_value_counts_the_log_itself() -> None:
    log = DrillLog([1, 1, 2, 3], [0, 1, 1, 0])
    even = DrillLog([1, 1, 1, 1], [0, 0, 0, 0], levels=3)
    assert difference_test(log, outcomes(*[even] * 3)).p_value == 1 / 4
    assert difference_test(log, outcomes(even, log, log)).p_value == 3 / 4


def test_memory_weighs_the_levels() -> None:
    """Mantel and Haenszel: a level of m attempts after a miss, n after a success, has mn/(m+n)."""
    log = DrillLog([1, 2, 3, 2, 1, 1], [1, 1, 0, 0, 0, 0])
    counts = np.zeros((2, 3, 3, 2), dtype=np.int64)
    counts[:, 0, AFTER_MISS], counts[:, 0, AFTER_SUCCESS] = (3, 1), (1, 3)
    counts[:, 1, AFTER_MISS], counts[:, 1, AFTER_SUCCESS] = (0, 2), (1, 1)
    counts[1, 2, AFTER_MISS] = (5, 5)  # with nothing after a success: no weight
    test = memory_test(log, counts)
    assert test is not None
    # Level 1 has weight 16/8 and 3/4 - 1/4, level 2 weight 4/4 and 1/2 - 1.
    assert test.by_chance == pytest.approx((2 * 0.5 - 1 * 0.5) / 3)


def test_memory_needs_a_level_after_both() -> None:
    # The last level repeats: level 2 comes only after successes, level 1 only after misses.
    log = DrillLog([1, 2, 2, 2, 1, 1], [1, 1, 1, 0, 0, 1])
    assert memory_test(log, outcomes(log)) is None


def test_memory_does_not_compare_levels_with_each_other() -> None:
    """Level 1 is easy and comes after misses, level 3 is hard and comes after successes."""
    log = DrillLog([1, 2, 3, 2, 3, 2, 1, 1], [1, 1, 0, 1, 0, 0, 0, 1])
    test = memory_test(log, outcomes(log))
    assert test is not None
    # Level 2: 1 of 1 after a success, 1 of 2 after a miss; no other level has both.
    assert test.seen == pytest.approx(1 - 1 / 2)


def test_the_model_is_tested_by_its_deviance() -> None:
    log = DrillLog([1, 2, 3, 2, 3, 2, 1, 2], [1, 1, 0, 1, 0, 0, 1, 0])
    p = fit_progressive(log).p
    test = model_test(log, p, replicas=500, rng=np.random.default_rng(1))
    assert test is not None
    won, lost = {2: 2, 3: 0}, {2: 2, 3: 2}
    free = 4 * np.log(0.5)
    model = sum(won[i] * (i - 1) * np.log(p) + lost[i] * np.log(1 - p ** (i - 1)) for i in (2, 3))
    assert test.seen == pytest.approx(2 * (free - model))
    assert test.p_value > 0.1


def test_the_model_is_played_with_the_chance_seen_at_level_1() -> None:
    """Who always misses at level 1 plays levels 2 and 3 only where a session begins there."""
    level, success = [1] * 50 + [2, 3], [0] * 50 + [0, 0]
    log = DrillLog(level, success, session=[1] * 50 + [2, 3])
    test = model_test(log, 0.5, replicas=200, rng=np.random.default_rng(1))
    assert test is not None
    # One attempt at each: by hand the deviances of the four courses, with the model's chances.
    mean = sum(
        chance * deviance(np.array([0, a, b]), np.array([50, 1 - a, 1 - b]))
        for a, b, chance in ((0, 0, 3 / 8), (0, 1, 1 / 8), (1, 0, 3 / 8), (1, 1, 1 / 8))
    )
    assert test.by_chance == pytest.approx(mean, abs=0.3)


def test_one_level_above_the_first_cannot_contradict_the_model() -> None:
    log = DrillLog([1, 2, 1, 2], [1, 0, 1, 1])
    assert model_test(log, 0.5, replicas=5, rng=np.random.default_rng(1)) is None


def test_sure_chances_leave_nothing_to_chance() -> None:
    """With chances of 0 and 1 each stretch has one course, which a log can tell."""
    course = DrillLog([1, 2, 3, 2, 3, 1, 2, 3], [1, 1, 0, 1, 0, 1, 1, 0], [1] * 5 + [2] * 3)
    rng = np.random.default_rng(1)
    played = play_again(course, np.array([1.0, 1.0, 0.0]), replicas=3, rng=rng)
    assert played.tolist() == [course.outcomes.tolist()] * 3


def test_starts_and_lengths_are_those_of_the_log() -> None:
    log = DrillLog([3, 2, 3, 1, 2, 3], [0, 1, 1, 1, 1, 0], [1, 1, 1, 2, 2, 3])
    played = play_again(log, np.full(3, 0.5), replicas=50, rng=np.random.default_rng(2))
    assert (played.sum((1, 2, 3)) == 6).all()
    assert (played[:, :, AFTER_START].sum(-1) == [1, 0, 2]).all()


def test_fractions_of_successes_are_the_chances() -> None:
    log = DrillLog([1] * 40, [0] * 40, levels=3)
    success = np.array([0.7, 0.4, 0.2])
    played = play_again(log, success, replicas=2000, rng=np.random.default_rng(3)).sum((0, 2))
    attempts = played.sum(-1)
    assert np.abs(played[:, 1] / attempts - success).max() < 4 / np.sqrt(attempts.min())


def test_expected_attempts_are_those_of_the_chain() -> None:
    n, steps = 3, 7
    success = np.array([0.7, 0.4, 0.2])
    M = np.zeros((n, n))
    for i, p in enumerate(success):
        M[min(i + 1, n - 1), i] += p
        M[max(i - 1, 0), i] += 1 - p
    density, visits = np.eye(n)[0], np.zeros(n)
    for _ in range(steps):
        visits += density
        density = M @ density
    level = [1, 2, 3, 2, 1, 2, 1]
    log = DrillLog(level, [1, 1, 0, 0, 1, 0, 1], levels=n)
    played = play_again(log, success, replicas=20_000, rng=np.random.default_rng(4))
    assert played.sum((2, 3)).mean(0) == pytest.approx(visits, abs=0.05)


def test_many_sessions_are_played_a_part_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    log = DrillLog([1, 2] * 10, [1, 0] * 10, np.repeat(range(10), 2))
    monkeypatch.setattr("evenbreak.practice.log_tests._AT_ONCE", 25)
    played = play_again(log, np.array([0.5, 0.5]), replicas=7, rng=np.random.default_rng(5))
    assert played.shape == (7, 2, 3, 2)
    assert (played.sum((1, 2, 3)) == 20).all()


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
    with pytest.raises(InputError, match="from attempts above level 1"):
        fit_progressive(log_of([(10, 5)]))
    assert np.isnan(likeliest_p(np.array([10, 0]), np.array([5, 0])))


@pytest.mark.parametrize("confidence", [0, 1, 95, math.nan])
def test_confidence_is_between_0_and_1(confidence: float) -> None:
    with pytest.raises(InputError, match="confidence must"):
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
