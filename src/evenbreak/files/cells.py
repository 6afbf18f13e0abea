"""What the cells of a table mean: numbers, words, and anything else that text can be read as.

Each reader adds the cells that it cannot read to the table's `problems` and goes on, so that
everything wrong with a file is found at once.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.problems import quoted
from evenbreak.files.text_table import TextTable
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

    >>> from evenbreak.files.problems import Problems
    >>> from evenbreak.files.text_table import Texts
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
