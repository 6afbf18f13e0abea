"""The tables in which the file of an evening keeps its entries, now and in earlier formats.

Format 3 has one table for all that is entered, in strands: 1, 2, ... are the tournaments of the
night, `team` its team nights. Format 1 (version 0.2.0) and format 2 had a table for a tournament,
with its authors and its forms beside it, and another for team nights.
"""

from __future__ import annotations

import sqlite3

FORMAT = 3
ENTRIES = "entry"
TOURNAMENT, TEAM_NIGHT = "1", "team"
"""The strand of the first tournament of the night, and that of its team nights."""

_COLUMNS = "strand, number, at, kind, what, author, form"
_TABLE = f"""
CREATE TABLE IF NOT EXISTS {ENTRIES} (
    strand TEXT NOT NULL,
    number INTEGER NOT NULL,
    at TEXT NOT NULL,
    kind TEXT NOT NULL,
    what TEXT NOT NULL,
    author TEXT NOT NULL,
    form TEXT,
    PRIMARY KEY (strand, number),
    UNIQUE (strand, form)
)
"""
_EARLIER = ("event", "author", "once", "team_event")


def has_table(base: sqlite3.Connection, table: str) -> bool:
    """Return whether a file has a table."""
    asked = "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?"
    return base.execute(asked, (table,)).fetchone() is not None


def source(base: sqlite3.Connection) -> str:
    """Return what entries are selected from, in whatever format they were written."""
    if has_table(base, ENTRIES):
        return ENTRIES
    parts = []
    if has_table(base, "event"):
        author, form = "''", "NULL"
        if has_table(base, "author"):
            author = "COALESCE((SELECT name FROM author WHERE number = event.number), '')"
        if has_table(base, "once"):
            form = "(SELECT MAX(form) FROM once WHERE number = event.number)"
        parts.append(
            f"SELECT '{TOURNAMENT}' AS strand, number, at, kind, what, {author} AS author, "  # noqa: S608
            f"{form} AS form FROM event"
        )
    if has_table(base, "team_event"):
        parts.append(
            f"SELECT '{TEAM_NIGHT}' AS strand, number, at, kind, what, author, form "  # noqa: S608
            "FROM team_event"
        )
    none = "SELECT '' AS strand, 0 AS number, '' AS at, '' AS kind, '' AS what, '' AS author, "
    return f"({' UNION ALL '.join(parts) or none + 'NULL AS form WHERE 0'})"


def size_of(base: sqlite3.Connection) -> int:
    """Return how many entries a file has."""
    return int(base.execute(f"SELECT COUNT(*) FROM {source(base)}").fetchone()[0])  # noqa: S608


def bring_up_to_date(base: sqlite3.Connection) -> None:
    """Make the table of the entries, and move those of an earlier format into it."""
    earlier = source(base)
    base.execute(_TABLE)
    if earlier != ENTRIES:
        base.execute(f"INSERT INTO {ENTRIES} SELECT {_COLUMNS} FROM {earlier}")  # noqa: S608
    for table in _EARLIER:
        base.execute(f"DROP TABLE IF EXISTS {table}")
    base.execute(f"PRAGMA user_version = {FORMAT}")
