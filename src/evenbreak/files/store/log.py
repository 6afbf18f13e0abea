"""A night's log in its file: entries in strands, to which entries are only ever added.

A form that comes in a second time adds nothing: its number is stored with the first entry it made.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import lru_cache
from itertools import takewhile
from pathlib import Path
from typing import Any, Generic, TypeAlias, TypeVar

from evenbreak.errors import InputError
from evenbreak.evenings.log import Event, Kinds
from evenbreak.files.store.evening_file import FAULTS, named, opened
from evenbreak.files.store.formats import ENTRIES, bring_up_to_date, source
from evenbreak.tournaments.evening.events import BY_ITSELF
from evenbreak.words import say

Entered = TypeVar("Entered", bound=Event)
State = TypeVar("State")


Row: TypeAlias = tuple[int, str, str, str, str]
"""An entry's number, time, kind, details and author."""


class TakenBeforeError(InputError):
    """Raised for a form that comes in again, whatever it added the first time."""


@dataclass(frozen=True)
class Rules(Generic[Entered, State]):
    """How a strand's entries are read, and the state they add up to.

    `event` makes an entry from a time, its content and an author; `fold` raises an error if the
    state can't be shown.
    """

    kinds: Kinds[Any]
    event: Callable[[str, Any, str], Entered]
    fold: Callable[[Sequence[Entered]], State]

    def state(self, path: str | Path, events: Sequence[Entered]) -> State:
        """Return the state after a file's entries; DataError names the first that doesn't fit."""
        try:
            return self.fold(events)
        except FAULTS:
            for count, event in enumerate(events, 1):
                with named(path, entry_words(count, self.kinds.name(event.what))):
                    self.fold(events[:count])
            raise

    def rows(self, events: Sequence[Entered], first: int = 1) -> list[Row]:
        """Return entries as stored; raise InputError if one couldn't be read again."""
        rows = [
            (k, one.at, self.kinds.name(one.what), self.kinds.text(one.what), one.by)
            for k, one in enumerate(events, first)
        ]
        for _, *row in rows:
            self.read(*row)
        return rows

    def read(self, at: Any, kind: Any, what: Any, author: Any) -> Entered:
        """Return an entry from its columns; raise InputError if a column is invalid."""
        return self.event(at, _what(self.kinds, at, kind, what, author), author)


def entry_words(number: object, kind: object) -> str:
    """Return what messages call an entry in the file.

    >>> entry_words(3, "late")
    'entry 3 (late)'
    """
    return say("entry {number} ({kind})", number=number, kind=str(kind))


@lru_cache(maxsize=8192)
def _what(kinds: Kinds[Any], at: Any, kind: Any, what: Any, author: Any) -> Any:
    """Return an event from its row; a page reads all entries again after each new one."""
    for name, column in (("at", at), ("kind", kind), ("what", what), ("author", author)):
        if not isinstance(column, str):
            raise InputError("{column} isn't text", column=name)
    try:
        moment = datetime.fromisoformat(at)
    except ValueError:
        moment = datetime.max
    if moment.tzinfo or not 1970 <= moment.year < 3000:
        raise InputError(
            "at must be a time such as 2025-03-01T19:30:00; you gave {time!r}", time=at[:40]
        )
    return kinds.read(kind, what)


def entries(
    base: sqlite3.Connection, path: str | Path, strand: str, rules: Rules[Entered, State]
) -> list[Entered]:
    """Return a strand's entries in order; raise DataError if one is damaged."""
    asked = f"SELECT number, at, kind, what, author FROM {source(base)} "  # noqa: S608
    found = []
    for number, *row in base.execute(f"{asked} WHERE strand = ? ORDER BY number", (strand,)):
        with named(path, entry_words(number, row[1])):
            found.append(rules.read(*row))
    return found


def was_taken(base: sqlite3.Connection, strand: str, form: str | None) -> bool:
    """Return whether a form was accepted for a strand, even if it added nothing."""
    asked = f"SELECT 1 FROM {source(base)} WHERE strand IN (?, ?) AND form = ?"  # noqa: S608
    found = base.execute(asked, (strand, _taken(strand), form)) if form else None
    return found is not None and found.fetchone() is not None


def forms_with(path: str | Path, beginning: str) -> set[str]:
    """Return the forms with this prefix, in all strands."""
    with opened(path) as base:
        asked = f"SELECT form FROM {source(base)} WHERE substr(form, 1, ?) = ?"  # noqa: S608
        return {form for (form,) in base.execute(asked, (len(beginning), beginning))}


def entries_of(path: str | Path, form: str) -> list[int]:
    """Return the numbers of the entries that a form made, including automatic ones."""
    with opened(path) as base:
        rows = f"SELECT strand, number, at, author, form FROM {source(base)}"  # noqa: S608
        first = base.execute(f"{rows} WHERE form = ?", (form,)).fetchone()
        if first is None or not first[0].isdigit():
            return []
        strand, number, at, author, _ = first
        later = base.execute(
            f"{rows} WHERE strand = ? AND number > ? ORDER BY number", (strand, number)
        )
        came = takewhile(lambda row: row[2] == at and row[3] in (author, BY_ITSELF)
                         and row[4] is None, later)  # fmt: skip
        return [number, *(row[1] for row in came)]


def _taken(strand: str) -> str:
    """Return the strand for forms that added nothing to another strand."""
    return f"{strand} taken"


def add(
    base: sqlite3.Connection,
    strand: str,
    rules: Rules[Entered, State],
    events: Sequence[Entered],
    *,
    count: int = 0,
    form: str | None = None,
) -> None:
    """Add a form's entries to a strand that already has some."""
    if source(base) != ENTRIES:
        bring_up_to_date(base)
    base.executemany(
        f"INSERT INTO {ENTRIES} VALUES (?, ?, ?, ?, ?, ?, ?)",  # noqa: S608
        [
            (strand, *row, form if row[0] == count + 1 else None)
            for row in rules.rows(events, count + 1)
        ],
    )
    if form and not events:
        base.execute(
            f"INSERT INTO {ENTRIES} SELECT ?, COUNT(*) + 1, '', '', '', '', ? "  # noqa: S608
            f"FROM {ENTRIES} WHERE strand = ?",
            (_taken(strand), form, _taken(strand)),
        )


def tournaments(base: sqlite3.Connection) -> list[int]:
    """Return the numbers of a file's tournaments."""
    asked = f"SELECT DISTINCT strand FROM {source(base)}"  # noqa: S608
    return sorted(int(strand) for (strand,) in base.execute(asked) if str(strand).isdigit())
