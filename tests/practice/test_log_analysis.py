from itertools import accumulate

import numpy as np
import pytest
from scipy.stats import beta, binomtest

from evenbreak.errors import InputError
from evenbreak.games import Drill
from evenbreak.practice import (
    DrillLog,
    LogAnalysis,
    analyze_log,
    drill_statistics,
    fit_progressive,
)

MODEL = 0.85 ** np.arange(9)
_COLUMNS = ("level", "success")


def played(
    success: np.ndarray, sessions: int, length: int, *, seed: int, memory: float = 0.0
) -> DrillLog:
    """Play a log step by step; `memory` lifts a chance after a success, lowers it after a miss."""
    rng = np.random.default_rng(seed)
    level, won, session = [], [], []
    for number in range(sessions):
        at, before = 1, 0.0
        for _ in range(length):
            outcome = rng.random() < success[at - 1] + before
            level.append(at)
            won.append(outcome)
            session.append(number)
            at = min(at + 1, len(success)) if outcome else max(at - 1, 1)
            before = memory if outcome else -memory
    return DrillLog(level, won, session)


def analyzed(log: DrillLog, *, seed: int = 1, replicas: int = 499) -> LogAnalysis:
    return analyze_log(log, rng=np.random.default_rng(seed), replicas=replicas)


@pytest.fixture(scope="module")
def plain() -> LogAnalysis:
    return analyzed(played(MODEL, 8, 60, seed=2))


def test_each_level_has_its_fraction_and_interval(plain: LogAnalysis) -> None:
    log = played(MODEL, 8, 60, seed=2)
    for report in plain.levels:
        there = log.level == report.level
        assert report.attempts == there.sum()
        assert report.successes == (there & log.success).sum()
        assert report.p == report.successes / report.attempts
        wilson = binomtest(report.successes, report.attempts).proportion_ci(method="wilson")
        assert (report.p_low, report.p_high) == tuple(wilson)


def test_the_implied_law_is_the_limit_of_the_chances_seen(plain: LogAnalysis) -> None:
    statistics = drill_statistics(Drill([report.p or 0.0 for report in plain.levels]))
    assert plain.implied.probability == pytest.approx(statistics.distribution.probability)
    assert [report.implied for report in plain.levels] == list(plain.implied.probability)
    assert [report.gain for report in plain.levels] == pytest.approx(statistics.gain)
    assert plain.mean_low < plain.implied.mean < plain.mean_high


def test_fractions_sum_to_1(plain: LogAnalysis) -> None:
    for name in ("visited", "implied", "expected", "p_best"):
        total = list(accumulate(getattr(report, name) for report in plain.levels))[-1]
        assert total == pytest.approx(1.0)


def test_the_lift_is_near_that_of_the_chances_seen(plain: LogAnalysis) -> None:
    lifts = drill_statistics(Drill([report.p or 0.0 for report in plain.levels])).lift
    for report, lift in zip(plain.levels, lifts, strict=True):
        assert report.lift_low <= report.lift <= report.lift_high
        assert report.lift == pytest.approx(lift, abs=0.02)


def test_where_practice_helps_most() -> None:
    """With many attempts at hand the level of the greatest lift is found for sure."""
    success = np.array([0.95, 0.9, 0.3, 0.05])
    analysis = analyzed(played(success, 20, 200, seed=3))
    lifts = np.array(drill_statistics(Drill(success)).lift)
    assert analysis.practice_next is not None
    assert analysis.practice_next.level == lifts.argmax() + 1
    assert analysis.practice_next.p_best > 0.99


def test_few_attempts_leave_it_open() -> None:
    best = analyzed(played(MODEL, 2, 12, seed=4)).practice_next
    assert best is not None
    assert best.p_best < 0.9


def test_nobody_is_sent_to_practice_a_level_without_room() -> None:
    analysis = analyzed(DrillLog([1, 2] * 500 + [1], [1, 0] * 500 + [1]))
    assert analysis.levels[0].lift < 0.01
    assert analysis.practice_next is not None
    assert analysis.practice_next.level == 2


