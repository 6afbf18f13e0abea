"""Races of similar length: a chart as leagues print it does not jump from 3:3 to 8:7.

The longest matches of the National Pool League's chart 10 have 7 to 9 games, those of chart 20
have 17 to 19. So the races that limits allow are taken in groups whose longest matches differ
by no more than a few games, and the fairest chart is the fairest that any group makes.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from evenbreak.arrays import Ints
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.candidates import Candidates
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.cheapest_path import NoChartError
from evenbreak.handicaps.charts.race_limits import RaceLimits
from evenbreak.ratings.scale import Scale


def similar_limits(limits: RaceLimits, spread: Any) -> list[RaceLimits]:
    """Return limits for each group of races whose longest matches differ by `spread` at most.

    >>> [alike.games for alike in similar_limits(RaceLimits((5, 9)), 2)]
    [(5, 7), (6, 8), (7, 9)]
    """
    spread, (low, high) = whole(spread, "spread"), limits.games
    groups = []
    for first in range(low, max(low, high - spread) + 1):
        try:
            groups.append(replace(limits, games=(first, min(first + spread, high))))
        except InputError:  # no even race is that long
            continue
    if not groups:
        raise InputError(f"spread is {spread}, which leaves no even race; give 1 or more")
    return groups


class SimilarLengths:
    """The races within limits, in groups of similar length.

    Parameters
    ----------
    scale, limits, up_to
        as for `Candidates`; without `up_to` all groups go to where the hardest race of any of
        them is even.
    spread
        how much the longest matches of a chart's races may differ, in games.

    >>> from evenbreak.ratings import SCALES
    >>> groups = SimilarLengths(SCALES["npl"], RaceLimits((5, 9), weaker_least=2), 2)
    >>> [row[2:] for row in groups.fairest(rows=4).rows]
    [(3, 3), (4, 3), (4, 2), (6, 2)]
    """

    def __init__(
        self, scale: Scale, limits: RaceLimits, spread: Any, up_to: int | None = None
    ) -> None:
        self.points: Ints = Candidates(scale, limits, up_to).points
        last = int(self.points[-1])
        self.groups = [Candidates(scale, alike, last) for alike in similar_limits(limits, spread)]

    def fairest(self, *, name: str = "design", **wishes: Any) -> Chart:
        """Return the fairest chart that any of the groups makes, as `Candidates.fairest` does."""
        charts, refused = [], []
        for group in self.groups:
            try:
                charts.append(group.best(name=name, **wishes))
            except NoChartError as error:
                refused.append(error)
        if not charts:
            raise refused[0]  # that of the shortest races, whose remedy goes furthest
        return min(charts, key=lambda costed: costed.cost).chart
