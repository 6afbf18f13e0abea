"""The rows of a chart of rating differences, and what may be wrong with them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple


class ChartRow(NamedTuple):
    """One line of a chart: the race for a span of rating differences.

    Parameters
    ----------
    difference_from, difference_to
        the first and the last difference in rating points, stronger minus weaker;
        `difference_to` is None in the last row, which has no end.
    stronger_needs, weaker_needs
        the games that each of the two needs.
    """

    difference_from: int
    difference_to: int | None
    stronger_needs: int
    weaker_needs: int


class ChartDraft(NamedTuple):
    """The rows of a chart as they stand, perhaps with gaps and overlaps, for `audit` to find.

    Parameters
    ----------
    name
        what the chart is called.
    rows
        rows of whole numbers, in any order, none of which ends before it begins.
    """

    name: str
    rows: tuple[ChartRow, ...]


def row_faults(rows: Sequence[ChartRow]) -> Iterator[tuple[int, str]]:
    """Yield the place of each row that keeps rows of whole numbers from being a chart, and why.

    A chart covers each difference from 0 on just once, by rows in the order of the
    differences; it begins with an even race, and in none of its races does the stronger
    player need fewer games.

    >>> rows = [ChartRow(0, 9, 3, 3), ChartRow(12, None, 4, 3)]
    >>> for place, fault in row_faults(rows):
    ...     print(place, fault)
    1 row 2 begins at 12 and row 1 ends at 9; let it begin at 10
    """
    first, last = rows[0], rows[-1]
    if first.difference_from != 0:
        yield 0, f"row 1 begins at {first.difference_from}; begin the chart at 0"
    if first.stronger_needs != first.weaker_needs:
        yield (
            0,
            f"row 1 is a race {first.stronger_needs}:{first.weaker_needs}; give an even race "
            "for the difference 0, where neither player is the stronger",
        )
    for place, row in enumerate(rows):
        if row.difference_to is not None and row.difference_to < row.difference_from:
            yield (
                place,
                f"difference_to of row {place + 1} is {row.difference_to}; give a whole number, "
                f"{row.difference_from} or more",
            )
        if place and row.stronger_needs < row.weaker_needs:
            yield (
                place,
                f"stronger_needs of row {place + 1} is {row.stronger_needs}; give a whole "
                f"number, {row.weaker_needs} or more: the stronger player needs as many at least",
            )
    for place, (row, after) in enumerate(pairwise(rows), 1):
        if row.difference_to is None:
            yield place - 1, f"row {place} has no end but is not the last; give its last point"
        elif after.difference_from != row.difference_to + 1:
            yield (
                place,
                f"row {place + 1} begins at {after.difference_from} and row {place} ends at "
                f"{row.difference_to}; let it begin at {row.difference_to + 1}",
            )
    if last.difference_to is not None:
        yield (
            len(rows) - 1,
            f"the last row ends at {last.difference_to}; leave its end empty (None): it is for all "
            "differences above too",
        )
