"""An evening's file: one SQLite database with a tournament, a team night or both.

Anything acknowledged is on disk: each addition is one transaction, written through at once.

The file is only ever opened through SQLite. Opening and closing it in any other way would drop this
process's locks on it, and another program could then remove the log that is being written
(sqlite.org, "How To Corrupt An SQLite Database File", 2.2).
"""

from __future__ import annotations

import logging
import os
import secrets
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from itertools import count
from pathlib import Path
from typing import Any, TypeVar

from evenbreak.errors import DataError, InputError
from evenbreak.files.store.folder import sync
from evenbreak.files.store.formats import FORMAT, bring_up_to_date, source
from evenbreak.words import Command, say

_LOG = logging.getLogger(__name__)
_MARK = 0x45564252  # application_id: an evening of this program
_WAIT = 30.0  # seconds for another program to finish its move
WHY = {  # by the code of SQLite's error
    sqlite3.SQLITE_NOTADB: say("{name} isn't a tournament file"),
    sqlite3.SQLITE_FULL: say(
        "the disk that holds {name} is full, so nothing was changed. Free some space and try again."
    ),
    sqlite3.SQLITE_IOERR: say(
        "the disk that holds {name} reports an error ({error}), so nothing was changed. Check "
        "whether it has free space."
    ),
    sqlite3.SQLITE_READONLY: say(
        "{name} is read-only, so nothing was changed. Allow writing to it and to its folder."
    ),
    sqlite3.SQLITE_BUSY: say("{name} is in use by another program. Try again."),
    sqlite3.SQLITE_CANTOPEN: say(
        "{name} can't be opened. Check the permissions of the file and its folder."
    ),
}
DAMAGED = say(
    "{name} is damaged ({error}); continue with a copy of it, such as one ending in .backup.db"
)

Result = TypeVar("Result")


@contextmanager
def opened(path: str | Path) -> Iterator[sqlite3.Connection]:
    """Open an evening's file for reading, even if read-only; raise DataError if that fails."""
    with _checked(Path(path), reading=True) as base:
        yield base


@contextmanager
def changing(path: str | Path) -> Iterator[sqlite3.Connection]:
    """Open an evening's file to change it; anyone else who wants to must wait for the block to end.

    All of the block's changes are kept, or none if it raises an error. A file from an earlier
    version is copied before its first change. Raises DataError if the file can't be read or
    written.
    """
    with _checked(Path(path), reading=False) as base:
        if _version(base) < FORMAT:
            _update(base, Path(path))
        with _at_once(base):
            yield base


def begin(path: str | Path, write: Callable[[sqlite3.Connection], Result]) -> Result:
    """Write to an evening's file, creating it if needed: everything, or nothing on an error.

    `write` is called again if someone else creates the file meanwhile. Raises DataError if it isn't
    an evening's file, or can't be read or written.
    """
    place = Path(path)
    while not os.path.lexists(place):
        with _part_of(place) as part:
            with _connected(place, part) as base:
                result = _write_first(base, write)
            if _placed(part, place):
                return result
    with _connected(place) as base:
        if _is_empty(base):
            return _write_first(base, write)
    with changing(place) as base:
        return write(base)


def copied(path: str | Path, label: str) -> Path:
    """Write a copy of the file next to it, and return the copy's name, which contains the label.

    A file with that name is always a complete copy, even if the program ends while writing.
    """
    place = Path(path)
    with _part_of(place) as part:
        with _connected(place, reading=True) as base, closing(sqlite3.connect(part)) as copy:
            base.backup(copy)
        for k in count(1):
            again = f"-{k}" if k > 1 else ""
            name = place.with_name(f"{place.stem}-{label}{again}.backup.db")
            if _placed(part, name):
                break
    return name


def is_there(path: str | Path) -> bool:
    """Return whether the file exists and isn't empty."""
    place = Path(path)
    return place.exists() and place.stat().st_size > 0


def holds(path: str | Path, strand: str) -> bool:
    """Return whether this is an evening's file with entries in a strand."""
    if not is_there(path):
        return False
    with opened(path) as base:
        asked = f"SELECT 1 FROM {source(base)} WHERE strand = ? LIMIT 1"  # noqa: S608
        return base.execute(asked, (strand,)).fetchone() is not None


def is_database(path: str | Path) -> bool:
    """Return whether a file is a nonempty database, according to SQLite."""
    try:
        with _connected(Path(path), reading=True) as base:
            return not _is_empty(base)
    except DataError:
        return False


@contextmanager
def _checked(place: Path, *, reading: bool) -> Iterator[sqlite3.Connection]:
    """Connect to an evening's file, which must exist."""
    if not place.exists():
        raise refused(
            place,
            "{name} doesn't exist. Start a tournament: {command}",
            command=Command("tournament new", "ENTRANTS.csv", "--race", "7"),
        )
    with _connected(place, reading=reading) as base:
        _check(base, place)
        yield base


@contextmanager
def _connected(
    place: Path, part: Path | None = None, *, reading: bool = False
) -> Iterator[sqlite3.Connection]:
    """Connect to a file, or to the temporary file that will replace it; errors name the file."""
    if place.is_dir():
        raise refused(place, "{name} is a folder. Name a tournament's file.")
    try:
        with closing(_connection(part or place, "rwc" if part else "rw", reading)) as base:
            yield base
    except (sqlite3.Error, UnicodeDecodeError) as error:  # SQLite's own words may be damaged
        why = WHY.get(getattr(error, "sqlite_errorcode", 0) & 0xFF, DAMAGED)
        raise refused(place, why.template, error=str(error)) from error


