"""What the log of a drill tells: chances, where they lead, what to practise, what is odd.

Every test here plays the log again many times by chance, with its starts and lengths, and
asks how often chance alone goes as far as the log did. A formula would mislead. The share
of attempts at each level and the chances estimated from the same log are nearly bound to
agree: a session that keeps to the drill's rule crosses between two levels upwards as often
as downwards, give or take once. And over short sessions even chances without any memory
seem, on average, to have one (Miller & Sanjurjo 2018).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.checks import whole
from evenbreak.practice.drill_log import AFTER_MISS, AFTER_SUCCESS
from evenbreak.practice.levels import level_gains, level_laws, level_lifts
from evenbreak.practice.played_again import play_again
from evenbreak.practice.progressive_fit import ProgressiveFit, deviance, fit_progressive
from evenbreak.stats.summary import Distribution

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.practice.drill_log import DrillLog

__all__ = ["LevelReport", "LogAnalysis", "PlayedAgainTest", "analyse_log"]

_CONFIDENCE = 0.95
_QUANTILES = (0.5 - _CONFIDENCE / 2, 0.5, 0.5 + _CONFIDENCE / 2)


class LevelReport(NamedTuple):
    """What a log tells about one level.

    Parameters
    ----------
    level, attempts, successes
        the level, how often it was attempted and with how many successes.
    p, p_low, p_high
        P(success | an attempt at this level): the fraction seen, None without attempts,
        and its 95 % interval (Wilson).
    p_model
        the chance at this level by the model p^(level - 1) that was fitted; None if none was.
    visited
        the fraction of all attempts that were at this level.
    implied
        the fraction that would be in the long run, with the chances p, from level 1.
    expected
        the mean fraction in logs with the same starts and lengths, with the chances p.
    gain
        the derivative of the long-run mean level to p; see `DrillStatistics`.
    lift, lift_low, lift_high
        by how much the long-run mean level rises with the chance at this level 0.05
        higher, or 1 if it is above 0.95 already: the median over chances that fit the log, and the
        95 % interval.
    p_best
        how probable it is that no other attempted level has a greater lift.
    """

    level: int
    attempts: int
    successes: int
    p: float | None
    p_low: float
    p_high: float
    p_model: float | None
    visited: float
    implied: float
    expected: float
    gain: float
    lift: float
    lift_low: float
    lift_high: float
    p_best: float


class PlayedAgainTest(NamedTuple):
    """A figure of a log beside the same figure of logs that chance plays.

    Parameters
    ----------
    seen
        the figure of the log.
    by_chance
        its mean over the logs that chance played.
    p_value
        the probability that chance goes as far as the log; small: chance explains it badly.
    """

    seen: float
    by_chance: float
    p_value: float


@dataclass(frozen=True)
class LogAnalysis:
    """What the log of a drill tells.

    Parameters
    ----------
    levels
        what it tells about each level.
    visited
        the law of the level over the attempts of the log, exact.
    implied
        the law of the level in the long run, with the chances seen, from level 1.
    mean_low, mean_high
        the 95 % interval of the long-run mean level.
    difference
        test of visited against implied: half the sum of the absolute differences, the
        fraction of attempts that would have to be at another level.
    memory
        test of chances that depend on what came before: how much higher the fraction of
        successes is after a success than after a miss, at the same level. None where no
        level was attempted after both.
    model
        the model p_i = p^(i - 1) fitted to the log; None without attempts above level 1.
    model_test
        test of that model against a chance of its own for each level: the deviance. None
        unless two levels above the first were attempted.
    replicas
        how many logs chance played for each test.
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
    def practise_next(self) -> LevelReport | None:
        """The level that is most probably the one of the greatest lift; None if none lifts."""
        if not any(report.lift_high for report in self.levels):
            return None
        return max(self.levels, key=lambda report: report.p_best)

    @property
    def furthest_off_model(self) -> LevelReport | None:
        """The level whose successes are the most standard deviations away from the model's."""

        def away(report: LevelReport) -> float:
            p = report.p_model or 0.0
            spread = (report.attempts * p * (1.0 - p)) ** 0.5
            return abs(report.successes - report.attempts * p) / spread if spread else 0.0

        return max(self.levels, key=away) if self.model else None


def analyse_log(log: DrillLog, *, rng: np.random.Generator, replicas: int = 1999) -> LogAnalysis:
    """Return what the log of a drill tells, with how sure it is.

    What is said of the long run is conditional on chances that stay as they are. Levels
    that were not attempted count as never succeeding in what `implied`, `expected` and
    `gain` are worked out from.

    Parameters
    ----------
    log
        the attempts.
    rng
        where chance comes from.
    replicas
        how many logs to play by chance for each test, and how many sets of chances to
        draw for the intervals of lifts and of the mean.

    Raises
    ------
    InputError
        if `replicas` is not a whole number from 1 up.

    Notes
    -----
    Source: exercise 5.1. Intervals of lifts and of the mean: the chances are drawn from
    their posterior laws under Jeffreys' prior, Beta(successes + 1/2, misses + 1/2), so a
    level of three attempts counts as little as it should. Intervals of p: Wilson 1927.
    The weights of the memory figure are those of Mantel & Haenszel 1959.

    >>> from evenbreak.practice import DrillLog
    >>> evening = [(1, 1), (2, 1), (3, 0), (2, 0), (1, 1), (2, 0), (1, 0), (1, 1)]
    >>> level, success = zip(*evening * 20, strict=True)
    >>> log = DrillLog(level, success, session=np.repeat(range(20), 8))
    >>> analysis = analyse_log(log, rng=np.random.default_rng(1), replicas=199)
    >>> round(analysis.visited.mean, 3), round(analysis.implied.mean, 3)
    (1.625, 1.75)
    >>> analysis.practise_next.level, analysis.memory.p_value
    (2, 0.005)
    """
    replicas = whole(replicas, "replicas", at_least=1)
    attempts, successes = log.attempts, log.successes
    p_seen = successes / np.maximum(attempts, 1)
    law = level_laws(p_seen)
    played = play_again(log, p_seen, replicas=replicas, rng=rng)
    mean_low, mean_high, lifts = _drawn_lifts(log, rng, replicas)
    values = tuple(range(1, len(attempts) + 1))
    model = fit_progressive(log) if attempts[1:].any() else None
    reports = _reports(log, law, level_gains(p_seen, law), played, lifts, model)
    return LogAnalysis(
        reports,
        Distribution.of(log.level.tolist()),
        Distribution(values, tuple(law.tolist())),
        mean_low,
        mean_high,
        _larger(_distance(log.outcomes), _distance(played)),
        _memory_test(log, played),
        model,
        _model_test(log, model, replicas, rng),
        replicas,
    )


