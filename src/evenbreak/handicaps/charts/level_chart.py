"""Charts of skill levels: the levels of the two players say which race is played."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.checks import whole
from evenbreak.errors import InputError

LEVEL_CHARTS = {"apa_8ball": "APA 8-ball"}
"""The charts of skill levels that come with the package: the title of each, by name."""


@dataclass(frozen=True)
class LevelChart:
    """A chart of races by the skill levels of the two players, as a league prints it.

    Parameters
    ----------
    name
        what the chart is called.
    levels
        the skill levels, rising whole numbers.
    needs
        `needs[i][j]`: the games that a player of level `levels[i]` needs against one of level
        `levels[j]`.

    Raises
    ------
    InputError
        if the levels do not rise, `needs` is not a square of that size, or the higher of two
        levels needs fewer games than the lower; it says which.

    >>> two = LevelChart("two", [3, 4], [[2, 2], [3, 3]])
    >>> two.race(4, 3), two.race(3, 4), two.race(4, 4)
    ((3, 2), (2, 3), (3, 3))
    """

    name: str
    levels: Sequence[int]
    needs: Sequence[Sequence[int]]

    def __post_init__(self) -> None:
        levels = tuple(whole(level, f"level {i}") for i, level in enumerate(self.levels, 1))
        if not levels:
            raise InputError("levels is empty; give the skill levels of the chart")
        for below, above in pairwise(levels):
            if below >= above:
                raise InputError(f"level {above} comes after {below}; give rising levels")
        object.__setattr__(self, "levels", levels)
        object.__setattr__(self, "needs", _needs(self.needs, levels))

    def race(self, level_1: Any, level_2: Any) -> tuple[int, int]:
        """Return (m, n): the games that player 1 and player 2 need.

        Parameters
        ----------
        level_1, level_2
            the skill levels of the two.

        Raises
        ------
        InputError
            if the chart has no such level.

        >>> level_chart("apa_8ball").race(5, 3)
        (4, 2)
        >>> level_chart("apa_8ball").race(1, 3)
        Traceback (most recent call last):
        ...
        evenbreak.errors.InputError: level_1 is 1; give a level of the chart: 2, 3, 4, 5, 6, 7
        """
        i, j = self._place(level_1, "level_1"), self._place(level_2, "level_2")
        return self.needs[i][j], self.needs[j][i]

    def _place(self, level: Any, name: str) -> int:
        try:
            return self.levels.index(level)
        except ValueError:  # of an array too: its comparisons have no one truth
            raise InputError(f"{name} is {level!r}; {self._remedy}") from None

    @property
    def _remedy(self) -> str:
        return f"give a level of the chart: {', '.join(map(str, self.levels))}"

    def races(
        self, levels_1: ArrayLike, levels_2: ArrayLike
    ) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return (m, n), two arrays: the games that player 1 and player 2 need, elementwise.

        Parameters
        ----------
        levels_1, levels_2
            the skill levels of the two, of shapes that broadcast together.

        Raises
        ------
        InputError
            if the chart lacks one of the levels, or the shapes do not broadcast.

        >>> level_chart("apa_8ball").races([5, 3], 3)
        (array([4, 2]), array([2, 2]))
        """
        i, j = self._places(levels_1, "levels_1"), self._places(levels_2, "levels_2")
        needs = np.array(self.needs)
        try:
            return needs[i, j], needs[j, i]
        except IndexError:
            raise InputError(
                f"levels_1 and levels_2 have shapes {i.shape} and {j.shape}; "
                "give shapes that broadcast together"
            ) from None

    def _places(self, levels: ArrayLike, name: str) -> NDArray[np.int64]:
        known = np.array(self.levels)
        try:
            array = np.asarray(levels)
            numbers = array.dtype.kind in "iuf"
        except ValueError:  # rows of different lengths
            numbers = False
        if not numbers:
            raise InputError(f"{name} is {levels!r}; {self._remedy}")
        place = np.minimum(np.searchsorted(known, array), len(known) - 1)
        wrong = known[place] != array
        if wrong.any():
            raise InputError(f"{name} holds {array[wrong].flat[0]}; {self._remedy}")
        return place


def _needs(needs: Any, levels: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
    """Return the games needed as rows of ints, or refuse them."""
    rows = [tuple(row) if hasattr(row, "__iter__") else () for row in needs]
    if len(rows) != len(levels) or any(len(row) != len(levels) for row in rows):
        raise InputError(
            f"needs is not a square for {len(levels)} levels; give a row for each level, "
            "with the games needed against each level"
        )
    square = tuple(
        tuple(
            whole(games, f"needs of level {own} against {other}", at_least=1)
            for games, other in zip(row, levels, strict=True)
        )
        for row, own in zip(rows, levels, strict=True)
    )
    for i, higher in enumerate(levels):
        for j, lower in enumerate(levels[:i]):
            if square[i][j] < square[j][i]:
                raise InputError(
                    f"level {higher} needs {square[i][j]} games against level {lower}, which "
                    f"needs {square[j][i]}; the higher level needs as many at least"
                )
    return square


def level_chart(name: str) -> LevelChart:
    """Return a chart of skill levels that comes with the package, by its name in `LEVEL_CHARTS`.

    `apa_8ball` is the American Poolplayers Association's chart for 8-ball.

    Raises
    ------
    InputError
        if no chart of skill levels has this name.

    Notes
    -----
    Source: the chart of games that must be won, as leagues print it (APA 8-ball).

    >>> level_chart("apa_8ball").levels
    (2, 3, 4, 5, 6, 7)
    """
    if name not in list(LEVEL_CHARTS):
        raise InputError(f"level chart is {name!r}; give {' or '.join(LEVEL_CHARTS)}")
    return _read(name)


@cache
def _read(name: str) -> LevelChart:
    text = (
        files("evenbreak.handicaps.charts").joinpath("catalogue", f"{name}.csv").read_text("utf-8")
    )
    rows = [tuple(map(int, row)) for row in list(csv.reader(text.splitlines()))[1:]]
    needs = {(own, other): games for own, other, games, _ in rows}
    levels = sorted({row[0] for row in rows})
    return LevelChart(name, levels, [[needs[own, other] for other in levels] for own in levels])
