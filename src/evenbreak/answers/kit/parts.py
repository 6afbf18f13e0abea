"""The parts of an answer: paragraphs, quantities and tables, and the answer as a whole."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import pandas as pd


Show: TypeAlias = Callable[[Any], str]
"""A value as shown to people."""


@dataclass(frozen=True)
class Column:
    """A column in a table.

    `name` is its name in files and JSON, including the unit; several names split something shown as
    one column, such as a race, and the values are then tuples. A column without a name, (), is only
    shown to people, and a column without `words` is only in files. `whole` keeps the words on one
    line, for copying; `detail` shows the column only on request; with `exact`, CSV keeps all digits
    instead of six decimals; `cell` is the value in CSV, such as 'yes' for True.
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
        """The names in files, for one column or several."""
        return (self.name,) if isinstance(self.name, str) else self.name

    def text(self, value: Any) -> str:
        """Return a value as shown to people."""
        return "" if value is None else self.show(value)


@dataclass(frozen=True)
class Table:
    """Rows of values with named columns.

    Without a name, it is a view of numbers that are elsewhere in the JSON. People see the first
    `most` rows, or all of them.
    """

    name: str
    columns: Sequence[Column]
    rows: Iterable[Sequence[Any]]
    title: str = ""
    most: int | None = None

    @property
    def shown_rows(self) -> Iterator[Sequence[Any]]:
        """The rows shown to people."""
        return islice(self.rows, self.most)

    def shown(self, *, verbose: bool = False) -> list[tuple[int, Column]]:
        """Return the columns shown to people, each with its position in a row."""
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
        """Yield the rows as in files: a value for each of `names`."""
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
        """Return the rows as in JSON."""
        return [dict(zip(self.names, record, strict=True)) for record in self.records()]

    def to_frame(self) -> pd.DataFrame:
        """Return it as a DataFrame with its CSV's columns."""
        import pandas as pd

        return pd.DataFrame(list(self.records()), columns=self.names)


@dataclass(frozen=True)
class Quantity:
    """A named number or plain word; not shown if the value is None."""

    column: Column
    value: Any
    note: str = ""

    @property
    def name(self) -> str:
        """Its key in JSON, and its row in CSV."""
        return self.column.names[0]

    @property
    def words(self) -> str | None:
        """Its label; None if it is in files only."""
        return self.column.words

    @property
    def label(self) -> str:
        """Its label on one line."""
        return (self.words or "").replace("\n", " ")

    @property
    def text(self) -> str:
        """Its value as shown to people."""
        return self.column.text(self.value)

    @property
    def detail(self) -> bool:
        """Whether it is shown only with the details."""
        return self.column.detail


@dataclass(frozen=True)
class Quantities:
    """Quantities, one per line; not `in_json` if the numbers are elsewhere in the JSON."""

    of: Sequence[Quantity]
    title: str = ""
    in_json: bool = True

    def shown(self, *, verbose: bool = False) -> list[Quantity]:
        """Return the quantities that are shown to people."""
        return [
            one
            for one in self.of
            if one.words is not None and one.value is not None and (verbose or not one.detail)
        ]


Part: TypeAlias = str | Quantities | Table
"""A paragraph, or numbers."""


SCHEMA_VERSION = 1
"""The version of an answer's JSON, which changes when a key changes its meaning."""


@dataclass(frozen=True)
class Content:
    """The answer to a question, whatever the output format.

    People read `parts`, the first of which is the answer in words, and, on request, `details`. JSON
    has `data` in addition to their quantities and tables. `csv` is the table written to a file or a
    pipe; by default, the first table in `parts`. `drawn` is what a picture shows
    (`evenbreak.plots.asked`).
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
        """The paragraphs, except those in the details."""
        return [part for part in self.parts if isinstance(part, str)]

    @property
    def for_files(self) -> Quantities | Table | None:
        """The table or quantities written to a file or a pipe."""
        numbers = (part for part in (*self.parts, *self.details) if not isinstance(part, str))
        return self.csv if self.csv is not None else next(numbers, None)
