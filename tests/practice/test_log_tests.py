import numpy as np
import pytest

from evenbreak.practice import DrillLog, fit_progressive
from evenbreak.practice.drill_log import AFTER_MISS, AFTER_SUCCESS
from evenbreak.practice.log_tests import deviance, difference_test, memory_test, model_test


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