def _connection(place: Path, mode: str, reading: bool) -> sqlite3.Connection:
    """Connect to a file and check it.

    If its log can't be created next to it, because the disk is full or the folder is read-only, the
    file can be read without a log: no one can be writing to it then, unless a log already exists.
    """
    where = place.absolute().as_uri()
    try:
        return _looked_at(f"{where}?mode={mode}")
    except sqlite3.OperationalError as error:
        log = place.with_name(f"{place.name}-wal")
        busy = error.sqlite_errorcode & 0xFF == sqlite3.SQLITE_BUSY
        if not reading or busy or (log.exists() and log.stat().st_size):
            raise
        return _looked_at(f"{where}?mode=ro&immutable=1")


def _looked_at(address: str) -> sqlite3.Connection:
    base = sqlite3.connect(address, uri=True, timeout=_WAIT, isolation_level=None)
    try:
        base.execute("PRAGMA synchronous = FULL")
        base.execute("PRAGMA schema_version")
    except sqlite3.Error:
        base.close()
        raise
    return base


@contextmanager
def _at_once(base: sqlite3.Connection) -> Iterator[None]:
    """Commit everything the block writes, or nothing if it raises; others wait meanwhile."""
    base.execute("BEGIN IMMEDIATE")
    try:
        yield
        base.execute("COMMIT")
    except BaseException:
        if base.in_transaction:
            base.execute("ROLLBACK")
        raise


def _check(base: sqlite3.Connection, place: Path) -> None:
    """Reject a database that isn't an evening's file, or has an unknown format."""
    mark, version = _number(base, "application_id"), _version(base)
    if mark != _MARK:
        raise refused(place, "{name} isn't a tournament file")
    if version > FORMAT:
        raise refused(
            place,
            "{name} was written by a newer version of evenbreak, in format {version}, but this "
            "version only reads formats up to {newest}. Update evenbreak.",
            version=version,
            newest=FORMAT,
        )
    if version < 1:
        why = say("no version of evenbreak has written a format {version}", version=version)
        raise damaged(place, why)


def _update(base: sqlite3.Connection, place: Path) -> None:
    """Copy a file in an earlier format, and convert it to the current one."""
    with _at_once(base):
        version = _version(base)  # another program may have done it meanwhile
        if version == FORMAT:
            return
        copy = copied(place, f"format-{version}")
        bring_up_to_date(base)
    _LOG.warning(
        "%s was written by an earlier version of evenbreak; a copy for that version is %s",
        place.name,
        copy.name,
    )


def _write_first(base: sqlite3.Connection, write: Callable[[sqlite3.Connection], Result]) -> Result:
    """Write to an empty database, making it an evening's file."""
    base.execute("PRAGMA journal_mode = WAL")
    with _at_once(base):
        if _is_empty(base):
            base.execute(f"PRAGMA application_id = {_MARK}")
            base.execute(f"PRAGMA user_version = {FORMAT}")
        return write(base)


def _is_empty(base: sqlite3.Connection) -> bool:
    """Return whether nothing has been written to a database yet."""
    tables = base.execute("SELECT COUNT(*) FROM sqlite_master").fetchone()[0]
    return not (tables or _number(base, "application_id") or _version(base))


def _version(base: sqlite3.Connection) -> int:
    return _number(base, "user_version")


def _number(base: sqlite3.Connection, pragma: str) -> int:
    return int(base.execute(f"PRAGMA {pragma}").fetchone()[0])


@contextmanager
def _part_of(place: Path) -> Iterator[Path]:
    """Yield a temporary name next to a file, for content that is moved into place when complete."""
    part = place.with_name(f".{place.stem}-{secrets.token_hex(4)}.part")
    try:
        yield part
    finally:
        for ending in ("", "-journal", "-wal", "-shm"):
            part.with_name(part.name + ending).unlink(missing_ok=True)


def _placed(part: Path, place: Path) -> bool:
    """Move a complete file into place in one step; return False if the name is taken."""
    try:
        os.link(part, place)
    except FileExistsError:
        return False
    except OSError:  # as on a memory stick
        if os.path.lexists(place):
            return False
        try:
            part.rename(place)
        except OSError as error:
            why = "{name} can't be written ({error})"
            raise refused(place, why, error=str(error.strerror)) from error
    sync(place.parent)
    return True


FAULTS = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    RecursionError,
    TypeError,
    ValueError,
)
"""The exceptions raised by the rules for input that no one could have entered."""


def refused(path: str | Path, template: str, /, **values: Any) -> DataError:
    """Return the error that rejects an evening's file, called {name} in the template."""
    return DataError([say(template, name=Path(path).name, **values)])


def damaged(path: str | Path, why: str) -> DataError:
    """Return the error for a file that can't have been written this way."""
    return refused(path, DAMAGED.template, error=why)


@contextmanager
def named(path: str | Path, what: str) -> Iterator[None]:
    """Add to errors in the block which file, and which part of it, is wrong.

    >>> with named("nights/tonight.db", "entry 3 (late)"):
    ...     raise InputError("line is 'x'; give a whole number from 0 to 255")
    Traceback (most recent call last):
    ...
    evenbreak.errors.DataError: tonight.db, entry 3 (late): line is 'x'; give a whole number from 0
    to 255. Continue with a copy of the file, such as one ending in .backup.db
    """
    try:
        yield
    except DataError:
        raise
    except FAULTS as error:
        raise refused(
            path,
            "{name}, {what}: {why}. Continue with a copy of the file, such as one ending in "
            ".backup.db",
            what=what,
            why=error.sentence
            if isinstance(error, InputError)
            else say("doesn't fit the entries before it"),
        ) from error
