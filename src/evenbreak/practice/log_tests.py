"""Tests of a drill log against simulated logs, to see what stands out.

Each test simulates the log many times, with the same starts and lengths, and counts how often
chance alone gives a value as extreme as the log's. A formula would be misleading: the fractions of
attempts at each level and the chances estimated from the same log almost have to agree, since a
session that keeps to the rule crosses between two levels upwards as often as downwards, give or
take once. And in short sessions, even chances without memory seem, on average, to have a memory
(Miller & Sanjurjo 2018).

One of the models tested has a single shot chance p for a whole drill: level i takes i - 1
successful shots. With s_i successes and f_i misses at level i, and p_i = p^(i - 1),

    log L(p) = sum over i >= 2 of  s_i (i - 1) log p + f_i log(1 - p^(i - 1)).

In x = -log p the slope, sum of (i - 1) (f_i / (exp((i - 1) x) - 1) - s_i), decreases
throughout, so there is one maximum, found by bisection. Level 1 is ignored: there the model is
p^0 = 1 for any p.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.special import xlog1py, xlogy

from evenbreak.arrays import Bools, FloatOrArray, Floats, Ints
from evenbreak.checks import plain
from evenbreak.errors import InputError
from evenbreak.practice.drill_log import AFTER_MISS, AFTER_START, AFTER_SUCCESS, DrillLog
from evenbreak.practice.drills import chances_seen, level_laws
from evenbreak.stats.confidence import open_share


class PlayedAgainTest(NamedTuple):
    """A statistic of a log, compared with the same statistic in simulated logs.

    Parameters
    ----------
    by_chance
        its mean over the simulated logs.
    p_value
        the probability that chance alone gives a figure at least as extreme.
    p_error
        the standard error of the p-value, as the number of simulated logs is finite.
    """

    seen: float
    by_chance: float
    p_value: float
    p_error: float = 0.0


def difference_test(log: DrillLog, played: Ints) -> PlayedAgainTest:
    """Test the visited levels against the long run of the observed chances.

    The statistic is half the sum of the absolute differences between the two distributions. It is
    large if sessions are short, so it must be compared with `by_chance`; a value that chance does
    not reach comes from how sessions start and end. `played` holds the logs simulated by
    `play_again` with the observed chances.
    """
    return _larger(_distance(log.outcomes), _distance(played))


def memory_test(log: DrillLog, played: Ints) -> PlayedAgainTest | None:
    """Test whether success is as likely after a success as after a miss, at the same level.

    The statistic is the difference between the two success rates, with levels weighted as in Mantel
    and Haenszel; the test is two-sided around its mean by chance. None if no level was attempted
    after both.
    """
    seen, by_chance = float(_memory(log.outcomes)), _memory(played)
    by_chance = by_chance[~np.isnan(by_chance)]
    if np.isnan(seen) or not len(by_chance):
        return None
    mean = float(by_chance.mean())
    test = _larger(abs(seen - mean), np.abs(by_chance - mean))
    return PlayedAgainTest(seen, mean, test.p_value, _error_about_mean(seen, by_chance))


def _error_about_mean(seen: float, by_chance: Floats) -> float:
    """Return the standard error of P(at least as far from the mean), whose mean is estimated.

    It uses the delta method: each simulated log changes the share directly, and through the mean.
    """
    mean, off = float(by_chance.mean()), float(by_chance.std()) / np.sqrt(len(by_chance))

    def as_far(center: float) -> Bools:
        return np.asarray(np.abs(by_chance - center) >= abs(seen - center))

    moved = as_far(mean + off).mean() - as_far(mean - off).mean()
    slope = moved / (2.0 * off) if off > 0.0 else 0.0
    influence = as_far(mean) + slope * (by_chance - mean)
    return float(influence.std() / np.sqrt(len(by_chance)))


def model_test(
    log: DrillLog, p: float, *, replicas: int, rng: np.random.Generator
) -> PlayedAgainTest | None:
    """Test the model p_i = p^(i - 1), with fitted p, against a separate chance for each level.

    The statistic is the deviance, twice the logarithm of the likelihood ratio. Logs are simulated
    with the model's chances, except at level 1, which the fit ignores: there, with the observed
    chance. None unless two levels above the first were attempted.
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
    """Return half the sum of absolute differences between visited and implied, for each log."""
    attempts = outcomes.sum((-1, -2))
    p = chances_seen(attempts, outcomes[..., 1].sum(-1))
    visited = attempts / attempts.sum(-1, keepdims=True)
    return np.asarray(np.abs(visited - level_laws(p)).sum(-1) / 2.0)


