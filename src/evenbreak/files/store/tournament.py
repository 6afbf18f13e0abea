"""The tournament in an evening's file: events are only ever added.

Two programs can use one file: each checks its move against the state at that moment, while the
other waits. The events can also be a CSV file, from which the same state follows.
"""

from __future__ import annotations

import csv
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

from evenbreak.errors import DataError, InputError
from evenbreak.files.store.changes import clear
from evenbreak.files.store.evening_file import begin, changing, is_there, opened, refused
from evenbreak.files.store.formats import TEAM_NIGHT, TOURNAMENT, bring_up_to_date
from evenbreak.files.store.log import Rules, TakenBeforeError, add, entries, tournaments, was_taken
from evenbreak.files.store.prizes import write_prizes
from evenbreak.files.store.views import apart, are_current, renew
from evenbreak.files.tables.problems import refusal
from evenbreak.files.tables.rows import text_of
from evenbreak.tournaments.clock.event_pace import EarlierNight
from evenbreak.tournaments.evening.beside import carried, coming_with, together
from evenbreak.tournaments.evening.earlier import nights_until
from evenbreak.tournaments.evening.events import KINDS, Changed, Event, Opened, What
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.money.payouts import PrizeMoney
from evenbreak.words import Command, say

Night: TypeAlias = Mapping[int, Evening]
"""A night's events by number; each event knows about the others."""
TAKEN = say("that was already entered; it wasn't entered a second time")


def new_tournament(path: str | Path, events: Sequence[Event], *, in_place_of: int = 0) -> Evening:
    """Write a tournament's first events to a new file, or to a team night's file.

    If it replaces a tournament, `in_place_of` is the old one's number of events. Raises DataError
    if the file already has another tournament, or can't be written, and InputError if the events
    don't start a tournament.
    """
    state = _shown(evening(events))

    def write(base: sqlite3.Connection) -> None:
        if len(entries(base, path, TOURNAMENT, _RULES)) != in_place_of:
            raise refused(path, "{name} already exists. Give the new tournament another name.")
        _clear(base)
        add(base, TOURNAMENT, _RULES, events)
        renew(base, path, {1: state})

    begin(path, write)
    return state


def _clear(base: sqlite3.Connection) -> None:
    """Remove a tournament from a file, with what phones sent and its prizes."""
    for table in ("prize", "prizes"):
        base.execute(f"DROP TABLE IF EXISTS {table}")
    bring_up_to_date(base)
    clear(base, TEAM_NIGHT)


def delete_tournament(path: str | Path) -> None:
    """Remove the tournament from a file, without a copy; raise DataError if that fails."""
    with changing(path) as base:
        _clear(base)
        renew(base, path, {})


def keep_prizes(path: str | Path, money: PrizeMoney, event: int = 1) -> None:
    """Store an event's prize money, replacing any stored before."""
    with changing(path) as base:
        write_prizes(base, money, event)
        _renew(base, path)


def renew_views(path: str | Path) -> None:
    """Bring a file's views up to date if an earlier version has written to it.

    A file that can't be written to now, or can't be shown, stays as it is.
    """
    with suppress(DataError):
        with opened(path) as base:
            current = are_current(base)
        if not current:
            with changing(path) as base:
                _renew(base, path)


def _renew(base: sqlite3.Connection, path: str | Path) -> None:
    with apart(base, path):
        renew(base, path, night_of(path, _entered(base, path)))


def _entered(base: sqlite3.Connection, path: str | Path) -> dict[int, list[Event]]:
    """Return the entries of each of the night's events."""
    return {n: entries(base, path, str(n), _RULES) for n in tournaments(base)}


def begin_beside(
    path: str | Path, begin: Callable[[Evening], Sequence[Event]], *, form: str | None = None
) -> int:
    """Start another event on the tables of a file's tournament; return its number.

    `begin` returns its first entries, given the state of the first event. Raises TakenBeforeError
    if the form (its ID) was accepted before, InputError for a chip tournament, whose tables are
    never free, and DataError if the file has no tournament, or can't be read or written.
    """
    with changing(path) as base:
        strands = _strands(base, path)
        if any(was_taken(base, str(n), form) for n in strands):
            raise TakenBeforeError(TAKEN)
        states = night_of(path, strands)
        number, house = max(states) + 1, states[min(states)]
        events = list(begin(house))
        first = events[0]
        assert isinstance(first.what, Opened)  # noqa: S101
        if "chips" in {first.what.plan.form, *(one.plan.form for one in states.values())}:
            raise InputError(
                "a chip tournament needs all the tables, so no other event can run alongside it"
            )
        plan = first.what.plan.at_tables_of(house.plan)
        events[0] = replace(first, what=replace(first.what, plan=plan))
        night = together({**states, number: _shown(evening(events))})
        add(base, str(number), _RULES, events, form=form)
        renew(base, path, night)
    return number


def read_events(path: str | Path, event: int = 1) -> list[Event]:
    """Return the entries of a tournament, or of another of its night's events (DataError: none)."""
    return read_night(path, event)[event]


def event_numbers(path: str | Path) -> list[int]:
    """Return the numbers of the night's events in a file; [1] if there are none yet."""
    if not is_there(path):
        return [1]
    with opened(path) as base:
        return tournaments(base) or [1]


def read_night(path: str | Path, event: int = 1) -> dict[int, list[Event]]:
    """Return the entries of all a night's events by number; DataError if `event` is missing."""
    with opened(path) as base:
        return _strands(base, path, event)


def read_tournament(path: str | Path, event: int = 1) -> Evening:
    """Return the state of a tournament, or of another of its night's events (DataError: none)."""
    return night_of(path, read_night(path, event))[event]


