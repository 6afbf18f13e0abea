"""Charts by rating difference: which race two players play, given their ratings."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Ints
from evenbreak.checks import whole, whole_numbers
from evenbreak.errors import InputError

# The rows of a chart by rating difference, and what can be wrong with them.


class ChartRow(NamedTuple):
    """One row of a chart: the race for a range of rating differences.

    Parameters
    ----------
    difference_from, difference_to
        in rating points, stronger minus weaker; `difference_to` is None in the last row, which is
        open-ended.
    """

    difference_from: int
    difference_to: int | None
    stronger_needs: int
    weaker_needs: int


class ChartDraft(NamedTuple):
    """Rows of an unfinished chart, perhaps with gaps and overlaps for `audit` to find.

    Parameters
    ----------
    rows
        whole numbers, in any order; no row ends before it starts.
    """

    name: str
    rows: tuple[ChartRow, ...]


def row_faults(rows: Sequence[ChartRow]) -> Iterator[tuple[int, str]]:
    """Yield each faulty row that keeps rows of whole numbers from being a chart, and why.

    A chart covers every difference from 0 up exactly once, by rows in increasing order. It
    starts with an even race, and the stronger player never needs fewer games.

    >>> rows = [ChartRow(0, 9, 3, 3), ChartRow(12, None, 4, 3)]
    >>> for place, fault in row_faults(rows):
    ...     print(place, fault)
    1 row 2 starts at 12, but row 1 ends at 9. Start it at 10.
    """
    first, last = rows[0], rows[-1]
    if first.difference_from != 0:
        yield 0, f"row 1 must start at 0; it starts at {first.difference_from}"
    if first.stronger_needs != first.weaker_needs:
        yield (
            0,
            f"row 1 is a race {first.stronger_needs}:{first.weaker_needs}. Give an even race, "
            "since at a difference of 0 neither player is stronger.",
        )
    for place, row in enumerate(rows):
        if row.difference_to is not None and row.difference_to < row.difference_from:
            yield (
                place,
                f"difference_to in row {place + 1} must be {row.difference_from} or more; you "
                f"gave {row.difference_to}",
            )
        if place and row.stronger_needs < row.weaker_needs:
            yield (
                place,
                f"stronger_needs in row {place + 1} must be {row.weaker_needs} or more, since the "
                f"stronger player never needs fewer games; you gave {row.stronger_needs}",
            )
    for place, (row, after) in enumerate(pairwise(rows), 1):
        if row.difference_to is None:
            yield (
                place - 1,
                f"row {place} is open-ended, but only the last row can be. Give its end.",
            )
        elif after.difference_from != row.difference_to + 1:
            yield (
                place,
                f"row {place + 1} starts at {after.difference_from}, but row {place} ends "
                f"at {row.difference_to}. Start it at {row.difference_to + 1}.",
            )
    if last.difference_to is not None:
        yield (
            len(rows) - 1,
            f"the last row ends at {last.difference_to}, but a chart must cover all larger "
            "differences too. Leave out its end.",
        )


def catalog_rows(name: str) -> list[tuple[Any, ...]]:
    """Return the rows of a built-in chart; None for empty cells.

    >>> catalog_rows("npl_8")[-1]
    (49, None, 6, 2)
    """
    place = files("evenbreak.handicaps.charts").joinpath("catalog", f"{name}.csv")
    _, *rows = csv.reader(place.read_text("utf-8").splitlines())
    return [tuple(int(cell) if cell else None for cell in row) for row in rows]


CHARTS = {
    "fargo_r6_hot": "Fargo R6 Hot",
    "npl_8": "National Pool League chart 8",
    "npl_10": "National Pool League chart 10",
    "npl_12": "National Pool League chart 12",
    "npl_20": "National Pool League chart 20",
}
"""Titles of the built-in charts, by name."""

_WHOLE_POINTS = "whole points (round the two ratings before you subtract them)"


@dataclass(frozen=True)
class Chart:
    """Chart of races by rating difference, as printed by a league.

    Parameters
    ----------
    rows
        the rows in increasing order, each a `ChartRow` or its four values. The first one
        starts at 0 with an even race, since neither of two equal players is the stronger one; each
        later row starts one point after the previous row ends; the last is open-ended.

    Raises
    ------
    InputError
        if a row breaks these rules, or the stronger player needs fewer games than the weaker; the
        message says which row.

    Notes
    -----
    Source: Table 5.6.

    >>> short = Chart("short", [(0, 9, 3, 3), (10, 19, 4, 3), (20, None, 4, 2)])
    >>> short.race(12), short.race(-12), short.race(500)
    ((4, 3), (3, 4), (4, 2))
    """

    name: str
    rows: Sequence[ChartRow]

    def __post_init__(self) -> None:
        rows = [_checked(row, f"row {i}") for i, row in enumerate(_rows(self.rows), 1)]
        if not rows:
            raise InputError("rows must not be empty. Give a row for each range of differences.")
        for _, fault in row_faults(rows):
            raise InputError(fault)
        object.__setattr__(self, "rows", tuple(rows))

    def race(self, difference: Any) -> tuple[int, int]:
        """Return (m, n): the games that player 1 and player 2 need.

        Parameters
        ----------
        difference
            rating of player 1 minus rating of player 2, in whole points; if negative, player 2 is
            the stronger player, and the race is reversed.

        Raises
        ------
        InputError
            if the difference is not a whole number. A chart has no row between 5 and 6, and
            rounding both ratings is not the same as rounding their difference, so the caller must
            round as the league does.

        >>> chart("npl_10").race(5), chart("npl_10").race(6), chart("npl_10").race(-6)
        ((5, 5), (5, 4), (4, 5))
        >>> chart("npl_10").race(5.5)
        Traceback (most recent call last):
        ...
        evenbreak.errors.InputError: difference must be whole points (round the two ratings before
            you subtract them); you gave 5.5
        """
        points = whole(difference, "difference", at_least=None, wanted=_WHOLE_POINTS)
        m, n = self.races(points)
        return int(m), int(n)

    def races(self, differences: ArrayLike) -> tuple[Ints, Ints]:
        """Return (m, n), two arrays: the games that player 1 and player 2 need, elementwise.

        Parameters
        ----------
        differences
            rating of player 1 minus rating of player 2, in whole points, of any shape.

        Raises
        ------
        InputError
            if a difference is not a whole number.

        >>> m, n = chart("npl_10").races([5, 6, -6])
        >>> m, n
        (array([5, 5, 4]), array([5, 4, 5]))
        """
        points = whole_numbers(differences, "differences", wanted=_WHOLE_POINTS)
        needs = np.array([row[2:] for row in self.rows])
        starts = [row.difference_from for row in self.rows]
        place = np.searchsorted(starts, np.abs(points), side="right") - 1
        stronger, weaker = needs[place, 0], needs[place, 1]
        ahead = points >= 0.0
        return np.where(ahead, stronger, weaker), np.where(ahead, weaker, stronger)


def _rows(rows: Iterable[Iterable[Any]]) -> list[ChartRow]:
    try:
        return [ChartRow(*row) for row in rows]
    except TypeError:
        raise InputError(
            "{rows} must have four values each: difference_from, difference_to, stronger_needs, "
            "weaker_needs; you gave {value!r}",
            value=rows,
        ) from None


def _checked(row: ChartRow, name: str) -> ChartRow:
    """Return a row with its numbers as ints, or raise an error."""
    last = row.difference_to
    return ChartRow(
        whole(row.difference_from, f"difference_from in {name}"),
        None if last is None else whole(last, f"difference_to in {name}"),
        whole(row.stronger_needs, f"stronger_needs in {name}", at_least=1),
        whole(row.weaker_needs, f"weaker_needs in {name}", at_least=1),
    )


def chart(name: str) -> Chart:
    """Return a built-in chart by its name in `CHARTS`.

    `npl_8`, `npl_10`, `npl_12` and `npl_20` are the National Pool League's charts, from short
    to very long; `fargo_r6_hot` is a chart of races to 6 and more for Fargo ratings (100 points
    double the odds).

    Raises
    ------
    InputError
        if no chart has this name.

    Notes
    -----
    Source: Table 5.6 (National Pool League); the chart "R6 Hot" as leagues print it (Fargo).

    >>> chart("npl_8").rows[1]
    ChartRow(difference_from=7, difference_to=18, stronger_needs=4, weaker_needs=3)
    """
    if name not in list(CHARTS):
        raise InputError(
            "chart must be one of {charts}; you gave {name!r}", name=name, charts=", ".join(CHARTS)
        )
    return _read(name)


@cache
def _read(name: str) -> Chart:
    return Chart(name, [ChartRow(*row) for row in catalog_rows(name)])
