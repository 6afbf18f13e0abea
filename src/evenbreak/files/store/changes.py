"""All entries in a file, in the order they were made, whatever their strand.

An entry is identified by its row number, which is the same for every program that reads the file
and is never reused: if a tournament is removed, a row says so. A checksum of the entry's content is
stored with the number, because other files have a row with that number too.
"""

from __future__ import annotations

import sqlite3
from pathlib import Path
from typing import NamedTuple
from zlib import crc32

from evenbreak.files.store.evening_file import is_there, opened
from evenbreak.files.store.formats import ENTRIES, source

CLEARED = "cleared"
"""The strand of the row that marks everything before it as removed, except team nights."""


class Row(NamedTuple):
    """An entry as stored, without its author; `what` is JSON."""

    id: int
    strand: str
    number: int
    at: str
    kind: str
    what: str

    @property
    def mark(self) -> str:
        """The entry's ID, unique even if files are replaced or copied.

        >>> Row(7, "1", 3, "2025-03-01T19:30:00", "redone", '{"entry": 2}').mark
        '7-cde79473'
        """
        return f"{self.id}-{crc32(ascii(tuple(self)).encode()):08x}"


def rows_from(path: str | Path, first: int, most: int) -> list[Row]:
    """Return a file's entries from an ID on, the last `most` of them; none if it has none.

    Entries from an earlier version have the IDs they will keep after the update. Raises DataError
    if the file exists and can't be read.
    """
    if not is_there(path):
        return []
    asked = "id, strand, number, at, kind, what"
    with opened(path) as base:
        where = source(base)
        key = "rowid" if where == ENTRIES else "ROW_NUMBER() OVER ()"
        rows = base.execute(
            f"SELECT {asked} FROM (SELECT {key} AS id, * FROM {where}) "  # noqa: S608
            "WHERE id >= ? ORDER BY id DESC LIMIT ?",
            (first, most),
        ).fetchall()
    return [Row(*row) for row in reversed(rows)]


def clear(base: sqlite3.Connection, but: str) -> None:
    """Remove all entries from a file except one strand's; their IDs aren't reused."""
    last = base.execute(f"SELECT MAX(rowid) FROM {ENTRIES}").fetchone()[0]  # noqa: S608
    base.execute(f"DELETE FROM {ENTRIES} WHERE strand != ?", (but,))  # noqa: S608
    if last is not None:
        base.execute(
            f"INSERT INTO {ENTRIES} (rowid, strand, number, at, kind, what, author) "  # noqa: S608
            "VALUES (?, ?, 1, '', '', '', '')",
            (last + 1, CLEARED),
        )
