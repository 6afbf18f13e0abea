"""The kinds of columns: what their cells mean, and what is said of a cell without a meaning.

Each kind adds the cells that it cannot read to the table's `problems` and goes on, so that
everything wrong with a file is found at once.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from typing import Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from evenbreak.checks import one_of
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.table import TextTable, Values
from evenbreak.ratings.results_frame import LARGEST_WHOLE, letters
from evenbreak.words import Parameter, say

# Spreadsheets that once saw a gap in a column write its whole numbers as 7.0.
# A comma or point before three zeros may group thousands.
_WHOLE = re.compile(r"[+-]?[0-9]+(\.0{0,2}|\.0{4,}|,00?)?", re.ASCII)
_GROUPED = re.compile(r"[+-]?[1-9][0-9]{0,2}[.,][0-9]{3}", re.ASCII)
_IN_NUMBERS = "0123456789+-.eE"
_DECIMAL_COMMA = re.compile(r"[^.,]*,[^.,]*")
LARGEST_GROUPED = 10_000  # 92,347 means 92.347: no rating of 92347 points is in use
LONGEST_WHOLE = 20  # characters; Python refuses to read numbers of thousands of digits


@dataclass(frozen=True, kw_only=True)
class Column:
    """A column of a kind of file; its class says what the cells mean.

    Parameters
    ----------
    also
        its other names, separated by commas.
    about
        what it holds, as the reference puts it.
    needed
        whether a file must have it.
    instead
        sets of columns that can take its place, each as names separated by blanks.
    filled
        whether every cell must hold something.
    empty
        what an empty cell means, such as "for a new player"; None: other columns settle that.
    write
        what to write in place of a cell that cannot be read.
    nothing
        the value of an empty cell.
    """

    also: str = field(default="", kw_only=False)
    about: str = field(default="", kw_only=False)
    needed: bool = False
    instead: Sequence[str] = ()
    filled: bool = False
    empty: str | None = ""
    write: str = ""
    nothing: Any = ""

    dtype: ClassVar[Any] = object

    @property
    def aliases(self) -> tuple[str, ...]:
        """Its other names, one by one."""
        return tuple(self.also.split(", ")) if self.also else ()

    @property
    def wanted(self) -> str:
        """What a cell should be."""
        return say("any text")

    @property
    def remedy(self) -> str:
        """How to correct a cell."""
        if self.filled or self.empty is None:
            return say("write {it}", it=self.write)
        if not self.empty:
            return say("write {it}, or leave it empty", it=self.write)
        return say("write {it}, or leave it empty {meaning}", it=self.write, meaning=self.empty)

    def called(self, also: str, about: str = "", **changes: Any) -> Self:
        """Return a column whose cells mean the same, with other names."""
        return replace(self, also=also, about=about, **changes)

    def meaning(self, text: str) -> Any:
        """Return the value of a cell that is not empty; None where it has none."""
        return text

    def fault(self, text: str) -> str:
        """Return what is wrong with a cell that has no meaning, and what to do."""
        if not text:
            return say("is empty; {remedy}", remedy=self.remedy)
        return say(
            "{cell} is not {wanted}; {remedy}",
            cell=quoted(text),
            wanted=self.wanted,
            remedy=self.remedy,
        )

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column, adding each cell without a meaning to the table's problems.

        One that the file lacks is empty throughout, which is not a further problem.

        >>> from evenbreak.files.tables.problems import Problems
        >>> from evenbreak.files.tables.table import Texts
        >>> columns = {"score": Texts(["7", "seven"], np.array([0, 1, 0]))}
        >>> table = TextTable("r.csv", np.array([2, 3, 5]), columns, frozenset(columns),
        ...                   Problems("r.csv"), (), b"")
        >>> Whole(filled=True).read(table, "score").values
        array([7, 0, 7])
        >>> table.problems.raise_any()
        Traceback (most recent call last):
        ...
        evenbreak.errors.DataError: r.csv:3: score 'seven' is not a whole number from 0 to
        1,000,000; write 0, 1, 2, ...
        """
        distinct, codes = table.columns[name]
        stated = np.array([bool(text) for text in distinct], dtype=bool)
        meant = [self.meaning(text) if text else None for text in distinct]
        values = np.empty(len(meant), dtype=self.dtype)
        values[:] = [self.nothing if value is None else value for value in meant]
        good = np.array([value is not None for value in meant], dtype=bool)
        if not self.filled or name not in table.found:
            good |= ~stated
        for row in np.flatnonzero(~good[codes]):
            fault = self.fault(distinct[codes[row]])
            table.problems.add(int(table.lines[row]), "{column} {fault}", column=name, fault=fault)
        return Values(values[codes], good[codes], stated[codes])


@dataclass(frozen=True, kw_only=True)
class Text(Column):
    """Any text; `form` gives it the form in which it is used."""

    form: Callable[[str], str] = str

    def meaning(self, text: str) -> str:
        """Return the text in its form."""
        return self.form(text)


