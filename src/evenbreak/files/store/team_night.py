"""The team night in the file of an evening: events are only ever added, as those of a tournament.

Each event has its author, and the number of the form that it came in: a form that comes in a
second time adds nothing.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Sequence
from pathlib import Path

from evenbreak.files.store.evening_file import begin, is_there, opened
from evenbreak.files.store.formats import TEAM_NIGHT
from evenbreak.files.store.log import Rules, add, entries, was_taken
from evenbreak.teams.evening.events import KINDS, Event, What
from evenbreak.teams.evening.fold import TeamEvening, team_evening

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
        return entries(base, path, TEAM_NIGHT, _RULES)


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
        earlier = entries(base, path, TEAM_NIGHT, _RULES)
        before = _RULES.state(path, earlier)
        if was_taken(base, TEAM_NIGHT, form):
            return before, False
        added = [Event(at, what, by) for what in decide(earlier, before)]
        after = _RULES.state(path, [*earlier, *added])
        add(base, TEAM_NIGHT, _RULES, added, count=len(earlier), form=form)
        return after, bool(added)

    return begin(path, write)


def team_night_of(path: str | Path, events: Sequence[Event]) -> TeamEvening | None:
    """Return the state after the events of a file, if it can be shown; None: no night has begun.

    Raises
    ------
    DataError
        if it cannot; it names the entry that does not fit.
    """
    return _RULES.state(path, events)


def _shown(events: Sequence[Event]) -> TeamEvening | None:
    state = team_evening(events)
    if state is not None:
        _ = state.meeting, state.score, state.due
        for line in state.sets:
            if line.named:
                state.needs(line)
    return state


_RULES: Rules[Event, TeamEvening | None] = Rules(KINDS, Event, _shown)
