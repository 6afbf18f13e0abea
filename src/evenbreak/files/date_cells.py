"""Dates in the cells of a table, in the orders in which people write day, month and year."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import date
from typing import Literal

import numpy as np

from evenbreak.checks import one_of
from evenbreak.files.cells import Values, read_cells
from evenbreak.files.problems import quoted
from evenbreak.files.text_table import TextTable

DateOrder = Literal["mdy", "dmy"]
"""What comes first in 9/3/2024: the month or the day."""

ORDERS: tuple[DateOrder, ...] = ("mdy", "dmy")

_TIME = r"(?:[T ]+\d{1,2}:\d{2}\S*(?: ?[AaPp]\.?[Mm]\.?)?)?"
_YEAR_FIRST = re.compile(r"(\d{4})[-/](\d{1,2})[-/](\d{1,2})" + _TIME, re.ASCII)
_DAY_FIRST = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})" + _TIME, re.ASCII)
_EITHER = re.compile(r"(\d{1,2})([-/])(\d{1,2})\2(\d{4})" + _TIME, re.ASCII)


def dates(table: TextTable, name: str, order: DateOrder | None = None) -> Values:
    """Read a column of dates; a time after a date is ignored, empty cells are NaT.

    With dots the day comes first, in 2024-09-03 and 2024/9/3 the year. In 9/3/2024 the month
    may come first or the day: `order` says which, or else any cell of the column in which only
    one of them is possible. If nothing does, that is one problem of the table.
    """
    if order is not None:
        one_of(order, "dates", ORDERS)
    order, problem = (order, False) if order else _order_in(table, name)
    return read_cells(
        table,
        name,
        lambda text: np.datetime64("NaT") if problem and _either(text) else read_date(text, order),
        wanted="a date",
        remedy="write 2024-09-03, 3.9.2024 or 9/3/2024, or leave it empty",
        dtype="datetime64[D]",
        empty=np.datetime64("NaT"),
        may_be_empty=True,
    )


def read_date(text: str, order: DateOrder | None = None) -> np.datetime64 | None:
    """Return the date that a text states, read as in `dates`; None where it states none.

    Without an order 9/13/2024 is a date and 9/3/2024 is none, since it may be two.

    >>> read_date("3.9.2024"), read_date("9/3/2024", "mdy"), read_date("9/3/2024")
    (np.datetime64('2024-09-03'), np.datetime64('2024-09-03'), None)
    """
    if match := _YEAR_FIRST.fullmatch(text):
        return _day(match[1], match[2], match[3])
    if match := _DAY_FIRST.fullmatch(text):
        return _day(match[3], match[2], match[1])
    found = _either(text)
    if found is None:
        return None
    if order is not None:
        return found[order]
    possible = {day for day in found.values() if day is not None}
    return possible.pop() if len(possible) == 1 else None


def is_two_dates(text: str) -> bool:
    """Return whether a text is a date whose order of day and month has to be known.

    >>> is_two_dates("9/3/2024"), is_two_dates("9/13/2024"), is_two_dates("9/9/2024")
    (True, False, False)
    """
    found = _either(text)
    return found is not None and None not in found.values() and len({*found.values()}) == 2


def _either(text: str) -> dict[DateOrder, np.datetime64 | None] | None:
    """Return the date by each order of day and month, if a text has this form."""
    match = _EITHER.fullmatch(text)
    if match is None:
        return None
    first, _, second, year = match.groups()
    return {"mdy": _day(year, first, second), "dmy": _day(year, second, first)}


def _day(year: str, month: str, day: str) -> np.datetime64 | None:
    try:
        return np.datetime64(date(int(year), int(month), int(day)))
    except ValueError:
        return None


def _order_in(table: TextTable, name: str) -> tuple[DateOrder | None, bool]:
    """Return the order that a column's own dates settle, and whether they leave it open.

    Where they leave it open, or contradict each other, that is added to the table's problems.
    """
    distinct, codes = table.columns[name]
    settled: dict[DateOrder, str] = {}
    for order, text in _settling(distinct):
        settled.setdefault(order, text)
    open_ = [code for code, text in enumerate(distinct) if is_two_dates(text)]
    if len(settled) == 1:
        return next(iter(settled)), False
    if settled:
        mdy, dmy = (
            f"{quoted(settled[order])} in line "
            f"{table.lines[(codes == distinct.index(settled[order])).argmax()]}"
            for order in ORDERS
        )
        table.problems.add(
            None, f"{name} has the month first ({mdy}) and the day first ({dmy}); use one order"
        )
        return None, True
    if open_:
        row = int(np.isin(codes, open_).argmax())
        table.problems.add(
            int(table.lines[row]),
            f"{name} {quoted(distinct[codes[row]])} may have the month first or the day, and no "
            "date of the file shows which; add --dates mdy (month first) or --dates dmy (day "
            "first)",
        )
    return None, bool(open_)


def _settling(texts: list[str]) -> Iterator[tuple[DateOrder, str]]:
    """Yield the texts in which only one order of day and month is possible, with that order."""
    for text in texts:
        found = _either(text)
        if found is None:
            continue
        possible: list[DateOrder] = [order for order, day in found.items() if day is not None]
        if len(possible) == 1:
            yield possible[0], text
