"""Charts of points: how many points a player of a skill level needs, whoever the opponent is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from evenbreak.checks import increasing, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.rows import catalogue_rows

POINTS_CHARTS = {"apa_9ball": "APA 9-ball"}
"""The charts of points that come with the package: the title of each, by name."""


@dataclass(frozen=True)
class PointsChart:
    """A chart of the points that a player needs, by skill level, as a league prints it.

    Parameters
    ----------
    name
        the name of the chart.
    levels
        the skill levels, increasing whole numbers.
    points
        the points that a player of each level needs, 1 or more, increasing.

    Raises
    ------
    InputError
        if the levels or the points do not increase, or there are not as many of both.

    >>> two = PointsChart("two", [3, 4], [25, 31])
    >>> two.race(4, 3)
    (31, 25)
    """

    name: str
    levels: Sequence[int]
    points: Sequence[int]

    def __post_init__(self) -> None:
        levels = increasing(self.levels, "level")
        points = increasing(self.points, "points", at_least=1)
        if not levels or len(levels) != len(points):
            raise InputError(
                f"there are {len(levels)} levels and {len(points)} points; give one for each"
            )
        object.__setattr__(self, "levels", levels)
        object.__setattr__(self, "points", points)

    def race(self, level_1: Any, level_2: Any) -> tuple[int, int]:
        """Return the points that player 1 and player 2 need.

        Raises
        ------
        InputError
            if the chart has no such level.

        >>> points_chart("apa_9ball").race(5, 3)
        (38, 25)
        """
        return self._needs(level_1, "level_1"), self._needs(level_2, "level_2")

    def _needs(self, level: Any, name: str) -> int:
        wanted = f"a level of the chart: {', '.join(map(str, self.levels))}"
        found = whole(level, name, at_least=None, wanted=wanted)
        if found not in self.levels:
            raise InputError(f"{name} is {level!r}; give {wanted}")
        return self.points[self.levels.index(found)]


def points_chart(name: str) -> PointsChart:
    """Return a chart of points that comes with the package, by its name in `POINTS_CHARTS`.

    `apa_9ball` is the American Poolplayers Association's chart for 9-ball, where balls 1 to 8
    count a point each and the 9 counts two, so that a rack has 10 points.

    Raises
    ------
    InputError
        if no chart of points has this name.

    Notes
    -----
    Source: the points-to-win chart for APA 9-ball, as leagues print it.

    >>> points_chart("apa_9ball").points
    (14, 19, 25, 31, 38, 46, 55, 65, 75)
    """
    if name not in list(POINTS_CHARTS):
        raise InputError(f"chart of points is {name!r}; give {' or '.join(POINTS_CHARTS)}")
    return _read(name)


@cache
def _read(name: str) -> PointsChart:
    levels, points = zip(*catalogue_rows(name), strict=True)
    return PointsChart(name, levels, points)
