"""An answer as CSV: the one table, or the quantities, that go into a file or a pipe."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from evenbreak.answers.answer import Quantities
from evenbreak.answers.wording import yes_or_no
from evenbreak.files.csv_writer import csv_lines

if TYPE_CHECKING:
    from evenbreak.answers.answer import Answer


def to_csv(answer: Answer) -> Iterator[str]:
    """Yield an answer's lines of CSV, each with its line end, so that none has to wait."""
    numbers = answer.for_files
    if isinstance(numbers, Quantities):
        rows = ([one.name, _plain(one.value)] for one in numbers.of)
        yield from csv_lines(["quantity", "value"], rows)
    elif numbers is not None:
        exact = [column.exact for column in numbers.columns for _ in column.names]
        yield from csv_lines(numbers.names, _in_full(numbers.records(), exact))


def _plain(value: Any) -> Any:
    """Return a quantity as a file holds it: a truth is a word."""
    return yes_or_no(value) if isinstance(value, bool) else value


def _in_full(rows: Iterator[list[Any]], exact: list[bool]) -> Iterator[list[Any]]:
    """Yield rows, the numbers of some columns as text with all their digits."""
    if not any(exact):
        yield from rows
        return
    for row in rows:
        yield [
            repr(value) if full and value is not None else value
            for value, full in zip(row, exact, strict=True)
        ]
