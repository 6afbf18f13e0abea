"""A type of file, defined by its columns: names, cell contents, and which are required.

A schema reads a file in one pass; each column type adds the cells it can't read to the table's
`problems` and goes on, so that everything wrong with a file is found at once. The column tables in
the reference are made from the schemas.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.tables.given_names import (
    with_full_names,
    with_given_names_first,
    with_teams_of_titles,
)
from evenbreak.files.tables.header import Header
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.table import ENOUGH_ROWS, TextTable, Values, read_table
from evenbreak.ratings.results_frame import LARGEST_WHOLE, letters
from evenbreak.words import say

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
    """A column in a type of file; its class defines what the cells mean.

    `also` are other names, separated by commas; `instead` has sets of columns that can replace it,
    each as names separated by spaces. With `filled`, no cell may be empty; `empty` says what an
    empty cell means, such as "for a new player" (None: that depends on other columns), and
    `nothing` is its value. `write` is the remedy for an unreadable cell, '' for the usual one.
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
    given_first: ClassVar[bool] = False

    @property
    def aliases(self) -> tuple[str, ...]:
        """Its other names, one at a time."""
        return tuple(self.also.split(", ")) if self.also else ()

    @property
    def wanted(self) -> str:
        """What a cell should contain."""
        return say("any text")

    @property
    def usual(self) -> str:
        """What to write instead of a cell, if `write` doesn't say."""
        return self.wanted

    @property
    def remedy(self) -> str:
        """How to correct a cell."""
        it = self.write or self.usual
        if self.filled or self.empty is None:
            return say("Write {it}.", it=it)
        if not self.empty:
            return say("Write {it}, or leave it empty.", it=it)
        return say("Write {it}, or leave it empty {meaning}.", it=it, meaning=self.empty)

    def called(self, also: str, about: str = "", **changes: Any) -> Self:
        """Return a column with the same cell type and other names."""
        return replace(self, also=also, about=about, **changes)

    def meaning(self, text: str) -> Any:
        """Return the value of a nonempty cell; None if it has none."""
        return text

    def fault(self, text: str) -> str:
        """Return what is wrong with an unreadable cell, and what to do."""
        if not text:
            return say("is empty. {remedy}", remedy=self.remedy)
        return say(
            "{cell} isn't {wanted}. {remedy}",
            cell=quoted(text),
            wanted=self.wanted,
            remedy=self.remedy,
        )

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column, adding each unreadable cell to the table's problems.

        A column that the file lacks is all empty, which isn't an additional problem.

        >>> from evenbreak.files.tables.problems import Problems
        >>> from evenbreak.files.tables.table import Texts
        >>> columns = {"score": Texts(["7", "seven"], np.array([0, 1, 0]))}
        >>> table = TextTable("r.csv", np.array([2, 3, 5]), columns, frozenset(columns),
        ...                   Problems("r.csv"), (), "")
        >>> Whole(filled=True).read(table, "score").values
        array([7, 0, 7])
        >>> table.problems.raise_any()
        Traceback (most recent call last):
        ...
        evenbreak.errors.DataError: r.csv:3: score 'seven' isn't a whole number from 0 to 1,000,000.
            Write 0, 1, 2, ....
        """
        distinct, codes = table.columns[name]
        stated = np.array([bool(text) for text in distinct], dtype=bool)
        meant = [self.meaning(text) if text else None for text in distinct]
        values = np.empty(len(meant), dtype=self.dtype)
        values[:] = [self.nothing if value is None else value for value in meant]
        good = np.array([value is not None for value in meant], dtype=bool)
        if not self.filled or name not in table.found:
            good |= ~stated
        bad = np.flatnonzero(~good[codes])
        if len(bad) >= ENOUGH_ROWS and len(bad) == int(stated[codes].sum()):
            table.problems.add(
                table.header or None,
                "none of the {n:,} cells in {column} can be read; {column} {fault}",
                n=len(bad),
                column=name,
                fault=self.fault(distinct[codes[bad[0]]]),
            )
            bad = bad[:0]
        for row in bad:
            fault = self.fault(distinct[codes[row]])
            table.note(row, "{column} {fault}", column=name, fault=fault)
        return Values(values[codes], good[codes], stated[codes])


@dataclass(frozen=True, kw_only=True)
class Text(Column):
    """Any text; `form` converts it to the form in which it is used."""

    form: Callable[[str], str] = str

    def meaning(self, text: str) -> str:
        """Return the text in that form."""
        return self.form(text)


@dataclass(frozen=True, kw_only=True)
class Whole(Column):
    """Whole numbers from `least` to `most`."""

    least: int = 0
    most: int = LARGEST_WHOLE
    nothing: int = 0

    dtype: ClassVar[Any] = np.int64

    @property
    def wanted(self) -> str:
        """What a cell should contain."""
        return say("a whole number from {least} to {most:,}", least=self.least, most=self.most)

    @property
    def usual(self) -> str:
        """What to write instead of a cell."""
        return say("1, 2, 3, ...") if self.least else say("0, 1, 2, ...")

    def meaning(self, text: str) -> int | None:
        """Return the number."""
        if not _WHOLE.fullmatch(text) or len(text) > LONGEST_WHOLE:
            return None
        number = int(re.split("[.,]", text)[0])
        return number if self.least <= number <= self.most else None


@dataclass(frozen=True, kw_only=True)
class Number(Column):
    """Numbers from `least` to `most`.

    A comma is read as the decimal point, as spreadsheets in many languages write it. A cell such as
    1,500 is rejected if it could also mean 1500. With `grouped`, so is 1.500, unless another cell,
    such as 92.5, shows that the point is a decimal point.
    """

    least: int
    most: int
    grouped: bool = False
    nothing: float = math.nan

    dtype: ClassVar[Any] = np.float64

    @property
    def wanted(self) -> str:
        """What a cell should contain."""
        return say("a number from {least:,} to {most:,}", least=self.least, most=self.most)

    def meaning(self, text: str) -> float | None:
        """Return the number."""
        number = _number(text)
        return number if number is not None and self.least <= number <= self.most else None

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column; a cell that could be either of two numbers is also a problem."""
        distinct, codes = table.columns[name]
        two_ways = _read_two_ways(distinct, min(self.most, LARGEST_GROUPED), points=self.grouped)
        for row in np.flatnonzero(two_ways[codes]):
            text = distinct[codes[row]]
            number = float(text.replace(",", "."))
            table.note(
                row,
                "{column} {cell} may mean {thousands:.0f} or {number:g}. Write the one you mean.",
                column=name,
                cell=quoted(text),
                thousands=1000 * number,
                number=number,
            )
        return super().read(table, name)


