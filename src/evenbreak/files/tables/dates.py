"""Dates in a table's cells, in the various orders of day, month and year."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import date
from typing import Any, ClassVar, Literal

import numpy as np

from evenbreak.checks import one_of
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.schema import Column
from evenbreak.files.tables.table import TextTable, Values
from evenbreak.words import Parameter, say

_NO_DAY = np.datetime64("NaT", "D")

DateOrder = Literal["mdy", "dmy"]
"""What comes first in 9/3/2024: the month or the day."""

ORDERS: tuple[DateOrder, ...] = ("mdy", "dmy")

_TIME = r"(?:[T ]+\d{1,2}:\d{2}\S*(?: ?[AaPp]\.?[Mm]\.?)?)?"
_YEAR_FIRST = re.compile(r"(\d{4})[-/](\d{1,2})[-/](\d{1,2})" + _TIME, re.ASCII)
_DAY_FIRST = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})" + _TIME, re.ASCII)
_EITHER = re.compile(r"(\d{1,2})([-/])(\d{1,2})\2(\d{4})" + _TIME, re.ASCII)


@dataclass(frozen=True, kw_only=True)
class Day(Column):
    """Dates; a time after a date is ignored.

    With dots, the day comes first; in 2024-09-03 and 2024/9/3, the year does. In 9/3/2024 the month
    or the day may come first: `order` says which, or else any cell in the column where only one
    order is possible. If nothing does, the order is `open`: one problem for the whole table.
    """

    order: DateOrder | None = None
    write: str = say("2024-09-03, 3.9.2024 or 9/3/2024")
    nothing: np.datetime64 = _NO_DAY
    open: bool = False

    dtype: ClassVar[Any] = "datetime64[D]"

    @property
    def wanted(self) -> str:
        """What a cell should contain."""
        return say("a date")

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column; an ambiguous order of day and month is one problem."""
        if self.order is not None:
            one_of(self.order, "dates", ORDERS)
            return super().read(table, name)
        order, is_open = _order_in(table, name)
        return super(Day, replace(self, order=order, open=is_open)).read(table, name)

    def meaning(self, text: str) -> np.datetime64 | None:
        """Return the date."""
        if self.open and _either(text):
            return self.nothing  # said once, of the whole column
        return read_date(text, self.order)


def read_date(text: str, order: DateOrder | None = None) -> np.datetime64 | None:
    """Return the date that a string states, read as in `Day`; None if it states none.

    Without an order, 9/13/2024 is a date and 9/3/2024 isn't, because it could be either of two.

    >>> read_date("3.9.2024"), read_date("9/3/2024", "mdy"), read_date("9/3/2024")
    (np.datetime64('2024-09-03'), np.datetime64('2024-09-03'), None)
    """
    if match := _YEAR_FIRST.fullmatch(text):
        return _day(match[1], match[2], match[3])
    if match := _DAY_FIRST.fullmatch(text):
        return _day(match[3], match[2], match[1])
    either = _either(text)
    if either is None:
        return None
    if order is not None:
        return either[order]
    possible = {day for day in either.values() if day is not None}
    return possible.pop() if len(possible) == 1 else None


def is_two_dates(text: str) -> bool:
    """Return whether a string is a date whose order of day and month must be known.

    >>> is_two_dates("9/3/2024"), is_two_dates("9/13/2024"), is_two_dates("9/9/2024")
    (True, False, False)
    """
    either = _either(text)
    return either is not None and None not in either.values() and len({*either.values()}) == 2


def _either(text: str) -> dict[DateOrder, np.datetime64 | None] | None:
    """Return the date in each order of day and month, if a string has this form."""
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
    """Return the order shown by a column's own dates, and whether they leave it open.

    If they leave it open, or contradict each other, that is added to the table's problems.
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
            say(
                "{date} in line {line}",
                date=quoted(settled[order]),
                line=table.lines[(codes == distinct.index(settled[order])).argmax()],
            )
            for order in ORDERS
        )
        table.problems.add(
            None,
            "{column} has dates with the month first ({mdy}) and with the day first ({dmy}). "
            "Use one order.",
            column=name,
            mdy=mdy,
            dmy=dmy,
        )
        return None, True
    if open_:
        row = int(np.isin(codes, open_).argmax())
        table.note(
            row,
            "{column} {date} may have the month or the day first, and no date in the file shows "
            "which. Add {dates} mdy (month first) or {dates} dmy (day first).",
            column=name,
            date=quoted(distinct[codes[row]]),
            dates=Parameter("dates"),
        )
    return None, bool(open_)


def _settling(texts: list[str]) -> Iterator[tuple[DateOrder, str]]:
    """Yield the strings in which only one order of day and month is possible, with that order."""
    for text in texts:
        either = _either(text)
        if either is None:
            continue
        possible: list[DateOrder] = [order for order, day in either.items() if day is not None]
        if len(possible) == 1:
            yield possible[0], text
