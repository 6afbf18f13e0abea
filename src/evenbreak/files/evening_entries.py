"""What the file of an evening holds, checked as it is read: what is wrong names its entry."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import Any, TypeVar

from evenbreak.errors import DataError, InputError

_FAULTS = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    RecursionError,
    TypeError,
    ValueError,
)
"""What the rules raise where they are given what nobody could have entered."""

State = TypeVar("State")
Entry = TypeVar("Entry")


@contextmanager
def named(path: str | Path, what: str) -> Iterator[None]:
    """Say of an error in the block in which file, and in what of it, something is wrong.

    >>> with named("nights/tonight.db", "entry 3 (late)"):
    ...     raise InputError("line is 'x'; give a whole number from 0 to 255")
    Traceback (most recent call last):
    ...
    evenbreak.errors.DataError: tonight.db, entry 3 (late): line is 'x'; give a whole number from 0
    to 255. Go on with a copy of the file, such as one ending in .backup.db
    """
    try:
        yield
    except DataError:
        raise
    except _FAULTS as error:
        why = str(error) if isinstance(error, InputError) else "does not fit the entries before it"
        raise DataError(
            [
                f"{Path(path).name}, {what}: {why}. Go on with a copy of the file, such as one "
                "ending in .backup.db"
            ]
        ) from error


def happened(at: Any, kind: Any, what: Any, event_of: Callable[[str, Any], Entry]) -> Entry:
    """Return what happened, from the columns of an entry.

    Raises
    ------
    InputError
        if a column is not what it should be.
    """
    for name, column in (("at", at), ("kind", kind), ("what", what)):
        if not isinstance(column, str):
            raise InputError(f"{name} is not text")
    try:
        moment = datetime.fromisoformat(at)
    except ValueError:
        moment = datetime.max
    if moment.tzinfo or not 1970 <= moment.year < 3000:
        raise InputError(f"at is {at[:40]!r}; give a time such as 2025-03-01T19:30:00")
    try:
        data = json.loads(what)
    except (ValueError, RecursionError):
        raise InputError("what is damaged JSON") from None
    return event_of(kind, data)


def folded(
    path: str | Path,
    events: Sequence[Any],
    fold: Callable[[Sequence[Any]], State],
    names: Mapping[type, str],
) -> State:
    """Return the state after the events of a file, or name the first that cannot have happened.

    Parameters
    ----------
    path
        the file.
    events
        in their order; `what` happened in each.
    fold
        returns the state after some of them.
    names
        of the kinds of what happens.
    """
    try:
        return fold(events)
    except _FAULTS:
        for count, event in enumerate(events, 1):
            with named(path, f"entry {count} ({names[type(event.what)]})"):
                fold(events[:count])
        raise