def night_of(path: str | Path, strands: Mapping[int, Sequence[Event]]) -> dict[int, Evening]:
    """Return the state of each of a night's events; DataError names an entry that doesn't fit."""
    return together({n: _RULES.state(path, events) for n, events in strands.items()})


def earlier_nights(places: Iterable[str | Path]) -> tuple[EarlierNight, ...]:
    """Return the pace of earlier tournaments at the same venue, oldest first.

    In a folder, all tournament files are used. Raises DataError if a file can't be read as a
    tournament.
    """
    return nights_until(_states(places))


def _states(places: Iterable[str | Path]) -> Iterator[Evening]:
    for place in map(Path, places):
        if place.is_dir():
            yield from (state for _, state in tournaments_in(place))
        else:
            yield read_tournament(place)


def tournaments_in(folder: str | Path) -> Iterator[tuple[str, Evening]]:
    """Yield every tournament in a folder, with its file's name; other files are ignored."""
    for path in sorted(Path(folder).glob("*.db")):
        try:
            yield path.stem, read_tournament(path)
        except DataError:  # something else is in the folder too
            continue


def add_events(
    path: str | Path,
    decide: Callable[[Evening], Sequence[Event]],
    *,
    event: int = 1,
    by: str = "",
    form: str | None = None,
    check: Callable[[Evening, Evening], None] | None = None,
    more: Callable[[Night, Night], Sequence[tuple[int, What]]] | None = None,
) -> tuple[Evening, Evening]:
    """Add events to a tournament, and return its state before and after.

    Their consequences in the night's other events are added in the same step, or nothing is. No one
    else can add events while `decide` returns them, given the state; if it raises an error, or
    `check` does, which gets the states before and after, nothing is added. `more` returns automatic
    entries such as calls, each with its event's number, given the night before and after. Raises
    TakenBeforeError if the `form` (its ID) was accepted before, and DataError if the file can't be
    read or written, or isn't a tournament's.
    """
    with changing(path) as base:
        if was_taken(base, str(event), form):
            raise TakenBeforeError(TAKEN)
        strands = _strands(base, path, event)
        before = night_of(path, strands)
        own = [replace(one, by=one.by or by) for one in decide(before[event])]
        _refuse_tables(own, event)
        alone = {n: _RULES.state(path, rest) for n, rest in strands.items()}
        added: dict[int, list[Event]] = {n: [] for n in strands}

        def then(new: Mapping[int, Sequence[Event]]) -> dict[int, Evening]:
            for n, events in new.items():
                added[n] += events
                alone[n] = _shown(evening([*strands[n], *added[n]]))
            return together(alone)

        after = then({event: own})
        after = then(carried(before, after, event)) if len(strands) > 1 else after
        if more and own:
            number = len(strands[event]) + len(own)
            after = then(coming_with(more(before, after), event, number, own[-1].at))
        if check:
            check(before[event], after[event])
        for n, events in added.items():
            key = form if n == event else None
            add(base, str(n), _RULES, events, count=len(strands[n]), form=key)
        renew(base, path, after)
    return before[event], after[event]


def _shown(state: Evening) -> Evening:
    """Return a state; a state that can't be shown is never written."""
    if state.drawn:
        _ = state.on_tables, state.live, state.ratings, state.whole
        for match in state.standing.to_play:
            state.needed(match, state.pair(match))
    return state


def _refuse_tables(added: Sequence[Event], event: int) -> None:
    """Refuse to change the tables in any event but the one that has them."""
    tables = ("tables", "labels", "reserved", "streamed", "slower")
    for one in added if event > 1 else ():
        if isinstance(one.what, Changed) and any(getattr(one.what, k) is not None for k in tables):
            raise InputError("the tables belong to the first event. Change them there.")


def _strands(base: sqlite3.Connection, path: str | Path, event: int = 1) -> dict[int, list[Event]]:
    """Return the entries of each of the night's events; reject a file without a certain event."""
    found = _entered(base, path)
    if event in found:
        return found
    if found:
        raise refused(path, "{name} has no event {event}", event=event)
    raise refused(
        path,
        "{name} holds a team night, not a tournament. Open it with {serve}, or start a "
        "tournament in it with {new}.",
        serve=Command("serve"),
        new=Command("tournament new"),
    )


_RULES: Rules[Event, Evening] = Rules(KINDS, Event, lambda events: _shown(evening(events)))


TITLES = ("number", "at", "kind", "what", "by")
_BEGINNING = ",".join(TITLES[:4])  # of the lists of 0.2.0 too, which have no authors


def event_rows(events: Sequence[Event]) -> list[tuple[int, str, str, str, str]]:
    """Return the rows for the columns in `TITLES`; `what` holds the details as JSON."""
    return _RULES.rows(events)


def is_event_list(path: str | Path) -> bool:
    """Return whether a file starts like a list of events."""
    try:
        with Path(path).open("rb") as file:
            return file.read(64).removeprefix(b"\xef\xbb\xbf").startswith(_BEGINNING.encode())
    except OSError:
        return False


def read_event_list(path: str | Path) -> list[Event]:
    """Return the events in a CSV file; raise DataError if they aren't a tournament's."""
    text = text_of(Path(path).read_bytes(), str(path)).read()
    reader = csv.reader(text.splitlines()[1:])
    events = []
    for line, row in enumerate(reader, 2):
        try:
            _, at, kind, what, by = row if len(row) == len(TITLES) else (*row, "")
            events.append(_RULES.read(at, kind, what, by))
        except (InputError, ValueError) as error:
            why = error.sentence if isinstance(error, InputError) else str(error)
            problem = say("isn't a tournament's event: {why}", why=why)
            raise refusal(str(path), problem, line) from None
    try:
        state = evening(events)
        if state.drawn:
            _ = state.standing
    except InputError as error:
        raise refusal(str(path), error.sentence) from None
    return events
