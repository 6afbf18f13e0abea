"""Is anything odd in a drill log? Tests against logs that chance plays.

Each test plays the log again many times by chance, with its starts and lengths, and asks
how often chance alone goes as far as the log did. A formula would mislead. The fractions of
attempts at each level and the chances estimated from the same log are nearly bound to
agree: a session that keeps to the drill's rule crosses between two levels upwards as often
as downwards, give or take once. And over short sessions even chances without any memory
seem, on average, to have one (Miller & Sanjurjo 2018).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.practice.drill_log import AFTER_MISS, AFTER_SUCCESS
from evenbreak.practice.levels import chances_seen, level_laws
from evenbreak.practice.played_again import play_again
from evenbreak.practice.progressive_fit import deviance

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.practice.drill_log import DrillLog


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


def difference_test(log: DrillLog, played: NDArray[np.int64]) -> PlayedAgainTest:
    """Test the levels visited against those that the chances seen lead to in the long run.

    The figure is half the sum of the absolute differences of the two laws. It is large
    where sessions are short, so only `by_chance` says what to make of it; one that chance
    does not reach tells of how sessions begin and end.

    Parameters
    ----------
    log
        the log.
    played
        shape (replicas, levels, 3, 2): logs that `play_again` made with the chances seen.
    """
    return _larger(_distance(log.outcomes), _distance(played))


def memory_test(log: DrillLog, played: NDArray[np.int64]) -> PlayedAgainTest | None:
    """Test whether success is as likely after a success as after a miss, at the same level.

    The figure is the difference of the two fractions, the levels weighted as Mantel and
    Haenszel do; the test is two-sided about its mean by chance. None where no level was
    attempted after both.

    Parameters
    ----------
    log, played
        as in `difference_test`.
    """
    seen, by_chance = float(_memory(log.outcomes)), _memory(played)
    by_chance = by_chance[~np.isnan(by_chance)]
    if np.isnan(seen) or not len(by_chance):
        return None
    mean = float(by_chance.mean())
    test = _larger(abs(seen - mean), np.abs(by_chance - mean))
    return PlayedAgainTest(seen, mean, test.p_value)


def model_test(
    log: DrillLog, p: float, *, replicas: int, rng: np.random.Generator
) -> PlayedAgainTest | None:
    """Test the model p_i = p^(i - 1) against a chance of its own for each level.

    The figure is the deviance, twice the logarithm of the likelihood ratio. The logs are
    played with the model's chances, but at level 1, of which the fit says nothing, with the
    chance seen. None unless two levels above the first were attempted.

    Parameters
    ----------
    log
        the log.
    p
        the p that fits the log best.
    replicas, rng
        as in `play_again`.
    """
    if np.count_nonzero(log.attempts[1:]) < 2:
        return None
    success = np.power(p, np.arange(len(log.attempts), dtype=np.float64))
    if log.attempts[0]:
        success[0] = log.successes[0] / log.attempts[0]
    played = play_again(log, success, replicas=replicas, rng=rng).sum(2)
    seen = deviance(log.successes, log.attempts - log.successes)
    return _larger(seen, deviance(played[..., 1], played[..., 0]))


def _distance(outcomes: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return half the absolute differences of visited and implied fractions, log by log."""
    attempts = outcomes.sum((-1, -2))
    p = chances_seen(attempts, outcomes[..., 1].sum(-1))
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


def _larger(seen: float | NDArray[np.float64], by_chance: NDArray[np.float64]) -> PlayedAgainTest:
    """Return how often chance is as large as what was seen; the log itself counts as one."""
    as_large = int(np.count_nonzero(by_chance >= float(seen) * (1.0 - 1e-12)))
    p_value = (1 + as_large) / (1 + len(by_chance))
    return PlayedAgainTest(float(seen), float(by_chance.mean()), p_value)
