"""Whether scores change over time: the straight line through them."""

from __future__ import annotations

from typing import Any, NamedTuple

from evenbreak.errors import InputError
from evenbreak.stats.confidence import checked_scores, open_share, sd_of


class Trend(NamedTuple):
    """The slope of the line through scores, in points per unit of time.

    `low` to `high` is its interval with the given confidence. `p_value` is the chance of a
    slope at least this steep, up or down, if the true slope is 0.
    """

    slope: float
    low: float
    high: float
    p_value: float


def trend(times: Any, scores: Any, confidence: float = 0.95) -> Trend:
    """Return the straight line that fits scores over time best, by least squares.

    Parameters
    ----------
    times
        when each score was made, in any unit; not all at the same time.
    scores
        as many numbers, three or more, that differ. They are assumed to lie about the true
        line independently and normally, with the same spread.
    confidence
        of the interval, between 0 and 1.

    Raises
    ------
    InputError
        if there are fewer than three scores, another number of times, or only one distinct
        time or score.

    >>> found = trend([0, 1, 2, 3], [50, 52, 51, 53])
    >>> found.slope, round(found.low, 2), round(found.high, 2)
    (0.8, -1.03, 2.63)
    """
    from scipy.special import stdtrit
    from scipy.stats import linregress

    share = open_share(confidence)
    when, points = checked_scores(times, "times"), checked_scores(scores, "scores")
    if points.size < 3:
        raise InputError(f"scores holds {points.size} scores; give three or more for a trend")
    if when.size != points.size:
        raise InputError(f"times holds {when.size} numbers, but scores {points.size}; give as many")
    if sd_of(when) == 0.0:
        raise InputError(f"times are all {float(when[0]):g}; give two or more for a trend")
    if sd_of(points) == 0.0:
        raise InputError(f"scores are all {float(points[0]):g}; give scores that differ")
    line = linregress(when, points)
    half = -float(stdtrit(points.size - 2, (1.0 - share) / 2.0)) * float(line.stderr)
    slope = float(line.slope)
    return Trend(slope, slope - half, slope + half, float(line.pvalue))
