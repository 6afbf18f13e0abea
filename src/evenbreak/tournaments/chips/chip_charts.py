"""Chip charts: how many chips a player starts with, by rating."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, NamedTuple

import numpy as np
from msgspec import Meta
from numpy.typing import ArrayLike, NDArray

from evenbreak.checks import floats, whole
from evenbreak.errors import InputError


class ChipRow(NamedTuple):
    """The chips for players rated `rating_from` or more; -inf for the weakest players' row."""

    rating_from: Annotated[float, Meta(le=1_000_000)]
    chips: int


@dataclass(frozen=True)
class ChipChart:
    """How many chips a player starts with.

    Parameters
    ----------
    rows
        the rows in order of rating, the first for the weakest players.

    Raises
    ------
    InputError
        if the rows are not in order, or stronger players have more chips.

    >>> CHIP_CHARTS["hoboken"].chips([650, 500, 349])
    array([4, 6, 8])
    """

    name: str
    rows: Sequence[ChipRow]
    source: str = ""

    def __post_init__(self) -> None:
        rows = tuple(ChipRow(float(start), whole(c, "chips", at_least=1)) for start, c in self.rows)
        object.__setattr__(self, "rows", rows)
        if not rows:
            raise InputError("rows must not be empty. Give a rating and chips for each.")
        for weaker, stronger in pairwise(rows):
            if not stronger.rating_from > weaker.rating_from:
                raise InputError(
                    "the row from {above:g} comes after the row from {below:g}, so it must "
                    "start higher. Give each rating once, the lowest first.",
                    above=stronger.rating_from,
                    below=weaker.rating_from,
                )
            if stronger.chips > weaker.chips:
                raise InputError(
                    "stronger players can't get more chips than weaker ones: players rated "
                    "{rating:g} or above get {chips}, but weaker players get only {weaker}",
                    rating=stronger.rating_from,
                    chips=stronger.chips,
                    weaker=weaker.chips,
                )

    def chips(self, ratings: ArrayLike) -> NDArray[np.int64]:
        """Return the chips for each rating.

        Raises
        ------
        InputError
            if a rating is not a number, or below the first row.
        """
        rated = floats(ratings, "ratings")
        starts = [row.rating_from for row in self.rows]
        place = np.searchsorted(starts, rated, side="right") - 1
        if (place < 0).any():
            lowest = float(rated.min())
            raise InputError(
                "a rating of {rating:g} is below {start:g}, where the chart {chart} starts",
                rating=lowest,
                start=starts[0],
                chart=self.name,
            )
        return np.array([row.chips for row in self.rows])[place]


CHIP_CHARTS: dict[str, ChipChart] = {
    "hoboken": ChipChart(
        "hoboken",
        [
            ChipRow(-math.inf, 8),
            ChipRow(351, 7),
            ChipRow(451, 6),
            ChipRow(501, 5),
            ChipRow(601, 4),
        ],
        "chip tournaments at a club in Hoboken, by Fargo rating, as published",
    ),
    "pharaohs": ChipChart(
        "pharaohs",
        [
            ChipRow(-math.inf, 9),
            ChipRow(250, 8),
            ChipRow(350, 7),
            ChipRow(450, 6),
            ChipRow(500, 5),
            ChipRow(550, 4),
            ChipRow(650, 3),
            ChipRow(700, 2),
        ],
        "chip tournaments at Pharaohs, by Fargo rating, as published",
    ),
}
"""The chip charts that come with the package, by name."""


def chip_chart(name: str | ChipChart) -> ChipChart:
    """Return a chart by name.

    Raises
    ------
    InputError
        if no chart has this name.
    """
    if isinstance(name, ChipChart):
        return name
    if name not in CHIP_CHARTS:
        raise InputError(
            "there's no chip chart {name!r}. Choose one of {charts}.",
            name=name,
            charts=", ".join(CHIP_CHARTS),
        )
    return CHIP_CHARTS[name]
