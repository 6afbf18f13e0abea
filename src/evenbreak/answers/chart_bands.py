"""The chart by rating difference that the fairest races come to."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from evenbreak.answers.offered_races import OfferedRaces
from evenbreak.answers.scale_words import decimals_of
from evenbreak.matches.win import race_win_probability
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


def chart_bands(offered: OfferedRaces, scale: Scale, furthest: float) -> list[Band]:
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

    def race(step: int) -> tuple[int, int]:
        fairest = offered.fairest(scale.win_probability(step * unit))
        return fairest.race_1, fairest.race_2

    def chance(step: int, needs: tuple[int, int]) -> float:
        return float(race_win_probability(scale.win_probability(step * unit), *needs))

    # From one band to the next the stronger gives one game more, or the weaker gets one.
    if race(0)[1] - race(last)[1] >= MOST_BANDS:
        return []
    bands: list[Band] = []
    first, needs = 0, race(0)
    while first < last:
        after = _first_other(race, first, last, needs)
        bands.append(
            Band(
                round(first * unit, decimals),
                round(after * unit, decimals),
                *needs,
                chance(first, needs),
                chance(after, needs),
            )
        )
        first, needs = after, race(after)
    return bands


def _first_other(race: Any, first: int, last: int, needs: tuple[int, int]) -> int:
    """Return the first step after `first` with another race, or `last`: no race comes twice."""
    low, high = first, last
    while high - low > 1:
        middle = (low + high) // 2
        if race(middle) == needs:
            low = middle
        else:
            high = middle
    return high
