"""A single shot chance p for a whole drill: the model in which level i takes i - 1 good shots.

With s_i successes and f_i misses at level i, and p_i = p^(i - 1),

    log L(p) = sum over i >= 2 of  s_i (i - 1) log p + f_i log(1 - p^(i - 1)).

In x = -log p the slope, sum of (i - 1) (f_i / (exp((i - 1) x) - 1) - s_i), decreases
throughout, so there is one maximum, found by bisection. Level 1 is ignored: there the model is
p^0 = 1 for any p.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.special import xlog1py, xlogy

from evenbreak.arrays import Floats, Ints
from evenbreak.errors import InputError
from evenbreak.practice.drill_log import DrillLog
from evenbreak.stats.confidence import open_share

_LOG_X = (-40.0, 8.0)
"""The bisection searches between these natural logs of x; beyond them p is 1 or 0 in floats."""
_HALVINGS = 60


class ProgressiveFit(NamedTuple):
    """The p of the model p_i = p^(i - 1) that fits a log best.

    Parameters
    ----------
    p
        the maximum-likelihood estimate; 1 if every attempt above level 1 succeeded, 0 if
        none did.
    low, high
        the likelihood-ratio interval for p.
    confidence
        how often such an interval contains the true p.
    attempts
        the attempts above level 1, from which p is estimated.
    level_1_attempts, level_1_misses
        what was left out: by the model level 1 never fails, so each of these misses
        contradicts it.
    """

    p: float
    low: float
    high: float
    confidence: float
    attempts: int
    level_1_attempts: int
    level_1_misses: int


def fit_progressive(log: DrillLog, *, confidence: float = 0.95) -> ProgressiveFit:
    """Return the p of the model p_i = p^(i - 1) that fits a log best.

    Parameters
    ----------
    log
        the attempts of a drill.
    confidence
        of the interval, between 0 and 1.

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
            "the log has no attempt above level 1, from which p is estimated; log higher levels too"
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


def likeliest_p(successes: Ints, failures: Ints) -> Floats:
    """Return the maximum-likelihood p of each of many logs.

    Parameters
    ----------
    successes, failures
        shape (..., levels); level 1 is ignored.

    Returns
    -------
    numpy.ndarray
        shape (...): NaN where there is no attempt above level 1.

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
    return np.asarray(np.where(any_won | any_lost, p, np.nan))[()]


def deviance(successes: Ints, failures: Ints) -> Floats:
    """Return twice the log-likelihood that the model loses against a free chance for each level.

    Shapes are as in `likeliest_p`. It is 0 where the model fits as well as free chances.

    >>> deviance(np.array([[9, 3, 9], [9, 3, 0]]), np.array([[0, 1, 7], [0, 1, 4]])).round(2)
    array([0.  , 3.29])
    """
    p = np.nan_to_num(likeliest_p(successes, failures))
    won, lost = successes[..., 1:], failures[..., 1:]
    total = np.maximum(won + lost, 1)
    free = (xlogy(won, won / total) + xlogy(lost, lost / total)).sum(-1)
    return np.asarray(np.maximum(2.0 * (free - _log_likelihood(p, successes, failures)), 0.0))[()]


def _log_likelihood(p: float | Floats, successes: Ints, failures: Ints) -> Floats:
    shots = np.arange(1.0, successes.shape[-1])
    chance = np.asarray(p)[..., None] ** shots
    terms = xlogy(successes[..., 1:], chance) + xlog1py(failures[..., 1:], -chance)
    return np.asarray(terms.sum(-1))


def _edge(end: float, p: float, least: float, successes: Ints, failures: Ints) -> float:
    """Return where between `end` and p the log-likelihood falls to `least`."""
    from scipy.optimize import brentq

    def above(q: float) -> float:
        # A likelihood of 0 is replaced by one that brentq can work with.
        return max(float(_log_likelihood(q, successes, failures)) - least, -1e9)

    if above(p) <= 0.0:
        return p
    return float(brentq(above, end, p, xtol=1e-14))
