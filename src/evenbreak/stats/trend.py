"""Fit a straight line to scores to see whether they change over time."""

from __future__ import annotations

from typing import Any, NamedTuple

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.stats.confidence import checked_scores, open_share, sd_of


class Trend(NamedTuple):
    """Slope of the line through scores, in points per unit of time.

    `low` to `high` is its interval with the given confidence. `p_value` is the chance of a
    slope at least this steep, up or down, if the true slope is 0.
    """

    slope: float
    low: float
    high: float
    p_value: float


class TrendLine(NamedTuple):
    """The trend line at given times, and the interval of the true line at each of them."""

    at: Floats
    low: Floats
    high: Floats


def trend_line(times: Any, scores: Any, at: Any, confidence: float = 0.95) -> TrendLine:
    """Return the line of `trend` at given times, with its interval.

    >>> found = trend_line([0, 1, 2, 3], [50, 52, 51, 53], [0, 1.5])
    >>> [column.round(2).tolist() for column in found]
    [[50.3, 51.5], [46.88, 49.46], [53.72, 53.54]]
    """
    import numpy as np

    fitted = trend(times, scores, confidence)
    when, away = np.asarray(times, dtype=float), np.asarray(at, dtype=float) - np.mean(times)
    line = np.mean(scores) + fitted.slope * away
    # The mean and the slope are independent, and the mean is off as the slope is at this distance.
    half = (fitted.high - fitted.slope) * np.sqrt(when.var() + away**2)
    return TrendLine(line, line - half, line + half)


def trend(times: Any, scores: Any, confidence: float = 0.95) -> Trend:
    """Return the straight line that fits scores over time best, by least squares.

    Parameters
    ----------
    times
        when each score was made, in any unit; not all at the same time.
    scores
        the same number of scores, three or more, not all equal. They are assumed to vary around the
        true line independently and normally, with the same spread.
    confidence
        of the interval, between 0 and 1.

    Raises
    ------
    InputError
        if there are fewer than three scores, a different number of times, or only one distinct time
        or score.

    >>> found = trend([0, 1, 2, 3], [50, 52, 51, 53])
    >>> found.slope, round(found.low, 2), round(found.high, 2)
    (0.8, -1.03, 2.63)
    """
    from scipy.special import stdtrit
    from scipy.stats import linregress

    share = open_share(confidence)
    when, points = checked_scores(times, "times"), checked_scores(scores, "scores")
    if points.size < 3:
        raise InputError(
            "a trend needs three or more scores; you gave {points_size}",
            points_size=points.size,
        )
    if when.size != points.size:
        raise InputError(
            "times has {when_size} numbers, but scores has {points_size}. Give one time for "
            "each score.",
            when_size=when.size,
            points_size=points.size,
        )
    if sd_of(when) == 0.0:
        raise InputError(
            "times are all {when:g}. A trend needs at least two different times.",
            when=float(when[0]),
        )
    if sd_of(points) == 0.0:
        raise InputError(
            "scores are all {point:g}. Give scores that differ.", point=float(points[0])
        )
    line = linregress(when, points)
    half = -float(stdtrit(points.size - 2, (1.0 - share) / 2.0)) * float(line.stderr)
    slope = float(line.slope)
    return Trend(slope, slope - half, slope + half, float(line.pvalue))
