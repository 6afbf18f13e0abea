"""Does anything stand out in a drill log? Tests against simulated logs.

Each test simulates the log many times, with the same starts and lengths, and counts how often
chance alone gives a figure as extreme as that of the log. A formula would mislead: the
fractions of attempts at each level and the chances estimated from the same log almost have to
agree, since a session that keeps to the rule crosses between two levels upwards as often as
downwards, give or take once. And in short sessions even chances without memory seem, on
average, to have one (Miller & Sanjurjo 2018).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.practice.drill_log import AFTER_MISS, AFTER_SUCCESS, DrillLog
from evenbreak.practice.levels import chances_seen, level_laws
from evenbreak.practice.played_again import play_again
from evenbreak.practice.progressive_fit import deviance


class PlayedAgainTest(NamedTuple):
    """A figure of a log beside the same figure of simulated logs.

    Parameters
    ----------
    seen
        the figure of the log.
    by_chance
        its mean over the simulated logs.
    p_value
        the probability that chance alone gives a figure at least as extreme.
    p_error
        its standard error, for want of more simulated logs.
    """

    seen: float
    by_chance: float
    p_value: float
    p_error: float = 0.0


def difference_test(log: DrillLog, played: Ints) -> PlayedAgainTest:
    """Test the levels visited against the long run of the chances observed.

    The figure is half the sum of the absolute differences of the two distributions. It is large
    where sessions are short, so it must be compared with `by_chance`; a figure that chance does
    not reach comes from how sessions begin and end.

    Parameters
    ----------
    log
        the log.
    played
        shape (replicas, levels, 3, 2): logs that `play_again` simulated with the chances
        observed.
    """
    return _larger(_distance(log.outcomes), _distance(played))


def memory_test(log: DrillLog, played: Ints) -> PlayedAgainTest | None:
    """Test whether success is as likely after a success as after a miss, at the same level.

    The figure is the difference of the two success rates, with the levels weighted as by
    Mantel and Haenszel; the test is two-sided about its mean by chance. None where no level was
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
    return PlayedAgainTest(seen, mean, test.p_value, _error_about_mean(seen, by_chance))


def _error_about_mean(seen: float, by_chance: Floats) -> float:
    """Return the standard error of P(as far from the mean as seen), whose mean is estimated too.

    The delta method: each simulated log moves the share by itself, and by moving the mean.
    """
    mean, off = float(by_chance.mean()), float(by_chance.std()) / np.sqrt(len(by_chance))

    def as_far(centre: float) -> Bools:
        return np.asarray(np.abs(by_chance - centre) >= abs(seen - centre))

    moved = as_far(mean + off).mean() - as_far(mean - off).mean()
    slope = moved / (2.0 * off) if off > 0.0 else 0.0
    influence = as_far(mean) + slope * (by_chance - mean)
    return float(influence.std() / np.sqrt(len(by_chance)))


def model_test(
    log: DrillLog, p: float, *, replicas: int, rng: np.random.Generator
) -> PlayedAgainTest | None:
    """Test the model p_i = p^(i - 1) against a separate chance for each level.

    The figure is the deviance, twice the logarithm of the likelihood ratio. Logs are simulated
    with the model's chances, except at level 1, which the fit ignores: there with the chance
    observed. None unless two levels above the first were attempted.

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


def _distance(outcomes: Ints) -> Floats:
    """Return half the sum of the absolute differences of visited and implied, for each log."""
    attempts = outcomes.sum((-1, -2))
    p = chances_seen(attempts, outcomes[..., 1].sum(-1))
    visited = attempts / attempts.sum(-1, keepdims=True)
    return np.asarray(np.abs(visited - level_laws(p)).sum(-1) / 2.0)


def _memory(outcomes: Ints) -> Floats:
    """Return how much higher the success rate was after a success than after a miss.

    The levels are weighted as by Mantel and Haenszel; NaN where no level was attempted after
    both.
    """
    after = outcomes[..., [AFTER_MISS, AFTER_SUCCESS], :]
    attempts = after.sum(-1)
    rate = after[..., 1] / np.maximum(attempts, 1)
    weight = attempts.prod(-1) / np.maximum(attempts.sum(-1), 1)
    with np.errstate(invalid="ignore"):
        return np.asarray((weight * (rate[..., 1] - rate[..., 0])).sum(-1) / weight.sum(-1))


def _larger(seen: float | Floats, by_chance: Floats) -> PlayedAgainTest:
    """Return how often chance gives as large a figure; the log itself counts as one case."""
    as_large = int(np.count_nonzero(by_chance >= float(seen) * (1.0 - 1e-12)))
    p_value = (1 + as_large) / (1 + len(by_chance))
    error = float(np.sqrt(p_value * (1.0 - p_value) / len(by_chance)))
    return PlayedAgainTest(float(seen), float(by_chance.mean()), p_value, error)
