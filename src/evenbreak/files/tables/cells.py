"""What the cells of a table mean: numbers, words, and anything else that text can be read as.

Each reader adds the cells that it cannot read to the table's `problems` and goes on, so that
everything wrong with a file is found at once.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import date
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.checks import one_of
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.table import TextTable
from evenbreak.ratings.result_words import LARGEST_WHOLE, letters

# Spreadsheets that once saw a gap in a column write its whole numbers as 7.0.
# A comma or point before three zeros may group thousands.
_WHOLE = re.compile(r"[+-]?[0-9]+(\.0{0,2}|\.0{4,}|,00?)?", re.ASCII)
_GROUPED = re.compile(r"[+-]?[1-9][0-9]{0,2}[.,][0-9]{3}", re.ASCII)
_IN_NUMBERS = "0123456789+-.eE"
_DECIMAL_COMMA = re.compile(r"[^.,]*,[^.,]*")
LARGEST_GROUPED = 10_000  # 92,347 means 92.347: no rating of 92347 points is in use
LONGEST_WHOLE = 20  # characters; Python refuses to read numbers of thousands of digits


class Values(NamedTuple):
    """A column as read.

    Attributes
    ----------
    values
        a value for each row: that of an empty cell where a cell could not be read.
    good
        which cells could be read, or may be empty.
    stated
        which cells are not empty.
    """

    values: NDArray[Any]
    good: NDArray[np.bool_]
    stated: NDArray[np.bool_]


def read_cells(
    table: TextTable,
    name: str,
    meaning: Callable[[str], Any],
    *,
    wanted: str,
    remedy: str,
    dtype: Any,
    empty: Any,
    may_be_empty: bool = False,
) -> Values:
    """Read a column, adding each cell without a meaning to the table's problems.

    Parameters
    ----------
    table, name
        the column to read; one that the file lacks is empty and not a further problem.
    meaning
        from the text of a cell, never empty, to its value; None where it has none.
    wanted, remedy
        what a cell should be, and how to correct one: "x is not `wanted`; `remedy`".
    dtype
        numpy type of the values.
    empty
        the value of empty cells.
    may_be_empty
        whether empty cells are allowed.

    >>> from evenbreak.files.tables.problems import Problems
    >>> from evenbreak.files.tables.table import Texts
    >>> columns = {"score": Texts(["7", "seven"], np.array([0, 1, 0]))}
    >>> table = TextTable("r.csv", np.array([2, 3, 5]), columns, frozenset(columns),
    ...                   Problems("r.csv"), (), b"")
    >>> read_cells(table, "score", {"7": 7}.get, wanted="a score", remedy="write 0, 1, 2, ...",
    ...            dtype=int, empty=0).values
    array([7, 0, 7])
    >>> table.problems.raise_any()
    Traceback (most recent call last):
    ...
    evenbreak.errors.DataError: r.csv:3: score 'seven' is not a score; write 0, 1, 2, ...
    """
    distinct, codes = table.columns[name]
    stated = np.array([bool(text) for text in distinct], dtype=bool)
    meant = [meaning(text) if text else None for text in distinct]
    values = np.array([empty if value is None else value for value in meant], dtype=dtype)
    good = np.array([value is not None for value in meant], dtype=bool)
    if may_be_empty or name not in table.found:
        good |= ~stated
    for row in np.flatnonzero(~good[codes]):
        text = distinct[codes[row]]
        what = f"{quoted(text)} is not {wanted}" if text else "is empty"
        table.problems.add(int(table.lines[row]), f"{name} {what}; {remedy}")
    return Values(values[codes], good[codes], stated[codes])


def whole_numbers(
    table: TextTable,
    name: str,
    *,
    at_least: int = 0,
    at_most: int = LARGEST_WHOLE,
    remedy: str = "write 0, 1, 2, ...",
    may_be_empty: bool = False,
) -> Values:
    """Read a column of whole numbers from `at_least` to `at_most`; empty cells are 0."""

    def meaning(text: str) -> int | None:
        if not _WHOLE.fullmatch(text) or len(text) > LONGEST_WHOLE:
            return None
        number = int(re.split("[.,]", text)[0])
        return number if at_least <= number <= at_most else None

    return read_cells(
        table,
        name,
        meaning,
        wanted=f"a whole number from {at_least} to {at_most:,}",
        remedy=remedy,
        dtype=np.int64,
        empty=0,
        may_be_empty=may_be_empty,
    )


def numbers(
    table: TextTable,
    name: str,
    *,
    at_least: int,
    at_most: int,
    remedy: str,
    may_be_empty: bool = False,
    points_may_group: bool = False,
) -> Values:
    """Read a column of numbers from `at_least` to `at_most`; other cells are NaN.

    A comma is read as the decimal point, as spreadsheets in many languages write it. A cell
    such as 1,500 is refused where 1500 is possible too. With `points_may_group` so is 1.500,
    unless another cell, such as 92.5, shows that the point is a decimal point.
    """

    def meaning(text: str) -> float | None:
        number = _number(text)
        return number if number is not None and at_least <= number <= at_most else None

    distinct, codes = table.columns[name]
    two_ways = _read_two_ways(distinct, min(at_most, LARGEST_GROUPED), points=points_may_group)
    for row in np.flatnonzero(two_ways[codes]):
        text = distinct[codes[row]]
        number = float(text.replace(",", "."))
        table.problems.add(
            int(table.lines[row]),
            f"{name} {quoted(text)} may mean {1000 * number:.0f} or {number:g}; write the one that "
            "is meant",
        )
    return read_cells(
        table,
        name,
        meaning,
        wanted=f"a number from {at_least:,} to {at_most:,}",
        remedy=remedy,
        dtype=np.float64,
        empty=math.nan,
        may_be_empty=may_be_empty,
    )


def words(
    table: TextTable, name: str, meanings: Mapping[str, Any], *, choices: str, empty: Any
) -> Values:
    """Read a column of words, compared by their letters and digits in one case.

    Parameters
    ----------
    table, name
        the column to read.
    meanings
        the value of each word.
    choices
        the words that a message proposes.
    empty
        the value of empty cells, which are allowed.
    """
    return read_cells(
        table,
        name,
        lambda text: meanings.get(letters(text)),
        wanted=choices,
        remedy=f"write {choices}, or leave it empty",
        dtype=type(empty),
        empty=empty,
        may_be_empty=True,
    )


def texts(table: TextTable, name: str, meaning: Callable[[str], str]) -> Values:
    """Read a column of any text; empty cells are ''."""
    return read_cells(
        table, name, meaning, wanted="", remedy="", dtype=object, empty="", may_be_empty=True
    )


def _read_two_ways(texts: Sequence[str], at_most: int, *, points: bool) -> NDArray[np.bool_]:
    """Return which numbers may have a decimal sign or a sign that groups thousands.

    A point is one of them only if `points`, and if no other number shows that it is decimal.
    """
    grouped = [_GROUPED.fullmatch(text) is not None for text in texts]
    others = (text for text, group in zip(texts, grouped, strict=True) if not group)
    points = points and not any("." in text and _number(text) is not None for text in others)
    return np.array(
        [
            group
            and (points or "," in text)
            and abs(float(text.replace(",", "."))) * 1000 <= at_most
            for text, group in zip(texts, grouped, strict=True)
        ],
        dtype=bool,
    )


def _number(text: str) -> float | None:
    if _DECIMAL_COMMA.fullmatch(text):
        text = text.replace(",", ".")
    # Python's float() also takes nan, inf, 1_000 and digits of other scripts.
    if text.strip(_IN_NUMBERS):
        return None
    try:
        return float(text) + 0.0  # -0 is 0
    except ValueError:
        return None


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
