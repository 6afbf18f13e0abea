"""What the cells of a table say: numbers, and anything else that a text can be read as.

Each reader notes the cells that it cannot read in the table's `problems` and goes on,
so that one look at a file tells all that is wrong with it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from datetime import date
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.problems import quoted
from evenbreak.files.text_table import Table

# Spreadsheets that once saw a gap in a column write its whole numbers as 7.0.
# A comma before three noughts would group thousands.
_WHOLE = re.compile(r"[+-]?[0-9]+(\.0*|,00?)?", re.ASCII)
_TIME = r"([T ]\d{1,2}:\d{2}\S*)?"
_YEAR_FIRST = re.compile(r"(\d{4})[-/](\d{1,2})[-/](\d{1,2})" + _TIME, re.ASCII)
_DAY_FIRST = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})" + _TIME, re.ASCII)
_IN_NUMBERS = "0123456789+-.eE"
_DECIMAL_COMMA = re.compile(r"[^.,]*,[^.,]*")
LARGEST_WHOLE = 1_000_000
LONGEST_WHOLE = 20  # characters; Python refuses to read numbers of thousands of digits


class Values(NamedTuple):
    """A column as read: a value for each row, and whether its cell could be read.

    Cells that could not be read, empty ones among them, have the value for empty cells.
    """

    values: NDArray[Any]
    good: NDArray[np.bool_]


def read_cells(
    table: Table,
    name: str,
    meaning: Callable[[str], Any],
    *,
    wanted: str,
    remedy: str,
    dtype: Any,
    empty: Any,
    may_be_empty: bool = False,
) -> Values:
    """Read a column, noting in the table's problems each cell that has no meaning.

    Parameters
    ----------
    table, name
        the column to read; one that the file lacks is all empty and no further problem.
    meaning
        from the text of a cell, never empty, to its value; None where it has none.
    wanted, remedy
        what a cell should be, and how to mend one: "x is not `wanted`; `remedy`".
    dtype
        numpy type of the values.
    empty
        the value of empty cells.
    may_be_empty
        whether empty cells are no problem.

    >>> from evenbreak.files.problems import Problems
    >>> from evenbreak.files.text_table import Texts
    >>> column = Texts(["7", "seven"], np.array([0, 1, 0]))
    >>> table = Table("r.csv", np.array([2, 3, 5]), {"score": column}, Problems("r.csv"), (), b"")
    >>> read_cells(table, "score", lambda text: {"7": 7}.get(text), wanted="a score",
    ...            remedy="write 0, 1, 2, ...", dtype=int, empty=0).values
    array([7, 0, 7])
    >>> table.problems.raise_any()
    Traceback (most recent call last):
    ...
    evenbreak.errors.DataError: r.csv:3: score 'seven' is not a score; write 0, 1, 2, ...
    """
    distinct, codes = table.texts(name)
    meant = [meaning(text) if text else None for text in distinct]
    values = np.array([empty if value is None else value for value in meant], dtype=dtype)
    good = np.array([value is not None for value in meant], dtype=bool)
    if may_be_empty or name not in table:
        good |= np.array([not text for text in distinct], dtype=bool)

    def message(row: int) -> str:
        text = distinct[codes[row]]
        if not text:
            return f"{name} is empty; {remedy}"
        return f"{name} {quoted(text)} is not {wanted}; {remedy}"

    table.problems.add_rows(table.lines, np.flatnonzero(~good[codes]), message)
    return Values(values[codes], good[codes])


def whole_numbers(
    table: Table,
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


def numbers(table: Table, name: str, *, remedy: str, may_be_empty: bool = False) -> Values:
    """Read a column of finite numbers; cells that are none are NaN.

    A comma is read as the decimal point, as spreadsheets in many languages write it, and
    never groups thousands.
    """
    return read_cells(
        table,
        name,
        _number,
        wanted="a number",
        remedy=remedy,
        dtype=np.float64,
        empty=math.nan,
        may_be_empty=may_be_empty,
    )


def dates(table: Table, name: str) -> Values:
    """Read a column of dates; a time after one is ignored, empty cells are NaT.

    With dots the day comes first, else the year: of 9/3/2024 some would read the 9th of
    March and others the 3rd of September.
    """
    return read_cells(
        table,
        name,
        read_date,
        wanted="a date",
        remedy="write 2024-09-03 or 3.9.2024 (3/9/2024 has two readings), or leave it empty",
        dtype="datetime64[D]",
        empty=np.datetime64("NaT"),
        may_be_empty=True,
    )


def read_date(text: str) -> np.datetime64 | None:
    """Return the date that a text says, as `dates` reads it; None where it says none.

    >>> read_date("3.9.2024"), read_date("3/9/2024")
    (np.datetime64('2024-09-03'), None)
    """
    match, order = _YEAR_FIRST.fullmatch(text), (1, 2, 3)
    if match is None:
        match, order = _DAY_FIRST.fullmatch(text), (3, 2, 1)
    try:
        return np.datetime64(date(*map(int, match.group(*order)))) if match else None
    except ValueError:
        return None


def _number(text: str) -> float | None:
    if _DECIMAL_COMMA.fullmatch(text):
        text = text.replace(",", ".")
    # Python's float() also takes nan, inf, 1_000 and digits of other scripts.
    if text.strip(_IN_NUMBERS):
        return None
    try:
        number = float(text)
    except ValueError:
        return None
    return number if math.isfinite(number) else None
