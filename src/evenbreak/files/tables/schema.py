"""A kind of file as its columns: what each is called, what its cells mean, and what must be there.

A schema reads a file in one pass, and the reference's tables of columns are written from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from evenbreak.files.tables.cells import Column
from evenbreak.files.tables.header import Header
from evenbreak.files.tables.table import TextTable, read_table


class Schema:
    r"""The columns of a kind of file.

    Parameters
    ----------
    rows
        what its rows are, such as matches; '' where a file without any is no problem.
    columns
        each by its name.

    >>> import tempfile, pathlib
    >>> from evenbreak.files.tables.cells import Number, Text
    >>> scores = Schema("scores", drill=Text("exercise"), score=Number("points", least=0, most=99))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "scores.csv"
    ...     _ = path.write_text("Drill;Points\nL;48\nL;44,5\n", encoding="utf-8")
    ...     scores.read(path)["score"]
    array([48. , 44.5])
    """

    def __init__(self, rows: str = "", /, **columns: Column) -> None:
        self.rows = rows
        self.columns: Mapping[str, Column] = columns

    def __getitem__(self, name: str) -> Column:
        return self.columns[name]

    def __or__(self, more: Schema) -> Schema:
        """Return the schema with more columns; those of `more` count where both have one."""
        return Schema(self.rows or more.rows, **{**self.columns, **more.columns})

    def but(self, **changes: Mapping[str, Any]) -> Schema:
        """Return the schema with changes to some columns, such as `score={"least": 1}`."""
        changed = {name: replace(self[name], **change) for name, change in changes.items()}
        return Schema(self.rows, **{**self.columns, **changed})

    def only(self, *names: str) -> Schema:
        """Return the schema of some columns."""
        return Schema(self.rows, **{name: self[name] for name in names})

    def header(self) -> Header:
        """Return the header by which the columns are found in a file."""
        return Header(self._names(needed=True), self._names(needed=False), {})

    def _names(self, *, needed: bool) -> dict[str, tuple[str, ...]]:
        return {name: c.aliases for name, c in self.columns.items() if c.needed == needed}

    def text(self, path: str | Path, **how: Any) -> TextTable:
        """Return the table in a file as text, whose cells are still to be read.

        Parameters
        ----------
        path
            the file; '-' is standard input.
        how
            as for `read_table`.
        """
        instead = {
            name: [names.split() for names in column.instead]
            for name, column in self.columns.items()
            if column.instead
        }
        needed, optional = (self._names(needed=needed) for needed in (True, False))
        return read_table(path, needed, optional, instead, rows=self.rows, **how)

    def of(self, table: TextTable) -> TextTable:
        """Return a table with what its cells mean; those without a meaning are its problems."""
        read = {name: column.read(table, name) for name, column in self.columns.items()}
        return replace(table, read=read)

    def read(self, path: str | Path, **how: Any) -> TextTable:
        """Return the table in a file, its cells read; problems are not raised yet."""
        return self.of(self.text(path, **how))
