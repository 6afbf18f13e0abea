"""The rows of a chart by rating difference, and what can be wrong with them."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from importlib.resources import files
from itertools import pairwise
from typing import Any, NamedTuple


class ChartRow(NamedTuple):
    """One row of a chart: the race for a range of rating differences.

    Parameters
    ----------
    difference_from, difference_to
        the first and the last difference in rating points, stronger minus weaker;
        `difference_to` is None in the last row, which is open-ended.
    stronger_needs, weaker_needs
        the games that each player needs.
    """

    difference_from: int
    difference_to: int | None
    stronger_needs: int
    weaker_needs: int


class ChartDraft(NamedTuple):
    """The rows of an unfinished chart, perhaps with gaps and overlaps, for `audit` to find.

    Parameters
    ----------
    name
        the name of the chart.
    rows
        rows of whole numbers, in any order, none of which ends before it begins.
    """

    name: str
    rows: tuple[ChartRow, ...]


def row_faults(rows: Sequence[ChartRow]) -> Iterator[tuple[int, str]]:
    """Yield what keeps rows of whole numbers from being a chart: each faulty row, and why.

    A chart covers every difference from 0 up exactly once, by rows in increasing order. It
    begins with an even race, and the stronger player never needs fewer games.

    >>> rows = [ChartRow(0, 9, 3, 3), ChartRow(12, None, 4, 3)]
    >>> for place, fault in row_faults(rows):
    ...     print(place, fault)
    1 row 2 begins at 12, but row 1 ends at 9; begin it at 10
    """
    first, last = rows[0], rows[-1]
    if first.difference_from != 0:
        yield 0, f"row 1 begins at {first.difference_from}; a chart must begin at 0"
    if first.stronger_needs != first.weaker_needs:
        yield (
            0,
            f"row 1 is a race {first.stronger_needs}:{first.weaker_needs}; give an even race, "
            "since at a difference of 0 neither player is the stronger",
        )
    for place, row in enumerate(rows):
        if row.difference_to is not None and row.difference_to < row.difference_from:
            yield (
                place,
                f"difference_to of row {place + 1} is {row.difference_to}; give "
                f"{row.difference_from} or more",
            )
        if place and row.stronger_needs < row.weaker_needs:
            yield (
                place,
                f"stronger_needs of row {place + 1} is {row.stronger_needs}; give "
                f"{row.weaker_needs} or more, since the stronger player never needs fewer games",
            )
    for place, (row, after) in enumerate(pairwise(rows), 1):
        if row.difference_to is None:
            yield place - 1, f"row {place} is open-ended but not the last row; give its end"
        elif after.difference_from != row.difference_to + 1:
            yield (
                place,
                f"row {place + 1} begins at {after.difference_from}, but row {place} ends at "
                f"{row.difference_to}; begin it at {row.difference_to + 1}",
            )
    if last.difference_to is not None:
        yield (
            len(rows) - 1,
            f"the last row ends at {last.difference_to}; leave its end out, since a chart covers "
            "all larger differences too",
        )


def catalogue_rows(name: str) -> list[tuple[Any, ...]]:
    """Return the rows of a chart that comes with the package; None where a cell is empty.

    >>> catalogue_rows("npl_8")[-1]
    (49, None, 6, 2)
    """
    place = files("evenbreak.handicaps.charts").joinpath("catalogue", f"{name}.csv")
    _, *rows = csv.reader(place.read_text("utf-8").splitlines())
    return [tuple(int(cell) if cell else None for cell in row) for row in rows]