def _memory(outcomes: Ints) -> Floats:
    """Return how much higher the success rate was after a success than after a miss.

    Levels are weighted as in Mantel and Haenszel; NaN if no level was attempted after both.
    """
    after = outcomes[..., [AFTER_MISS, AFTER_SUCCESS], :]
    attempts = after.sum(-1)
    rate = after[..., 1] / np.maximum(attempts, 1)
    weight = attempts.prod(-1) / np.maximum(attempts.sum(-1), 1)
    with np.errstate(invalid="ignore"):
        return np.asarray((weight * (rate[..., 1] - rate[..., 0])).sum(-1) / weight.sum(-1))


def _larger(seen: float | Floats, by_chance: Floats) -> PlayedAgainTest:
    """Return how often chance gives as large a value; the log itself counts as one case."""
    as_large = int(np.count_nonzero(by_chance >= float(seen) * (1.0 - 1e-12)))
    p_value = (1 + as_large) / (1 + len(by_chance))
    error = float(np.sqrt(p_value * (1.0 - p_value) / len(by_chance)))
    return PlayedAgainTest(float(seen), float(by_chance.mean()), p_value, error)


_AT_ONCE = 500_000
"""The most stretches simulated in parallel, so that memory use stays small."""


def play_again(log: DrillLog, success: Floats, *, replicas: int, rng: np.random.Generator) -> Ints:
    """Return the outcomes of simulated logs with the same starts and lengths as a log.

    Each stretch of the log, from one start to the next, is simulated from its first level for the
    same number of attempts, each independent of those before it, given its level. `success` is
    P(success | an attempt at level i); the result has shape (replicas, levels, 3, 2), as
    `DrillLog.outcomes`.
    """
    ends = np.append(log.starts[1:], len(log))
    lengths = ends - log.starts
    longest_first = np.argsort(-lengths, kind="stable")
    lengths, first = lengths[longest_first], log.level[log.starts[longest_first]] - 1
    batch = max(1, _AT_ONCE // len(lengths))
    parts = [
        _played(first, lengths, success, min(batch, replicas - done), rng)
        for done in range(0, replicas, batch)
    ]
    return np.concatenate(parts)


def _played(
    first: Ints,
    lengths: Ints,
    success: Floats,
    replicas: int,
    rng: np.random.Generator,
) -> Ints:
    """Simulate all stretches of all replicas in parallel, longest first."""
    n = len(success)
    counts = np.zeros(replicas * n * 6, dtype=np.int64)
    level = np.tile(first, (replicas, 1))
    before = np.full(level.shape, AFTER_START)
    row = np.arange(replicas)[:, None] * n
    still = np.searchsorted(-lengths, -np.arange(lengths[0]), side="left")
    for count in still.tolist():
        level, before = level[:, :count], before[:, :count]
        won = rng.random(level.shape) < success[level]
        np.add.at(counts, (((row + level) * 3 + before) * 2 + won).ravel(), 1)
        level = np.clip(level + np.where(won, 1, -1), 0, n - 1)
        before = np.where(won, AFTER_SUCCESS, AFTER_MISS)
    return counts.reshape(replicas, n, 3, 2)


_LOG_X = (-40.0, 8.0)
"""The bisection searches between these natural logs of x; beyond them p is 1 or 0 in floats."""
_HALVINGS = 60


class ProgressiveFit(NamedTuple):
    """Best-fitting p of the model p_i = p^(i - 1) for a log.

    Parameters
    ----------
    p
        the maximum-likelihood estimate; 1 if every attempt above level 1 succeeded, 0 if
        none did.
    low, high
        the likelihood-ratio interval for p.
    attempts
        the attempts above level 1, from which p is estimated.
    level_1_attempts, level_1_misses
        the attempts and misses that were left out: in the model, level 1 never fails, so each of
        these misses contradicts it.
    """

    p: float
    low: float
    high: float
    confidence: float
    attempts: int
    level_1_attempts: int
    level_1_misses: int


def fit_progressive(log: DrillLog, *, confidence: float = 0.95) -> ProgressiveFit:
    """Return the best-fitting p of the model p_i = p^(i - 1) for a log.

    Raises
    ------
    InputError
        if the log has no attempt above level 1, from which p could be estimated, or the
        confidence is not between 0 and 1.

    Notes
    -----
    Source: the model of P5.26. Interval: Wilks 1938.

    >>> from evenbreak.practice import DrillLog
    >>> fit = fit_progressive(DrillLog([1, 2, 3, 2, 3, 2], [1, 1, 0, 1, 0, 1]))
    >>> round(fit.p, 3), round(fit.low, 3), round(fit.high, 3)
    (0.655, 0.248, 0.934)
    """
    from scipy.stats import chi2

    confidence = open_share(confidence)
    successes, failures = log.successes, log.attempts - log.successes
    attempts = int(log.attempts[1:].sum())
    if not attempts:
        raise InputError(
            "p is estimated from attempts above level 1, and the log has none. Log higher "
            "levels too."
        )
    p = float(likeliest_p(successes, failures))
    allowed = float(chi2.ppf(confidence, 1)) / 2.0
    least = float(_log_likelihood(p, successes, failures)) - allowed
    return ProgressiveFit(
        p,
        _edge(0.0, p, least, successes, failures) if successes[1:].any() else 0.0,
        _edge(1.0, p, least, successes, failures) if failures[1:].any() else 1.0,
        confidence,
        attempts,
        int(log.attempts[0]),
        int(failures[0]),
    )


def likeliest_p(successes: Ints, failures: Ints) -> FloatOrArray:
    """Return the maximum-likelihood p for each of many logs of shape (..., levels).

    Level 1 is ignored; NaN where there is no attempt above it.

    >>> likeliest_p(np.array([[9, 3], [9, 0]]), np.array([[0, 1], [0, 0]])).round(9)
    array([0.75,  nan])
    """
    shots = np.arange(1.0, successes.shape[-1])
    won, lost = successes[..., 1:], failures[..., 1:]
    low, high = (np.full(successes.shape[:-1], end) for end in _LOG_X)
    with np.errstate(over="ignore"):
        for _ in range(_HALVINGS):
            middle = (low + high) / 2.0
            x = np.exp(middle)[..., None]
            falls = (shots * (lost / np.expm1(shots * x) - won)).sum(-1) < 0.0
            low, high = np.where(falls, low, middle), np.where(falls, middle, high)
    any_won, any_lost = won.any(-1), lost.any(-1)
    p = np.where(any_lost, np.exp(-np.exp((low + high) / 2.0)), 1.0)
    p = np.where(any_won, p, 0.0)
    return plain(np.where(any_won | any_lost, p, np.nan))


def deviance(successes: Ints, failures: Ints) -> FloatOrArray:
    """Return twice the log-likelihood that the model loses to a free chance for each level.

    Shapes are as in `likeliest_p`. It is 0 if the model fits as well as free chances.

    >>> deviance(np.array([[9, 3, 9], [9, 3, 0]]), np.array([[0, 1, 7], [0, 1, 4]])).round(2)
    array([0.  , 3.29])
    """
    p = np.nan_to_num(likeliest_p(successes, failures))
    won, lost = successes[..., 1:], failures[..., 1:]
    total = np.maximum(won + lost, 1)
    free = (xlogy(won, won / total) + xlogy(lost, lost / total)).sum(-1)
    return plain(np.maximum(2.0 * (free - _log_likelihood(p, successes, failures)), 0.0))


def _log_likelihood(p: float | Floats, successes: Ints, failures: Ints) -> Floats:
    shots = np.arange(1.0, successes.shape[-1])
    chance = np.asarray(p)[..., None] ** shots
    terms = xlogy(successes[..., 1:], chance) + xlog1py(failures[..., 1:], -chance)
    return np.asarray(terms.sum(-1))


def _edge(end: float, p: float, least: float, successes: Ints, failures: Ints) -> float:
    """Return the point between `end` and p at which the log-likelihood falls to `least`."""
    from scipy.optimize import brentq

    def above(q: float) -> float:
        # A likelihood of 0 is replaced by one that brentq can work with.
        return max(float(_log_likelihood(q, successes, failures)) - least, -1e9)

    if above(p) <= 0.0:
        return p
    return float(brentq(above, end, p, xtol=1e-14))