@dataclass(frozen=True, kw_only=True)
class Word(Column):
    """Words with the values in `values`, comparing only letters and digits.

    `choices` are the words that a message suggests.
    """

    values: Mapping[str, Any]
    choices: str
    nothing: int = 0

    dtype: ClassVar[Any] = np.int64

    @property
    def wanted(self) -> str:
        """What a cell should contain."""
        return self.choices

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
    """What `parse` reads from a string; it returns None if the string means nothing."""

    parse: Callable[[str], Any]
    kind: str

    @property
    def wanted(self) -> str:
        """What a cell should contain."""
        return self.kind

    def meaning(self, text: str) -> Any:
        """Return a string's value."""
        return self.parse(text)


class Schema:
    """A file type's columns by name; `rows` is '' if a file without rows is fine."""

    def __init__(self, rows: str = "", /, **columns: Column) -> None:
        self.rows = rows
        self.columns: Mapping[str, Column] = columns

    def __getitem__(self, name: str) -> Column:
        return self.columns[name]

    def __or__(self, more: Schema) -> Schema:
        """Return the schema with more columns; `more` takes precedence over existing columns."""
        return Schema(self.rows or more.rows, **{**self.columns, **more.columns})

    def but(self, **changes: Mapping[str, Any]) -> Schema:
        """Return the schema with changes to some columns, such as `score={"least": 1}`."""
        changed = {name: replace(self[name], **change) for name, change in changes.items()}
        return Schema(self.rows, **{**self.columns, **changed})

    def only(self, *names: str) -> Schema:
        """Return a schema with only some of the columns."""
        return Schema(self.rows, **{name: self[name] for name in names})

    def header(self) -> Header:
        """Return the header definition used to find the columns in a file."""
        return Header(self._names(needed=True), self._names(needed=False), self._instead())

    def _instead(self) -> dict[str, list[list[str]]]:
        return {
            name: [names.split() for names in column.instead]
            for name, column in self.columns.items()
            if column.instead
        }

    def _names(self, *, needed: bool) -> dict[str, tuple[str, ...]]:
        return {name: c.aliases for name, c in self.columns.items() if c.needed == needed}

    def text(self, path: str | Path, **how: Any) -> TextTable:
        """Return the table in a file as text, with its cells still to be read."""
        needed, optional = (self._names(needed=needed) for needed in (True, False))
        table = read_table(path, needed, optional, self._instead(), rows=self.rows, **how)
        if "given_name" in self.columns:
            table = with_teams_of_titles(with_full_names(table))
        names = [name for name, column in self.columns.items() if column.given_first]
        return with_given_names_first(table, names)

    def of(self, table: TextTable) -> TextTable:
        """Return a table with its cells' values, adding unreadable cells to its problems."""
        read = {name: column.read(table, name) for name, column in self.columns.items()}
        return replace(table, read=read)

    def read(self, path: str | Path, **how: Any) -> TextTable:
        """Return the table in a file with its cells read, but without raising problems yet."""
        return self.of(self.text(path, **how))


def _read_two_ways(texts: Sequence[str], at_most: int, *, points: bool) -> NDArray[np.bool_]:
    """Return which numbers may have a sign that is either a decimal or a thousands separator.

    A point is ambiguous only with `points`, and only if no other number shows that it is a decimal
    point.
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
