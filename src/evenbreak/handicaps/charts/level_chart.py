"""Charts by skill level: which race two players play, given their levels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Ints
from evenbreak.checks import increasing, together, whole, whole_numbers
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import catalog_rows

LEVEL_CHARTS = {"apa_8ball": "APA 8-ball"}
"""Titles of the built-in charts by skill level, by name."""


@dataclass(frozen=True)
class LevelChart:
    """Chart of races by the two players' skill levels, as printed by a league.

    Parameters
    ----------
    levels
        the skill levels, increasing whole numbers.
    needs
        `needs[i][j]`: the games that a player at level `levels[i]` needs against one at level
        `levels[j]`.

    Raises
    ------
    InputError
        if the levels do not increase, `needs` is not a square of that size, or the higher of
        two levels needs fewer games than the lower; the message says which.

    >>> two = LevelChart("two", [3, 4], [[2, 2], [3, 3]])
    >>> two.race(4, 3), two.race(3, 4), two.race(4, 4)
    ((3, 2), (2, 3), (3, 3))
    """

    name: str
    levels: Sequence[int]
    needs: Sequence[Sequence[int]]

    def __post_init__(self) -> None:
        levels = increasing(self.levels, "level")
        if not levels:
            raise InputError("levels must not be empty. Give the skill levels of the chart.")
        object.__setattr__(self, "levels", levels)
        object.__setattr__(self, "needs", _needs(self.needs, levels))

    def race(self, level_1: Any, level_2: Any) -> tuple[int, int]:
        """Return (m, n): the games that player 1 and player 2 need.

        Raises
        ------
        InputError
            if the chart has no such level.

        >>> level_chart("apa_8ball").race(5, 3)
        (4, 2)
        >>> level_chart("apa_8ball").race(1, 3)
        Traceback (most recent call last):
        ...
        evenbreak.errors.InputError: level_1 must be one of the chart's levels: 2, 3, 4, 5, 6, 7;
            it is 1
        """
        wanted = self._wanted
        mine = whole(level_1, "level_1", at_least=None, wanted=wanted)
        theirs = whole(level_2, "level_2", at_least=None, wanted=wanted)
        i, j = int(self.places(mine, "level_1")), int(self.places(theirs, "level_2"))
        return self.needs[i][j], self.needs[j][i]

    @property
    def _wanted(self) -> str:
        return f"one of the chart's levels: {', '.join(map(str, self.levels))}"

    def races(self, levels_1: ArrayLike, levels_2: ArrayLike) -> tuple[Ints, Ints]:
        """Return (m, n), two arrays: the games that player 1 and player 2 need, elementwise.

        Raises
        ------
        InputError
            if the chart does not have one of the levels, or the shapes do not broadcast.

        >>> level_chart("apa_8ball").races([5, 3], 3)
        (array([4, 2]), array([2, 2]))
        """
        i, j = self.places(levels_1, "levels_1"), self.places(levels_2, "levels_2")
        together(levels_1=i, levels_2=j)
        needs = np.array(self.needs)
        return needs[i, j], needs[j, i]

    def places(self, levels: ArrayLike, name: str = "levels") -> Ints:
        """Return the positions of levels in the chart's list, elementwise.

        Raises
        ------
        InputError
            if the chart does not have one of the levels.
        """
        array = whole_numbers(levels, name, wanted=self._wanted)
        own_levels = np.array(self.levels)
        place = np.minimum(np.searchsorted(own_levels, array), len(own_levels) - 1)
        wrong = own_levels[place] != array
        if wrong.any():
            held = f"holds {array[wrong].flat[0]:g}" if array.ndim else f"is {levels!r}"
            raise InputError(
                "{name} must be {wanted}; it {held}", name=name, held=held, wanted=self._wanted
            )
        return place


def _needs(needs: Any, levels: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
    """Return the games needed as rows of ints, or raise an error."""
    rows = [tuple(row) if hasattr(row, "__iter__") else () for row in needs]
    if len(rows) != len(levels) or any(len(row) != len(levels) for row in rows):
        raise InputError(
            "{needs} must be a square table for {n_levels} levels. Give each level a row with "
            "the games it needs against each level.",
            n_levels=len(levels),
        )
    square = tuple(
        tuple(
            whole(games, f"needs of level {own} against {opponent}", at_least=1)
            for games, opponent in zip(row, levels, strict=True)
        )
        for row, own in zip(rows, levels, strict=True)
    )
    for i, higher in enumerate(levels):
        for j, lower in enumerate(levels[:i]):
            if square[i][j] < square[j][i]:
                raise InputError(
                    "level {higher} needs {square} games against level {lower}, which needs "
                    "{square_2}; the higher level must need at least as many",
                    higher=higher,
                    square=square[i][j],
                    lower=lower,
                    square_2=square[j][i],
                )
    return square


def level_chart(name: str) -> LevelChart:
    """Return a built-in chart by skill level, by its name in `LEVEL_CHARTS`.

    `apa_8ball` is the American Poolplayers Association's chart for 8-ball.

    Raises
    ------
    InputError
        if no chart by skill level has this name.

    Notes
    -----
    Source: the games-must-win chart for APA 8-ball, as leagues print it.

    >>> level_chart("apa_8ball").levels
    (2, 3, 4, 5, 6, 7)
    """
    if name not in list(LEVEL_CHARTS):
        raise InputError(
            "level chart must be {level_charts}; you gave {name!r}",
            name=name,
            level_charts=" or ".join(LEVEL_CHARTS),
        )
    return _read(name)


@cache
def _read(name: str) -> LevelChart:
    needs = {(own, opponent): games for own, opponent, games, _ in catalog_rows(name)}
    levels = sorted({own for own, _ in needs})
    return LevelChart(
        name, levels, [[needs[own, opponent] for opponent in levels] for own in levels]
    )


# Charts of points: how many points a player of a skill level needs, whoever the opponent is.


POINTS_CHARTS = {"apa_9ball": "APA 9-ball"}
"""Titles of the built-in charts of points, by name."""


@dataclass(frozen=True)
class PointsChart:
    """Chart of the points that a player needs, by skill level, as printed by a league.

    Parameters
    ----------
    levels
        the skill levels, increasing whole numbers.
    points
        the points that a player at each level needs, 1 or more, increasing.

    Raises
    ------
    InputError
        if the levels or the points do not increase, or their numbers differ.

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
                "there are {n_levels} levels but {n_points} numbers of points. Give one for "
                "each level.",
                n_levels=len(levels),
                n_points=len(points),
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
        wanted = f"one of the chart's levels: {', '.join(map(str, self.levels))}"
        number = whole(level, name, at_least=None, wanted=wanted)
        if number not in self.levels:
            raise InputError(
                "{name} must be {wanted}; you gave {level!r}", name=name, level=level, wanted=wanted
            )
        return self.points[self.levels.index(number)]


def points_chart(name: str) -> PointsChart:
    """Return a built-in chart of points, by its name in `POINTS_CHARTS`.

    `apa_9ball` is the American Poolplayers Association's chart for 9-ball, where balls 1 to 8 are
    worth one point each and the 9 is worth two, so a rack has 10 points.

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
        raise InputError(
            "chart of points must be {points_charts}; you gave {name!r}",
            name=name,
            points_charts=" or ".join(POINTS_CHARTS),
        )
    return _read_points(name)


@cache
def _read_points(name: str) -> PointsChart:
    levels, points = zip(*catalog_rows(name), strict=True)
    return PointsChart(name, levels, points)
