"""The file of an evening: one SQLite database with a tournament, a team night or both.

What was acknowledged is on the disk: each addition is one transaction, written through at once.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from evenbreak.errors import DataError

TOURNAMENT, TEAM_NIGHT = "event", "team_event"
"""The tables of what happened in a tournament, and on a team night."""

_MARK = 0x45564252  # application_id: an evening of this program
_FORMAT = 1  # user_version: how its events are written
_WAIT = 30.0  # seconds for another program to finish its move


def is_database(path: str | Path) -> bool:
    """Return whether a file is a database, whatever is in it."""
    try:
        with Path(path).open("rb") as file:
            return file.read(16) == b"SQLite format 3\0"
    except OSError:
        return False


@contextmanager
def opened(path: str | Path) -> Iterator[sqlite3.Connection]:
    """Open the file of an evening.

    Raises
    ------
    DataError
        if it is not one, or cannot be read or written.
    """
    if not Path(path).exists():
        raise DataError(
            [f"{path} does not exist; begin a tournament with evenbreak tournament new"]
        )
    if not is_database(path):
        raise DataError([f"{path} is not the file of a tournament"])
    with _connected(Path(path)) as base:
        mark, version = (
            base.execute(f"PRAGMA {name}").fetchone()[0]
            for name in ("application_id", "user_version")
        )
        if mark != _MARK:
            raise DataError([f"{path} is not the file of a tournament"])
        if version != _FORMAT:
            raise DataError(
                [f"{path} was written by a newer version of evenbreak; update this one"]
            )
        yield base


@contextmanager
def begun(path: str | Path) -> Iterator[sqlite3.Connection]:
    """Open the file of an evening, or make it, with nobody else in it until the block ends.

    What the block writes is kept if it ends without an error.
    """
    place, there = Path(path), is_there(path)
    with opened(place) if there else _connected(place) as base:
        with at_once(base, "EXCLUSIVE"):
            yield base
            if not there:
                base.execute(f"PRAGMA application_id = {_MARK}")
                base.execute(f"PRAGMA user_version = {_FORMAT}")
        if not there:
            base.execute("PRAGMA journal_mode = WAL")


@contextmanager
def at_once(base: sqlite3.Connection, how: str = "IMMEDIATE") -> Iterator[None]:
    """Keep all that the block writes, or nothing if it raises an error; others wait meanwhile."""
    base.execute(f"BEGIN {how}")
    try:
        yield
    except BaseException:
        base.execute("ROLLBACK")
        raise
    base.execute("COMMIT")


def has_table(base: sqlite3.Connection, table: str) -> bool:
    """Return whether a file has a table."""
    asked = "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?"
    return base.execute(asked, (table,)).fetchone() is not None


def is_there(path: str | Path) -> bool:
    """Return whether there is a file with something in it."""
    place = Path(path)
    return place.exists() and place.stat().st_size > 0


def holds(path: str | Path, table: str) -> bool:
    """Return whether there is a file of an evening with a table."""
    if not is_there(path):
        return False
    with opened(path) as base:
        return has_table(base, table)


@contextmanager
def _connected(path: Path) -> Iterator[sqlite3.Connection]:
    try:
        with closing(sqlite3.connect(path, timeout=_WAIT, isolation_level=None)) as base:
            base.execute("PRAGMA synchronous = FULL")
            yield base
    except sqlite3.Error as error:
        raise DataError([f"{path}: {error}"]) from error
