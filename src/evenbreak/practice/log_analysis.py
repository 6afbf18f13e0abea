"""Analyze a drill log: chances, their long-run effect, what to practice, what stands out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import generator_of, whole
from evenbreak.practice.drill_log import DrillLog
from evenbreak.practice.drills import chances_seen, level_gains, level_laws, level_lifts
from evenbreak.practice.log_tests import (
    PlayedAgainTest,
    ProgressiveFit,
    difference_test,
    fit_progressive,
    memory_test,
    model_test,
    play_again,
)
from evenbreak.stats.summary import Distribution

_CONFIDENCE = 0.95
_QUANTILES = (0.5 - _CONFIDENCE / 2, 0.5, 0.5 + _CONFIDENCE / 2)


class LevelReport(NamedTuple):
    """One level in a log.

    Parameters
    ----------
    level, attempts, successes
        the level, and the attempts and successes at it in the log.
    p, p_low, p_high
        P(success | an attempt at this level): the observed fraction (None without attempts) and its
        95% interval (Wilson).
    p_model
        the chance at this level from the fitted model p^(level - 1); None without a model.
    visited
        the fraction of all attempts that were at this level.
    expected
        the mean of that fraction in logs with the same starts and lengths, with the chances p.
    implied
        that fraction in the long run, with the chances p, starting at level 1.
    gain
        the derivative of the long-run mean level with respect to p; see `DrillStatistics`.
    lift, lift_low, lift_high
        the rise in the long-run mean level if the chance at this level is 0.05 higher (or 1, if it
        is already above 0.95): the median over chances that fit the log, and the 95% interval.
    p_best
        the probability that this level has the greatest positive lift of all levels with a miss.
        Levels without a miss or without attempts are not candidates for practice.
    """

    level: int
    attempts: int
    successes: int
    p: float | None
    p_low: float
    p_high: float
    p_model: float | None
    visited: float
    expected: float
    implied: float
    gain: float
    lift: float
    lift_low: float
    lift_high: float
    p_best: float


@dataclass(frozen=True)
class LogAnalysis:
    """Analysis of a drill log.

    Parameters
    ----------
    visited
        the exact distribution of the level over the attempts in the log.
    implied
        the distribution of the level in the long run, with the observed chances, starting at level
        1.
    mean_low, mean_high
        the 95% interval of the long-run mean level.
    difference
        test of visited against implied: half the sum of the absolute differences, which is
        the fraction of attempts that would have to be at another level.
    memory
        test of whether a chance depends on the attempt before: the success rate after a
        success minus that after a miss, at the same level. None if no level was attempted after
        both.
    model
        the model p_i = p^(i - 1) fitted to the log; None without attempts above level 1.
    model_test
        test of that model against a separate chance for each level: the deviance. None unless
        two levels above the first were attempted.
    replicas
        the number of simulated logs for each test.
    """

    levels: tuple[LevelReport, ...]
    visited: Distribution
    implied: Distribution
    mean_low: float
    mean_high: float
    difference: PlayedAgainTest
    memory: PlayedAgainTest | None
    model: ProgressiveFit | None
    model_test: PlayedAgainTest | None
    replicas: int

    @property
    def practice_next(self) -> LevelReport | None:
        """The level with the greatest `p_best`; None if no level with a miss has a lift."""
        best = max(self.levels, key=lambda report: report.p_best)
        return best if best.p_best else None

    @property
    def furthest_off_model(self) -> LevelReport | None:
        """The level whose successes are the most standard deviations from the model's."""

        def away(report: LevelReport) -> float:
            p = report.p_model or 0.0
            spread = (report.attempts * p * (1.0 - p)) ** 0.5
            return abs(report.successes - report.attempts * p) / spread if spread else 0.0

        return max(self.levels, key=away) if self.model else None


