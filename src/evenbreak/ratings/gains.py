"""What one way of rating gains over another in predicting a season, and whether that is clear."""

from __future__ import annotations

import numpy as np

from evenbreak.ratings.calibration import Estimate, bootstrap_ratio
from evenbreak.ratings.stretches import StretchLosses

FEWEST_STRETCHES = 10
"""Stretches from which ways can be compared."""

SEED = 1
"""Of the bootstrap, so that the same file always has the same answer."""


def gains_over(found: StretchLosses) -> tuple[Estimate, ...]:
    """Return how much log-loss a game each way but the first saves over the first.

    All ways predict the same stretches, so the intervals are those of the differences, the
    stretches resampled.
    """
    stretches = np.arange(len(found.losses))
    return tuple(
        bootstrap_ratio(saved, found.predicted, stretches, np.random.default_rng(SEED))
        for saved in (found.losses[:, :1] - found.losses[:, 1:]).T
    )


def is_clear(gain: Estimate) -> bool:
    """Return whether a gain is above 0 with 99% confidence.

    >>> is_clear(Estimate(0.5, 0.1, 0.9)), is_clear(Estimate(0.5, 0.4, 0.6))
    (False, True)
    """
    # The interval is of 95%, that is 1.96 standard errors each way; 2.58 leave out 1%.
    far = (gain.high - gain.low) / 2.0 * 2.576 / 1.960
    return (gain.high + gain.low) / 2.0 > far
