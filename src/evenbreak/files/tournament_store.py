"""The file of an evening: one SQLite database, to which events are only ever added.

What was acknowledged is on the disk: each addition is one transaction, written through at once.
Two programs can use one file: each checks its move against the state at that moment, while the
other waits.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path

from evenbreak.errors import DataError, InputError
from evenbreak.tournaments.evening.events import NAMES, Event, as_dict, event_of
from evenbreak.tournaments.evening.fold import Evening, evening

_MARK = 0x45564252  # application_id: a tournament of this program
_FORMAT = 1  # user_version: how its events are written
_WAIT = 30.0  # seconds for another program to finish its move
_TABLE = """
CREATE TABLE event (
    number INTEGER PRIMARY KEY,
    at TEXT NOT NULL,
    kind TEXT NOT NULL,
    what TEXT NOT NULL
)
"""


def new_tournament(path: str | Path, events: Sequence[Event]) -> Evening:
    """Write the first events of a tournament to a new file.

    Raises
    ------
    DataError
        if the file is there already, or cannot be written.
    InputError
        if the events do not begin a tournament.

    >>> import tempfile, pathlib
    >>> from evenbreak.tournaments.evening.events import Dropped, Entrant, Opened, Plan
    >>> first = Opened(Plan("single", 5), (Entrant("Ann", 80.0), Entrant("Bo", 70.0)))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "tonight.db"
    ...     _ = new_tournament(file, [Event("2025-03-01T19:30:00", first)])
    ...     _ = add_events(file, lambda state: [Event("2025-03-01T19:31:00", Dropped("Bo"))])
    ...     list(read_tournament(file).entrants)
    ['Ann']
    """
    state = evening(events)
    target = Path(path)
    if target.exists() and target.stat().st_size:
        raise DataError([f"{path} is there already; give the new tournament another name"])
    with _connected(target) as base:
        base.execute("BEGIN EXCLUSIVE")
        base.execute(_TABLE)
        _write(base, 0, events)
        base.execute(f"PRAGMA application_id = {_MARK}")
        base.execute(f"PRAGMA user_version = {_FORMAT}")
        base.execute("COMMIT")
        base.execute("PRAGMA journal_mode = WAL")
    return state


def read_events(path: str | Path) -> list[Event]:
    """Return the events of a tournament.

    Raises
    ------
    DataError
        if the file is not that of a tournament, or cannot be read.
    """
    with opened(path) as base:
        return _events(base, path)


def read_tournament(path: str | Path) -> Evening:
    """Return the state of a tournament.

    Raises
    ------
    DataError
        if the file is not that of a tournament, or cannot be read.
    """
    return _state(read_events(path), path)


def add_events(
    path: str | Path, decide: Callable[[Evening], Sequence[Event]], *, by: str = ""
) -> tuple[Evening, Evening]:
    """Add events to a tournament, and return its state before and after.

    Parameters
    ----------
    path
        the file.
    decide
        returns the events, given the state; nobody else can add any in the meantime. If it raises
        an error, nothing is added.
    by
        who enters them; kept beside them.

    Raises
    ------
    DataError
        if the file is not that of a tournament, or cannot be read or written.
    """
    with opened(path) as base:
        base.execute("BEGIN IMMEDIATE")
        try:
            earlier = _events(base, path)
            before = _state(earlier, path)
            added = list(decide(before))
            after = evening([*earlier, *added])
            if after.drawn:
                _ = after.standing  # a state that cannot be shown is never written
            _write(base, len(earlier), added)
            if by:
                _sign(base, len(earlier), len(added), by)
        except BaseException:
            base.execute("ROLLBACK")
            raise
        base.execute("COMMIT")
    return before, after


def is_tournament(path: str | Path) -> bool:
    """Return whether a file is a database, whatever is in it."""
    try:
        with Path(path).open("rb") as file:
            return file.read(16) == b"SQLite format 3\0"
    except OSError:
        return False


@contextmanager
def opened(path: str | Path) -> Iterator[sqlite3.Connection]:
    """Open the file of a tournament."""
    if not Path(path).exists():
        raise DataError(
            [f"{path} does not exist; begin a tournament with evenbreak tournament new"]
        )
    if not is_tournament(path):
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
def _connected(path: Path) -> Iterator[sqlite3.Connection]:
    try:
        with closing(sqlite3.connect(path, timeout=_WAIT, isolation_level=None)) as base:
            base.execute("PRAGMA synchronous = FULL")
            yield base
    except sqlite3.Error as error:
        raise DataError([f"{path}: {error}"]) from error


def _sign(base: sqlite3.Connection, count: int, added: int, by: str) -> None:
    """Keep who entered the last events."""
    base.execute("CREATE TABLE IF NOT EXISTS author (number INTEGER PRIMARY KEY, name TEXT)")
    numbers = range(count + 1, count + added + 1)
    base.executemany("INSERT INTO author VALUES (?, ?)", [(number, by) for number in numbers])


def _events(base: sqlite3.Connection, path: str | Path) -> list[Event]:
    rows = base.execute("SELECT at, kind, what FROM event ORDER BY number").fetchall()
    try:
        return [Event(at, event_of(kind, json.loads(what))) for at, kind, what in rows]
    except (InputError, json.JSONDecodeError) as error:
        raise DataError([f"{path}: {error}"]) from error


def _state(events: Sequence[Event], path: str | Path) -> Evening:
    try:
        return evening(events)
    except InputError as error:
        raise DataError([f"{path}: {error}"]) from error


def _write(base: sqlite3.Connection, count: int, events: Sequence[Event]) -> None:
    base.executemany(
        "INSERT INTO event VALUES (?, ?, ?, ?)",
        [
            (number, event.at, NAMES[type(event.what)], json.dumps(as_dict(event.what)))
            for number, event in enumerate(events, count + 1)
        ],
    )
