"""All entries of a file in the one order in which they came in, whatever strand they are in.

An entry is known by the number of its row, which is the same for every program that reads the file
and is never given again: where a tournament is taken out, a row says so. A sum of what the entry
says stands next to the number, for other files have a row of that number too.
"""

from __future__ import annotations

import sqlite3
from pathlib import Path
from typing import NamedTuple
from zlib import crc32

from evenbreak.files.store.evening_file import is_there, opened
from evenbreak.files.store.formats import ENTRIES, source

CLEARED = "cleared"
"""The strand of the row that says that all before it is gone, save the team nights."""


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
        """What the entry is known by wherever files are replaced by others, or copied.

        >>> Row(7, "1", 3, "2025-03-01T19:30:00", "redone", '{"entry": 2}').mark
        '7-cde79473'
        """
        return f"{self.id}-{crc32(ascii(tuple(self)).encode()):08x}"


def rows_from(path: str | Path, first: int, most: int) -> list[Row]:
    """Return the entries of a file from an id on, the last `most` of them; none if it has none.

    Entries of an earlier version have the ids that they keep in the update. A DataError if there is
    a file that can't be read.
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
    """Take all entries out of a file but those of a strand; their ids are not given again."""
    last = base.execute(f"SELECT MAX(rowid) FROM {ENTRIES}").fetchone()[0]  # noqa: S608
    base.execute(f"DELETE FROM {ENTRIES} WHERE strand != ?", (but,))  # noqa: S608
    if last is not None:
        base.execute(
            f"INSERT INTO {ENTRIES} (rowid, strand, number, at, kind, what, author) "  # noqa: S608
            "VALUES (?, ?, 1, '', '', '', '')",
            (last + 1, CLEARED),
        )