def analyze_log(
    log: DrillLog, *, rng: np.random.Generator | int, replicas: int = 1999
) -> LogAnalysis:
    """Return what a drill log shows, and how certain it is.

    Statements about the long run assume that the chances stay the same, and that untried levels
    always succeed if they are below all those tried, and never succeed otherwise.

    Parameters
    ----------
    rng
        a generator or a seed.
    replicas
        number of simulated logs for each test, and of draws of chances for the intervals of the
        lifts and the mean.

    Raises
    ------
    InputError
        if `replicas` is not a whole number from 1 up.

    Notes
    -----
    Source: exercise 5.1. For the intervals of the lifts and the mean, chances are drawn from their
    posterior distributions under Jeffreys' prior, Beta(successes + 1/2, misses + 1/2), so a level
    with three attempts counts as little as it should. Intervals of p: Wilson 1927. The memory test
    uses the weights of Mantel & Haenszel 1959.

    >>> from evenbreak.practice import DrillLog
    >>> evening = [(1, 1), (2, 1), (3, 0), (2, 0), (1, 1), (2, 0), (1, 0), (1, 1)]
    >>> level, success = zip(*evening * 20, strict=True)
    >>> log = DrillLog(level, success, session=np.repeat(range(20), 8))
    >>> analysis = analyze_log(log, rng=np.random.default_rng(1), replicas=199)
    >>> round(analysis.visited.mean, 3), round(analysis.implied.mean, 3)
    (1.625, 1.75)
    >>> analysis.practice_next.level, analysis.memory.p_value
    (2, 0.005)
    """
    replicas = whole(replicas, "replicas", at_least=1)
    attempts = log.attempts
    p_seen = chances_seen(attempts, log.successes)
    law = level_laws(p_seen)
    rng = generator_of(rng)
    played = play_again(log, p_seen, replicas=replicas, rng=rng)
    mean_low, mean_high, lifts = _drawn_lifts(log, p_seen, rng, replicas)
    values = tuple(range(1, len(attempts) + 1))
    model = fit_progressive(log) if attempts[1:].any() else None
    reports = _reports(log, law, level_gains(p_seen, law), played, lifts, model)
    return LogAnalysis(
        reports,
        Distribution.of(log.level.tolist()),
        Distribution(values, tuple(law.tolist())),
        mean_low,
        mean_high,
        difference_test(log, played),
        memory_test(log, played),
        model,
        None if model is None else model_test(log, model.p, replicas=replicas, rng=rng),
        replicas,
    )


def _reports(
    log: DrillLog,
    law: Floats,
    gain: Floats,
    played: Ints,
    lifts: Floats,
    model: ProgressiveFit | None,
) -> tuple[LevelReport, ...]:
    from scipy.stats import binomtest

    attempts, successes = log.attempts, log.successes
    low, lift, high = np.quantile(lifts, _QUANTILES, axis=0)
    missed = np.where(attempts > successes, lifts, 0.0)
    first = missed.argmax(1)[missed.any(1)]
    best = np.bincount(first, minlength=len(attempts)) / len(lifts)
    expected = played.sum((2, 3)).mean(0) / len(log)
    reports = []
    for i, (n, won) in enumerate(zip(attempts.tolist(), successes.tolist(), strict=True)):
        p_low, p_high = (
            binomtest(won, n).proportion_ci(_CONFIDENCE, method="wilson") if n else (0.0, 1.0)
        )
        numbers = (n / len(log), expected[i], law[i], gain[i], lift[i], low[i], high[i], best[i])
        p = won / n if n else None
        p_model = None if model is None else model.p**i
        reports.append(
            LevelReport(
                i + 1, n, won, p, float(p_low), float(p_high), p_model, *map(float, numbers)
            )
        )
    return tuple(reports)


def _drawn_lifts(
    log: DrillLog, p_seen: Floats, rng: np.random.Generator, draws: int
) -> tuple[float, float, Floats]:
    """Return the interval of the mean level, and the lifts for chances that fit the log.

    The lifts have shape (draws, levels): one row for each draw of all the chances.
    """
    misses = log.attempts - log.successes
    drawn = rng.beta(log.successes + 0.5, misses + 0.5, size=(draws, len(misses)))
    chances = np.where(log.attempts > 0, drawn, p_seen)
    laws = level_laws(chances)
    low, _, high = np.quantile(laws @ np.arange(1.0, len(misses) + 1), _QUANTILES)
    return float(low), float(high), level_lifts(chances)