def _reports(
    log: DrillLog,
    law: NDArray[np.float64],
    gain: NDArray[np.float64],
    played: NDArray[np.int64],
    lifts: NDArray[np.float64],
    model: ProgressiveFit | None,
) -> tuple[LevelReport, ...]:
    from scipy.stats import binomtest

    attempts, successes = log.attempts, log.successes
    low, lift, high = np.quantile(lifts, _QUANTILES, axis=0)
    tried = np.where(attempts > 0, lifts, -1.0)
    best = np.bincount(tried.argmax(1), minlength=len(attempts)) / len(lifts)
    expected = played.sum((2, 3)).mean(0) / len(log)
    reports = []
    for i, (n, won) in enumerate(zip(attempts.tolist(), successes.tolist(), strict=True)):
        p_low, p_high = (
            binomtest(won, n).proportion_ci(_CONFIDENCE, method="wilson") if n else (0.0, 1.0)
        )
        numbers = (n / len(log), law[i], expected[i], gain[i], lift[i], low[i], high[i], best[i])
        p = won / n if n else None
        p_model = None if model is None else model.p**i
        reports.append(
            LevelReport(
                i + 1, n, won, p, float(p_low), float(p_high), p_model, *map(float, numbers)
            )
        )
    return tuple(reports)


def _drawn_lifts(
    log: DrillLog, rng: np.random.Generator, draws: int
) -> tuple[float, float, NDArray[np.float64]]:
    """Return the interval of the mean level, and the lifts of chances that fit the log.

    Shape (draws, levels): each row goes with one draw of all chances.
    """
    misses = log.attempts - log.successes
    chances = rng.beta(log.successes + 0.5, misses + 0.5, size=(draws, len(misses)))
    laws = level_laws(chances)
    low, _, high = np.quantile(laws @ np.arange(1.0, len(misses) + 1), _QUANTILES)
    return float(low), float(high), level_lifts(chances)


def _distance(outcomes: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return half the absolute differences of visited and implied fractions, log by log."""
    attempts = outcomes.sum((-1, -2))
    p = outcomes[..., 1].sum(-1) / np.maximum(attempts, 1)
    visited = attempts / attempts.sum(-1, keepdims=True)
    return np.asarray(np.abs(visited - level_laws(p)).sum(-1) / 2.0)


def _memory(outcomes: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return how much likelier success was after a success than after a miss, level by level.

    The differences of the levels are weighted as Mantel and Haenszel do; NaN where no
    level was attempted after both.
    """
    after = outcomes[..., [AFTER_MISS, AFTER_SUCCESS], :]
    attempts = after.sum(-1)
    rate = after[..., 1] / np.maximum(attempts, 1)
    weight = attempts.prod(-1) / np.maximum(attempts.sum(-1), 1)
    with np.errstate(invalid="ignore"):
        return np.asarray((weight * (rate[..., 1] - rate[..., 0])).sum(-1) / weight.sum(-1))


def _memory_test(log: DrillLog, played: NDArray[np.int64]) -> PlayedAgainTest | None:
    seen, by_chance = float(_memory(log.outcomes)), _memory(played)
    by_chance = by_chance[~np.isnan(by_chance)]
    if np.isnan(seen) or not len(by_chance):
        return None
    mean = float(by_chance.mean())
    test = _larger(abs(seen - mean), np.abs(by_chance - mean))
    return PlayedAgainTest(seen, mean, test.p_value)


def _model_test(
    log: DrillLog, model: ProgressiveFit | None, replicas: int, rng: np.random.Generator
) -> PlayedAgainTest | None:
    """Test the model on logs that it plays; level 1 keeps the chance seen, as it is left out."""
    if model is None or np.count_nonzero(log.attempts[1:]) < 2:
        return None
    success = np.power(model.p, np.arange(len(log.attempts), dtype=np.float64))
    if log.attempts[0]:
        success[0] = log.successes[0] / log.attempts[0]
    played = play_again(log, success, replicas=replicas, rng=rng).sum(2)
    seen = deviance(log.successes, log.attempts - log.successes)
    return _larger(seen, deviance(played[..., 1], played[..., 0]))


def _larger(seen: float | NDArray[np.float64], by_chance: NDArray[np.float64]) -> PlayedAgainTest:
    """Return how often chance is as large as what was seen; the log itself counts as one."""
    as_large = int(np.count_nonzero(by_chance >= float(seen) * (1.0 - 1e-12)))
    p_value = (1 + as_large) / (1 + len(by_chance))
    return PlayedAgainTest(float(seen), float(by_chance.mean()), p_value)
