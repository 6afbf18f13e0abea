"""The tables where an evening's file keeps its entries, now and in earlier formats.

Format 3 has one table for all entries, in strands: 1, 2, ... are the night's tournaments, `team` is
its team nights, and `phones` is what phones did. Format 1 (version 0.2.0) and format 2 had a table
for a tournament, with separate tables for authors and forms, another for team nights, and one or
two for phones.
"""

from __future__ import annotations

import sqlite3

FORMAT = 3
ENTRIES = "entry"
TOURNAMENT, TEAM_NIGHT, PHONES = "1", "team", "phones"
"""The strands for the night's first tournament, its team nights, and phones."""

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
_EARLIER = ("event", "author", "once", "team_event", "proposal", "phone")
_PROPOSED = (  # by version 0.2.0, which kept no address
    f"SELECT '{PHONES}' AS strand, rowid AS number, at, 'proposed' AS kind, "  # noqa: S608
    "json_object('player', player, 'match', game, 'score', json(score)) AS what, "
    "'phone ' || phone || ' ' AS author, NULL AS form FROM proposal"
)
_PHONE = (
    f"SELECT '{PHONES}' AS strand, number + {{after}} AS number, at, kind, "  # noqa: S608
    "json_object('player', player, 'match', game, 'score', json(score)) AS what, "
    "CASE phone WHEN '' THEN '' ELSE 'phone ' || phone || ' ' || address END AS author, "
    "NULL AS form FROM phone"
)


def has_table(base: sqlite3.Connection, table: str) -> bool:
    """Return whether a file has a table."""
    asked = "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?"
    return base.execute(asked, (table,)).fetchone() is not None


def source(base: sqlite3.Connection) -> str:
    """Return the table or subquery that entries are selected from, in any format."""
    parts = _earlier(base)
    if has_table(base, ENTRIES):
        if not parts:
            return ENTRIES
        parts.append(f"SELECT {_COLUMNS} FROM {ENTRIES}")  # noqa: S608
    none = "SELECT '' AS strand, 0 AS number, '' AS at, '' AS kind, '' AS what, '' AS author, "
    return f"({' UNION ALL '.join(parts) or none + 'NULL AS form WHERE 0'})"


def _earlier(base: sqlite3.Connection) -> list[str]:
    """Return the query that selects the entries from an earlier format's tables."""
    names = base.execute("SELECT name FROM sqlite_master WHERE type = 'table'")
    there = {name for (name,) in names} & {*_EARLIER}
    parts = []
    if "event" in there:
        author, form = "''", "NULL"
        if "author" in there:
            author = "COALESCE((SELECT name FROM author WHERE number = event.number), '')"
        if "once" in there:
            form = "(SELECT MAX(form) FROM once WHERE number = event.number)"
        parts.append(
            f"SELECT '{TOURNAMENT}' AS strand, number, at, kind, what, {author} AS author, "  # noqa: S608
            f"{form} AS form FROM event"
        )
    if "team_event" in there:
        parts.append(
            f"SELECT '{TEAM_NIGHT}' AS strand, number, at, kind, what, author, form "  # noqa: S608
            "FROM team_event"
        )
    if "proposal" in there:
        parts.append(_PROPOSED)
    if "phone" in there:
        after = "COALESCE((SELECT MAX(rowid) FROM proposal), 0)" if "proposal" in there else "0"
        parts.append(_PHONE.format(after=after))
    return parts


def bring_up_to_date(base: sqlite3.Connection) -> None:
    """Create the table of entries, and move an earlier format's entries into it."""
    base.execute(_TABLE)
    for earlier in _earlier(base):
        base.execute(f"INSERT INTO {ENTRIES} SELECT {_COLUMNS} FROM ({earlier})")  # noqa: S608
    for table in _EARLIER:
        base.execute(f"DROP TABLE IF EXISTS {table}")
    base.execute(f"PRAGMA user_version = {FORMAT}")