@dataclass(frozen=True, kw_only=True)
class Whole(Column):
    """Whole numbers from `least` to `most`."""

    least: int = 0
    most: int = LARGEST_WHOLE
    write: str = say("0, 1, 2, ...")
    nothing: int = 0

    dtype: ClassVar[Any] = np.int64

    @property
    def wanted(self) -> str:
        """What a cell should be."""
        return say("a whole number from {least} to {most:,}", least=self.least, most=self.most)

    def meaning(self, text: str) -> int | None:
        """Return the number."""
        if not _WHOLE.fullmatch(text) or len(text) > LONGEST_WHOLE:
            return None
        number = int(re.split("[.,]", text)[0])
        return number if self.least <= number <= self.most else None


@dataclass(frozen=True, kw_only=True)
class Number(Column):
    """Numbers from `least` to `most`.

    A comma is read as the decimal point, as spreadsheets in many languages write it. A cell
    such as 1,500 is refused where 1500 is possible too. With `grouped` so is 1.500, unless
    another cell, such as 92.5, shows that the point is a decimal point.
    """

    least: int
    most: int
    grouped: bool = False
    nothing: float = math.nan

    dtype: ClassVar[Any] = np.float64

    @property
    def wanted(self) -> str:
        """What a cell should be."""
        return say("a number from {least:,} to {most:,}", least=self.least, most=self.most)

    def meaning(self, text: str) -> float | None:
        """Return the number."""
        number = _number(text)
        return number if number is not None and self.least <= number <= self.most else None

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column; a cell that may be either of two numbers is a problem too."""
        distinct, codes = table.columns[name]
        two_ways = _read_two_ways(distinct, min(self.most, LARGEST_GROUPED), points=self.grouped)
        for row in np.flatnonzero(two_ways[codes]):
            text = distinct[codes[row]]
            number = float(text.replace(",", "."))
            table.problems.add(
                int(table.lines[row]),
                "{column} {cell} may mean {thousands:.0f} or {number:g}; write the one you mean",
                column=name,
                cell=quoted(text),
                thousands=1000 * number,
                number=number,
            )
        return super().read(table, name)


@dataclass(frozen=True, kw_only=True)
class Word(Column):
    """Words with the values that they have in `values`, compared by letters and digits alone.

    `choices` are the words that a message proposes.
    """

    values: Mapping[str, Any]
    choices: str
    nothing: int = 0

    dtype: ClassVar[Any] = np.int64

    @property
    def wanted(self) -> str:
        """What a cell should be."""
        return self.choices

    @property
    def remedy(self) -> str:
        """How to correct a cell."""
        return replace(self, write=self.choices).remedy if not self.write else super().remedy

    def meaning(self, text: str) -> Any:
        """Return the value of a word."""
        return self.values.get(letters(text))


@dataclass(frozen=True, kw_only=True)
class YesNo(Word):
    """Words for yes and no."""

    choices: str = say("yes or no")
    nothing: bool = False

    dtype: ClassVar[Any] = np.bool_


@dataclass(frozen=True, kw_only=True)
class Parsed(Column):
    """What `parse` reads from a text; it returns None where a text has no meaning."""

    parse: Callable[[str], Any]
    kind: str

    @property
    def wanted(self) -> str:
        """What a cell should be."""
        return self.kind

    def meaning(self, text: str) -> Any:
        """Return the value of a text."""
        return self.parse(text)


_NO_DAY = np.datetime64("NaT")

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

    With dots the day comes first, in 2024-09-03 and 2024/9/3 the year. In 9/3/2024 the month
    may come first or the day: `order` says which, or else any cell of the column in which only
    one of them is possible. If nothing does, the order is `open`: one problem of the table.
    """

    order: DateOrder | None = None
    write: str = say("2024-09-03, 3.9.2024 or 9/3/2024")
    nothing: np.datetime64 = _NO_DAY
    open: bool = False

    dtype: ClassVar[Any] = "datetime64[D]"

    @property
    def wanted(self) -> str:
        """What a cell should be."""
        return say("a date")

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column; what leaves the order of day and month open is one problem."""
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
    """Return the date that a text states, read as in `Day`; None where it states none.

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
            say(
                "{date} in line {line}",
                date=quoted(settled[order]),
                line=table.lines[(codes == distinct.index(settled[order])).argmax()],
            )
            for order in ORDERS
        )
        table.problems.add(
            None,
            "{column} has the month first ({mdy}) and the day first ({dmy}); use one order",
            column=name,
            mdy=mdy,
            dmy=dmy,
        )
        return None, True
    if open_:
        row = int(np.isin(codes, open_).argmax())
        table.problems.add(
            int(table.lines[row]),
            "{column} {date} may have the month first or the day, and no date of the file shows "
            "which; add {dates} mdy (month first) or {dates} dmy (day first)",
            column=name,
            date=quoted(distinct[codes[row]]),
            dates=Parameter("dates"),
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