def test_sessions_that_begin_low_make_a_difference_but_no_surprise() -> None:
    log = played(np.full(9, 0.75), 60, 6, seed=5)
    analysis = analyzed(log)
    assert analysis.difference.seen > 0.3
    assert analysis.difference.p_value > 0.05
    for report in analysis.levels:
        assert report.expected == pytest.approx(report.visited, abs=0.03)


def test_stopping_when_it_goes_well_is_found() -> None:
    """Sessions that end at level 7: their ends are higher than chance would have them."""
    rng = np.random.default_rng(12)
    level, won, session = [], [], []
    for number in range(15):
        at, outcome = 1, False
        while not (outcome and at >= 7):
            outcome = bool(rng.random() < MODEL[at - 1])
            level.append(at)
            won.append(outcome)
            session.append(number)
            at = min(at + 1, 9) if outcome else max(at - 1, 1)
    assert analyzed(DrillLog(level, won, session)).difference.p_value < 0.05


@pytest.mark.slow
def test_tests_let_an_honest_log_pass() -> None:
    """Of 40 logs without memory about 4 fall below .1; 12 or more would be a bad test."""
    p_values = np.array(
        [
            [test.p_value for test in (analysis.difference, analysis.memory, analysis.model_test)]
            for seed in range(40)
            if (analysis := analyzed(played(MODEL, 5, 40, seed=seed), replicas=99))
        ]
    )
    assert ((p_values < 0.1).sum(0) < 12).all()
    assert (np.abs(p_values.mean(0) - 0.5) < 0.2).all()


@pytest.mark.parametrize("memory", [0.15, -0.15])
def test_a_memory_is_found(memory: float) -> None:
    analysis = analyzed(played(MODEL, 8, 60, seed=6, memory=memory))
    assert analysis.memory is not None
    assert analysis.memory.p_value < 0.02
    assert np.sign(analysis.memory.seen) == np.sign(memory)
    assert abs(analysis.memory.by_chance) < 0.05


def test_good_days_and_bad_ones_are_no_memory() -> None:
    """Within a day a level is entered as often from below, after a success, as from above."""
    rng = np.random.default_rng(15)
    days = [played(rng.uniform(0.7, 0.95) ** np.arange(9), 1, 40, seed=k) for k in range(12)]
    level, success = (np.concatenate([getattr(day, name) for day in days]) for name in _COLUMNS)
    analysis = analyzed(DrillLog(level, success, np.repeat(range(12), 40)))
    assert analysis.memory is not None
    assert analysis.memory.p_value > 0.05 or analysis.memory.seen < analysis.memory.by_chance


def test_a_wrong_model_is_found_and_a_right_one_kept(plain: LogAnalysis) -> None:
    assert plain.model == fit_progressive(played(MODEL, 8, 60, seed=2))
    assert plain.model_test is not None
    assert plain.model_test.p_value > 0.05
    afraid = MODEL * np.where(np.arange(9) == 4, 0.4, 1)
    test = analyzed(played(afraid, 8, 60, seed=7)).model_test
    assert test is not None
    assert test.p_value < 0.02


def test_the_level_that_is_out_of_line() -> None:
    afraid = MODEL * np.where(np.arange(9) == 4, 0.4, 1)
    analysis = analyzed(played(afraid, 8, 60, seed=7), replicas=9)
    assert analysis.model is not None
    for report in analysis.levels:
        assert report.p_model == pytest.approx(analysis.model.p ** (report.level - 1))
    off = analysis.furthest_off_model
    assert off is not None
    assert off.level == 5
    assert (off.p or 0) < (off.p_model or 0)


def test_level_1_alone() -> None:
    analysis = analyzed(DrillLog([1, 1, 1], [0, 0, 0]))
    assert (analysis.model, analysis.model_test, analysis.memory) == (None, None, None)
    assert analysis.practice_next is None
    assert analysis.levels[0].p_best == 0.0
    assert (analysis.furthest_off_model, analysis.levels[0].p_model) == (None, None)
    assert analysis.implied.probability == (1.0,)
    assert analysis.difference.seen == 0.0


