"""The chart by rating difference that the fairest races come to."""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.answers.scale_words import decimals_of
from evenbreak.handicaps.charts.given_ratings import win_given_ratings
from evenbreak.ratings.scale import Scale

MOST_BANDS = 40
"""A chart with more lines than this is too long to read."""


class Band(NamedTuple):
    """A span of rating differences with one race, up to just below `after`.

    `p_first` and `p_after` are the stronger player's chances at its two ends.
    """

    first: float
    after: float
    stronger: int
    weaker: int
    p_first: float
    p_after: float


def chart_bands(
    offered: OfferedRaces,
    scale: Scale,
    furthest: float,
    error: float = 0.0,
    form: float = 0.0,
) -> list[Band]:
    """Return the chart of races by rating difference that the fairest races come to.

    Parameters
    ----------
    offered
        the races to choose from. Where they may differ in length, the race nearest to
        even jumps back and forth between lengths as ratings part, and no chart is made.
    scale
        what a rating difference means.
    furthest
        the difference, in points, up to which the chart goes.
    error
        the standard error of a difference, over which chances are averaged.
    form
        how much the log-odds of a game vary from match to match, over which they are too.

    Returns
    -------
    list of Band
        differences are whole multiples of the last decimal in which ratings are shown;
        empty where there is no chart, or one of more than 40 lines.

    >>> from evenbreak.ratings import SCALES
    >>> for band in chart_bands(OfferedRaces(race_to=7), SCALES["npl"], 20.0):
    ...     print(band.first, band.stronger, band.weaker, round(band.p_first, 3))
    0.0 7 7 0.5
    3.5 7 6 0.443
    11.2 7 5 0.435
    """
    if offered.games is not None and offered.games[0] != offered.games[1]:
        return []
    decimals = decimals_of(scale)
    unit = 10.0**-decimals
    # One step beyond, so that the furthest pair is in a band even where one begins with it.
    last = math.ceil(furthest / unit) + 1

    # From one band to the next the stronger gives one game more, or the weaker gets one.
    _, (most, least) = offered.fairest([0.0, last * unit], error, scale, form)
    if most - least >= MOST_BANDS:
        return []
    difference = np.arange(last + 1) * unit
    stronger, weaker = offered.fairest(difference, error, scale, form)
    starts = np.flatnonzero(np.diff(stronger) | np.diff(weaker)) + 1
    bands = []
    for first, after in pairwise([0, *starts[starts < last].tolist(), last]):
        m, n = int(stronger[first]), int(weaker[first])
        ends = np.round(difference[[first, after]], decimals)
        both = difference[[first, after]]
        chances = win_given_ratings(both, error, m, n, scale=scale, form=form)
        (low, high), (p_low, p_high) = ends.tolist(), chances.tolist()
        bands.append(Band(low, high, m, n, p_low, p_high))
    return bands
