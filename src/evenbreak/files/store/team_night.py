"""The team night in the file of an evening: events are only ever added, as those of a tournament.

Each event has its author, and the number of the form that it came in: a form that comes in a
second time adds nothing.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Callable, Sequence
from pathlib import Path

from evenbreak.errors import InputError
from evenbreak.files.store.evening_file import (
    TEAM_NIGHT,
    begin,
    entry,
    folded,
    happened,
    has_table,
    is_there,
    named,
    opened,
)
from evenbreak.teams.evening.events import NAMES, Event, What, as_dict, event_of
from evenbreak.teams.evening.fold import TeamEvening, team_evening

_TABLE = f"""
CREATE TABLE IF NOT EXISTS {TEAM_NIGHT} (
    number INTEGER PRIMARY KEY,
    at TEXT NOT NULL,
    kind TEXT NOT NULL,
    what TEXT NOT NULL,
    author TEXT NOT NULL,
    form TEXT UNIQUE
)
"""

Decide = Callable[[list[Event], TeamEvening | None], Sequence[What]]
"""From all events so far and the state after them to what happens now."""


def read_team_events(path: str | Path) -> list[Event]:
    """Return the events of all team nights in a file; none if it has no team night.

    Raises
    ------
    DataError
        if the file is not that of an evening, or cannot be read.
    """
    if not is_there(path):
        return []
    with opened(path) as base:
        return _events(base, path)


def add_team_events(
    path: str | Path, decide: Decide, *, at: str, by: str, form: str | None = None
) -> tuple[TeamEvening | None, bool]:
    """Add events to a team night; return the state after them, and whether there are any.

    Parameters
    ----------
    path
        the file; it is made if it does not exist.
    decide
        returns what happens; nobody else can add anything in the meantime. If it raises an error,
        nothing is added.
    at, by
        when it is entered, and by whom.
    form
        the number of the form that it comes from. If that has added something already, nothing is
        asked and nothing is added.

    Raises
    ------
    DataError
        if the file is not that of an evening, or cannot be read or written.

    >>> import tempfile, pathlib
    >>> from evenbreak.teams.evening.events import Begun
    >>> from evenbreak.teams.evening.events import NightPlan, TeamSheet
    >>> us = TeamSheet("Racks", ("Ann",), (600.0,), (0.0,), (6.0,))
    >>> them = TeamSheet("Cues", ("Cy",), (560.0,), (0.0,), (6.0,))
    >>> how = {"at": "2025-03-01T19:30:00", "by": "director's page", "form": "f1"}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "tonight.db"
    ...     for _ in range(2):
    ...         plan = NightPlan((us, them), 1, race=5)
    ...         state, added = add_team_events(file, lambda events, state: [Begun(plan)], **how)
    ...     state.teams, added, len(read_team_events(file))
    (('Racks', 'Cues'), False, 1)
    """

    def write(base: sqlite3.Connection) -> tuple[TeamEvening | None, bool]:
        base.execute(_TABLE)
        earlier = _events(base, path)
        before = team_night_of(path, earlier)
        again = f"SELECT 1 FROM {TEAM_NIGHT} WHERE form = ?"  # noqa: S608 (the name of a table)
        if form and base.execute(again, (form,)).fetchone():
            return before, False
        added = [Event(at, what, by) for what in decide(earlier, before)]
        after = team_night_of(path, [*earlier, *added])
        base.executemany(
            f"INSERT INTO {TEAM_NIGHT} VALUES (?, ?, ?, ?, ?, ?)",  # noqa: S608
            [
                (
                    number,
                    event.at,
                    NAMES[type(event.what)],
                    json.dumps(as_dict(event.what)),
                    event.by,
                    form if form and number == len(earlier) + 1 else None,
                )
                for number, event in enumerate(added, len(earlier) + 1)
            ],
        )
        return after, bool(added)

    return begin(path, write)


def _events(base: sqlite3.Connection, path: str | Path) -> list[Event]:
    if not has_table(base, TEAM_NIGHT):
        return []
    asked = f"SELECT number, at, kind, what, author FROM {TEAM_NIGHT} ORDER BY number"  # noqa: S608
    events = []
    for number, at, kind, what, by in base.execute(asked).fetchall():
        with named(path, entry(number, kind)):
            if not isinstance(by, str):
                raise InputError("{column} is not text", column="author")
            events.append(Event(at, happened(at, kind, what, event_of), by))
    return events


def team_night_of(path: str | Path, events: Sequence[Event]) -> TeamEvening | None:
    """Return the state after the events of a file, if it can be shown; None: no night has begun.

    Raises
    ------
    DataError
        if it cannot; it names the entry that does not fit.
    """
    return folded(path, events, _shown, NAMES)


def _shown(events: Sequence[Event]) -> TeamEvening | None:
    state = team_evening(events)
    if state is not None:
        _ = state.meeting, state.score, state.due
        for line in state.sets:
            if line.named:
                state.needs(line)
    return state
