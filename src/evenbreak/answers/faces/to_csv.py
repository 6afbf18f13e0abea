"""An answer as CSV: the one table, or the quantities, written to a file or a pipe."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from evenbreak.answers.kit.parts import Content, Quantities, Show, Table
from evenbreak.files.csv_writer import csv_lines


def to_csv(answer: Content) -> Iterator[str]:
    """Yield an answer's lines of CSV, each with its line ending, so that none has to wait."""
    numbers = answer.for_files
    if isinstance(numbers, Quantities):
        yield from csv_lines(["quantity", "value"], ([one.name, one.value] for one in numbers.of))
    elif numbers is not None:
        yield from table_lines(numbers)


def table_lines(table: Table) -> Iterator[str]:
    """Yield a table's lines of CSV, each with its line ending."""
    cells = [repr if c.exact else c.cell for c in table.columns for _ in c.names]
    yield from csv_lines(table.names, _as_cells(table.records(), cells))


def _as_cells(rows: Iterator[list[Any]], cells: list[Show | None]) -> Iterator[list[Any]]:
    """Yield rows, converting some columns' values to their text in CSV."""
    if not any(cells):
        yield from rows
        return
    for row in rows:
        yield [
            value if cell is None or value is None else cell(value)
            for value, cell in zip(row, cells, strict=True)
        ]