def test_levels_nobody_tried() -> None:
    analysis = analyzed(DrillLog([1, 2, 1, 2, 1], [1, 0, 1, 0, 1], levels=4))
    untried = analysis.levels[2:]
    assert [report.p for report in untried] == [None, None]
    assert [(report.p_low, report.p_high) for report in untried] == [(0.0, 1.0)] * 2
    assert [report.p_best for report in untried] == [0.0, 0.0]


def test_nobody_is_sent_to_practice_a_level_never_missed() -> None:
    faultless = analyzed(DrillLog([1, 2, 2, 2], [1, 1, 1, 1]))
    assert faultless.levels[1].lift_high > 0.0
    assert [report.p_best for report in faultless.levels] == [0.0, 0.0]
    assert faultless.practice_next is None
    best = analyzed(DrillLog([2, 1, 2, 3, 3], [0, 1, 1, 1, 1])).practice_next
    assert best is not None
    assert (best.level, best.p_best) == (2, 1.0)


def test_one_attempt() -> None:
    analysis = analyzed(DrillLog([4], [1]))
    assert analysis.visited.probability == (1,)
    assert [report.attempts for report in analysis.levels] == [0, 0, 0, 1]
    assert analysis.implied.probability == (0, 0, 0, 1)
    assert analysis.difference.seen == 0.0


def test_who_begins_high_and_never_falls_low_is_not_held_up_at_level_1() -> None:
    """Three easier levels that nobody needed change nothing of what is said."""
    log = played(np.array([1.0, 0.8, 0.6, 0.4]), 10, 30, seed=13)
    low = analyzed(log)
    high = analyzed(DrillLog(log.level + 3, log.success, log.session))
    assert log.successes[0] == log.attempts[0]
    assert [report.attempts for report in high.levels[:3]] == [0, 0, 0]
    assert [report.lift for report in high.levels[:3]] == [0.0, 0.0, 0.0]
    assert high.implied.mean - 3 == pytest.approx(low.implied.mean)
    assert high.mean_low < high.implied.mean < high.mean_high
    assert high.difference.seen == pytest.approx(low.difference.seen)
    assert high.difference.by_chance == pytest.approx(low.difference.by_chance, abs=0.02)


def test_levels_above_all_tried_count_as_out_of_reach() -> None:
    log = DrillLog([1, 2, 3, 2] * 20, [1, 1, 0, 0] * 20, np.repeat(range(20), 4), levels=9)
    analysis = analyzed(log)
    assert [report.implied for report in analysis.levels[3:]] == [0.0] * 6
    # Of level 3 none of 20 succeeded, so level 4 may be reached now and then, but is not passed.
    assert analysis.implied.mean < analysis.mean_high < 3


def test_the_interval_of_the_mean_is_that_of_jeffreys() -> None:
    """Level 1 is never missed and level 2 missed thrice: the mean is 1 + 1/(2 - p)."""
    analysis = analyzed(DrillLog([2, 2, 2], [0, 0, 0], session=range(3)), replicas=20_000)
    low, high = beta.ppf([0.025, 0.975], 0.5, 3.5)
    assert analysis.mean_low == pytest.approx(1 + 1 / (2 - low), abs=1e-3)
    assert analysis.mean_high == pytest.approx(1 + 1 / (2 - high), abs=1e-2)


def test_no_advice_rests_on_a_level_nobody_tried() -> None:
    analysis = analyzed(DrillLog([1, 2], [1, 1], levels=3))
    assert analysis.levels[2].lift > 0
    assert analysis.levels[2].p_best == 0.0


def test_the_same_seed_gives_the_same_answer() -> None:
    log = played(MODEL, 3, 30, seed=8)
    assert analyzed(log, seed=9, replicas=50) == analyzed(log, seed=9, replicas=50)
    assert analyzed(log, seed=9, replicas=50) != analyzed(log, seed=10, replicas=50)


def test_replicas_are_one_or_more() -> None:
    with pytest.raises(InputError, match="replicas must"):
        analyzed(DrillLog([1], [1]), replicas=0)
