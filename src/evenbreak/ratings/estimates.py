"""Estimates with 95% intervals: from a standard error, by Wilson, or by a cluster bootstrap."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import expit, ndtr, ndtri

from evenbreak.arrays import Floats, Ints

CONFIDENCE = 0.95
"""Coverage of the intervals."""


SURE = 2.576
"""How many standard errors above its reference a figure is at 99% confidence."""

REPLICAS = 2_000
"""Number of bootstrap samples."""


_Z = float(ndtri(0.5 + CONFIDENCE / 2))


_DENSITY = math.exp(-(_Z**2) / 2.0) / math.sqrt(2.0 * math.pi)


END_ERROR = math.sqrt((1.0 - CONFIDENCE**2) / (4.0 * REPLICAS)) / (2.0 * _Z * _DENSITY)
"""Sampling error of an interval's endpoints, as a fraction of the interval's length.

It is the standard error of a normal distribution's quantile, from `REPLICAS` draws.
"""


class Estimate(NamedTuple):
    """A figure with its 95% interval."""

    value: float
    low: float
    high: float

    @property
    def standard_error(self) -> float:
        """The standard error, from the length of the interval."""
        return (self.high - self.low) / (2.0 * _Z)

    def errors_above(self, what: float = 0.0) -> float:
        """Return how many standard errors the middle of the interval is above a value.

        >>> Estimate(0.3, -0.1, 0.5).errors_above(0.2), Estimate(0.3, 0.3, 0.3).errors_above()
        (0.0, inf)
        """
        above = (self.low + self.high) / 2.0 - what
        error = self.standard_error
        return above / error if error > 0.0 else math.inf * above if above else 0.0


def with_error(value: float, error: float) -> Estimate:
    """Return an estimate with the 95% interval from its standard error."""
    return Estimate(value, value - _Z * error, value + _Z * error)


def bootstrap_ratio(
    above: Floats, below: Floats, cluster: Ints, rng: np.random.Generator
) -> Estimate:
    """Return sum(above) / sum(below) with its percentile interval, resampling clusters.

    Matches in the same cluster are drawn together; clusters are numbered from 0.
    """
    many = int(cluster.max()) + 1
    return ratio_over(above, below, cluster, samples(many, rng))


def samples(clusters: int, rng: np.random.Generator) -> Ints:
    """Return how often each cluster is in each sample: shape (`REPLICAS`, clusters)."""
    return rng.multinomial(clusters, np.full(clusters, 1.0 / clusters), size=REPLICAS)


def ratio_over(above: Floats, below: Floats, cluster: Ints, drawn_clusters: Ints) -> Estimate:
    """Return the same as `bootstrap_ratio`, from samples that have already been drawn."""
    many = drawn_clusters.shape[1]
    sums = np.column_stack([np.bincount(cluster, part, many) for part in (above, below)])
    drawn = drawn_clusters @ sums
    drawn = drawn[drawn[:, 1] > 0.0]
    ratio = drawn[:, 0] / drawn[:, 1]
    low, high = np.quantile(ratio, [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2])
    return Estimate(float(above.sum() / below.sum()), float(low), float(high))


def logistic_coefficient(
    x: Floats, won: Floats, games: Floats, cluster: Ints, *, offset: Floats | float = 0.0
) -> Estimate | None:
    """Return the b for which P(win) = 1 / (1 + exp(-(offset + b x))) fits best, with its interval.

    If x is the predicted log-odds, b is the calibration slope: 1 is right; below 1, the predictions
    were too extreme. If x is 1 or -1, b is an advantage in log-odds. Rows are matches or games;
    those of one cluster may depend on each other. None if they do not determine b, because x is
    always 0 or one side won everything.

    Cox (1958), "Two further applications of a model for binary regression"; Liang & Zeger (1986)
    for the sandwich standard error.
    """
    b = 0.0
    for _ in range(100):
        p = expit(offset + b * x)
        slope = float((x * (won - games * p)).sum())
        curvature = float((games * p * (1.0 - p) * x * x).sum())
        if curvature <= 1e-9 * float((games * x * x).sum()):
            return None
        # A long step may overshoot the maximum; a short one only takes longer.
        most = 1.0 / float(np.abs(x).max())
        step = max(-most, min(most, slope / curvature))
        b += step
        if abs(step) < 1e-12 * max(1.0, abs(b)):
            break
    else:
        return None
    p = expit(offset + b * x)
    scores = np.bincount(cluster, x * (won - games * p))
    many = int(np.count_nonzero(np.bincount(cluster)))
    if many < 2:
        return None
    error = math.sqrt(float((scores**2).sum()) * many / (many - 1)) / curvature
    return with_error(b, error)


def two_sided(z: float) -> float:
    """Return the chance that a standard normal variable is at least as far from 0 as z.

    >>> round(two_sided(-1.96), 3)
    0.05
    """
    return float(2.0 * ndtr(-abs(z)))


def wilson(share: float, n: float) -> tuple[float, float]:
    """Return Wilson's 95% interval for a probability, given the share of successes in n trials.

    >>> [round(end, 3) for end in wilson(0.5, 10)]
    [0.237, 0.763]
    """
    middle = (share + _Z**2 / (2.0 * n)) / (1.0 + _Z**2 / n)
    half = _Z * math.sqrt(share * (1.0 - share) / n + _Z**2 / (4.0 * n * n)) / (1.0 + _Z**2 / n)
    # Rounding may put an end on the wrong side where the share is 0 or 1.
    return max(0.0, min(share, middle - half)), min(1.0, max(share, middle + half))
