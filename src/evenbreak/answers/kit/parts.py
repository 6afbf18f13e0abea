"""What an answer is made of: paragraphs, quantities and tables, and all of them together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import pandas as pd


Show: TypeAlias = Callable[[Any], str]
"""A value as a person reads it."""


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Parameters
    ----------
    name
        its name in files and JSON, with the unit in it; or several names, where a person reads
        as one what files keep apart, such as a race: its values are then tuples. Without any
        name, (), only a person reads it.
    words
        what a person reads above it, its lines parted by line breaks; None: it is in files only.
    show
        a value as a person reads it; None is shown empty, whatever this says.
    left
        whether a person finds it flush left.
    whole
        whether its words stay on one line where the table is too wide, to be copied from there.
    detail
        whether only those read it who ask for details.
    exact
        whether CSV has its numbers with all their digits, in place of six decimals.
    cell
        a value as CSV has it, such as 'yes' for True; by default the value itself.
    """

    name: str | tuple[str, ...]
    words: str | None = None
    show: Show = str
    left: bool = False
    whole: bool = False
    detail: bool = False
    exact: bool = False
    cell: Show | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The names in files, of one column or several."""
        return (self.name,) if isinstance(self.name, str) else self.name

    def text(self, value: Any) -> str:
        """Return a value as a person reads it."""
        return "" if value is None else self.show(value)


@dataclass(frozen=True)
class Table:
    """Rows of values with named columns.

    Parameters
    ----------
    name
        its key in JSON; empty for a view of numbers that JSON holds elsewhere.
    columns
        what stands in each row.
    rows
        the values, a row at a time; whatever can be gone through more than once.
    title
        a line above it.
    most
        how many of its rows a person reads, the first; None: all.
    """

    name: str
    columns: Sequence[Column]
    rows: Iterable[Sequence[Any]]
    title: str = ""
    most: int | None = None

    @property
    def shown_rows(self) -> Iterator[Sequence[Any]]:
        """The rows that a person reads."""
        return islice(self.rows, self.most)

    def shown(self, *, verbose: bool = False) -> list[tuple[int, Column]]:
        """Return the columns that a person reads, each with its place in a row."""
        return [
            (k, column)
            for k, column in enumerate(self.columns)
            if column.words is not None and (verbose or not column.detail)
        ]

    @property
    def names(self) -> list[str]:
        """The columns of its CSV."""
        return [name for column in self.columns for name in column.names]

    def records(self) -> Iterator[list[Any]]:
        """Yield the rows as files hold them: a value for each of `names`."""
        wide = [len(column.names) for column in self.columns]
        for row in self.rows:
            record: list[Any] = []
            for value, many in zip(row, wide, strict=True):
                if isinstance(value, tuple) and many:
                    record += value
                else:
                    record += [value] * many  # one value, or None for all
            yield record

    def to_dicts(self) -> list[dict[str, Any]]:
        """Return the rows as JSON holds them."""
        return [dict(zip(self.names, record, strict=True)) for record in self.records()]

    def to_frame(self) -> pd.DataFrame:
        """Return it as a DataFrame with the columns of its CSV."""
        import pandas as pd

        return pd.DataFrame(list(self.records()), columns=self.names)


@dataclass(frozen=True)
class Quantity:
    """One number, or a plain word, with its name.

    Parameters
    ----------
    column
        its name, its words and how it is shown, as of a column of a table.
    value
        None where there is none; it is then not shown.
    note
        what stands behind it, such as an interval.
    """

    column: Column
    value: Any
    note: str = ""

    @property
    def name(self) -> str:
        """Its key in JSON, its row in CSV."""
        return self.column.names[0]

    @property
    def words(self) -> str | None:
        """What a person calls it; None: it is in files only."""
        return self.column.words

    @property
    def label(self) -> str:
        """Its words in one line."""
        return (self.words or "").replace("\n", " ")

    @property
    def text(self) -> str:
        """Its value as a person reads it."""
        return self.column.text(self.value)

    @property
    def detail(self) -> bool:
        """Whether only those read it who ask for details."""
        return self.column.detail


@dataclass(frozen=True)
class Quantities:
    """Quantities, a line each.

    Parameters
    ----------
    of
        the quantities.
    title
        a line above them.
    in_json
        False for a view of numbers that JSON holds elsewhere.
    """

    of: Sequence[Quantity]
    title: str = ""
    in_json: bool = True

    def shown(self, *, verbose: bool = False) -> list[Quantity]:
        """Return those that a person reads."""
        return [
            one
            for one in self.of
            if one.words is not None and one.value is not None and (verbose or not one.detail)
        ]


Part: TypeAlias = str | Quantities | Table
"""A paragraph, or numbers."""


SCHEMA_VERSION = 1
"""Of an answer's JSON; it changes when a key changes its meaning."""


@dataclass(frozen=True)
class Content:
    """What a question is answered with: sentences, quantities, tables and warnings, and no face.

    Parameters
    ----------
    heading
        what was asked, and of whom or what, in a line or two.
    parts
        what a person reads, in that order. The first is a paragraph: the answer in words.
    details
        what only those read who ask for it: statistics, with their words explained.
    warnings
        what may be wrong with what was given, a sentence each.
    data
        what JSON holds besides the quantities and tables of `parts` and `details`.
    csv
        the one of its tables or quantities that goes into a file or a pipe; without it the
        first of `parts`.
    schema_version
        of its JSON.
    drawn
        what a picture of it shows (`evenbreak.plots.asked`).
    """

    heading: str
    parts: Sequence[Part]
    details: Sequence[Part] = ()
    warnings: Sequence[str] = ()
    data: Mapping[str, Any] = field(default_factory=dict)
    csv: Quantities | Table | None = None
    schema_version: int = SCHEMA_VERSION
    drawn: Any = field(default=None, repr=False, compare=False)

    @property
    def sentences(self) -> list[str]:
        """The paragraphs, those of the details left out."""
        return [part for part in self.parts if isinstance(part, str)]

    @property
    def for_files(self) -> Quantities | Table | None:
        """What goes into a file or a pipe."""
        numbers = (part for part in (*self.parts, *self.details) if not isinstance(part, str))
        return self.csv if self.csv is not None else next(numbers, None)
