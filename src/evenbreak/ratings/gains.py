"""What one way of rating gains over another in predicting a season, and whether that is clear.

Predictions are made before the results, so the product of the ratios of what two ways predicted is
a betting score: if the first way is right, the chance that the score ever reaches 20 is at most
1/20 (Ville 1939; Shafer 2021). That also holds for the mean of the scores of several ways.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from scipy.special import logsumexp

from evenbreak.arrays import Ints
from evenbreak.ratings.calibration import Estimate, ratio_over, samples
from evenbreak.ratings.stretches import StretchLosses

FEWEST_STRETCHES = 10
"""Stretches from which ways can be compared."""

EVIDENCE = 20.0
"""The betting score from which a gain is clear, if the bootstrap does not speak against it."""

SEED = 1
"""Of the bootstrap, so that the same file always has the same answer."""


def gains_over(found: StretchLosses) -> tuple[Estimate, ...]:
    """Return how much log-loss a game each way but the first saves over the first.

    All ways predict the same stretches, so the intervals are those of the differences, the
    stretches resampled.
    """
    stretches = np.arange(len(found.losses))
    drawn = _samples(len(stretches))
    return tuple(
        ratio_over(saved, found.predicted, stretches, drawn)
        for saved in (found.losses[:, :1] - found.losses[:, 1:]).T
    )


def is_clear(found: StretchLosses) -> bool:
    """Return whether some way but the first clearly predicts better than the first.

    Either the gain of one is above 0 with 99% confidence, stretches being resampled; or the mean
    betting score of all is at least 20, and the best gain is above 0 with 90% confidence. The
    second finds what mostly helps early in a season, as long as little is known from results.

    >>> few = StretchLosses(np.ones((9, 2)), np.ones(9))
    >>> is_clear(few)
    False
    """
    if len(found.losses) < FEWEST_STRETCHES:
        return False
    gains = gains_over(found)
    saved = found.losses.sum(0)[0] - found.losses.sum(0)[1:]
    score = float(logsumexp(saved)) - math.log(len(saved))
    best = max(gains, key=lambda one: one.value)
    return any(_errors(one) > 2.576 for one in gains) or (
        score >= math.log(EVIDENCE) and _errors(best) > 1.282
    )


@cache
def _samples(stretches: int) -> Ints:
    return samples(stretches, np.random.default_rng(SEED))


def _errors(gain: Estimate) -> float:
    """Return by how many standard errors a gain is above 0: the interval is 1.96 each way."""
    middle, half = (gain.high + gain.low) / 2.0, (gain.high - gain.low) / 2.0
    return 1.960 * middle / half if half > 0.0 else math.copysign(math.inf, middle)
