"""The team night in an evening's file: events are only ever added, as for a tournament.

Each event has its author, and the number of the form it came in: a form that comes in a second time
adds nothing.
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
"""From all events so far, and the state after them, to new events."""


def read_team_events(path: str | Path) -> list[Event]:
    """Return all the events of a file's team nights; raise DataError if it can't be read."""
    if not is_there(path):
        return []
    with opened(path) as base:
        return entries(base, path, TEAM_NIGHT, _RULES)


def add_team_events(
    path: str | Path, decide: Decide, *, at: str, by: str, form: str | None = None
) -> tuple[TeamEvening | None, bool]:
    """Add events to a team night; return the state after them, and whether there are any.

    The file is created if needed. No one else can add anything while `decide` returns the events;
    if it raises an error, nothing is added. A `form` (its ID) that was accepted before adds
    nothing. Raises DataError if it isn't an evening's file, or can't be read or written.
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
    """Return the state after a file's events; None before a night starts.

    DataError names the entry that doesn't fit.
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
