"""How an evening's entries are read: those that count, with the players' current names.

A rename is applied to all other entries, even earlier ones. Each entry names players as they were
called when it was made, so a rename can be taken back on its own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, TypeAlias

from evenbreak.evenings.log import Log, TakenBack
from evenbreak.tournaments.evening.events import (
    Edited,
    Event,
    Late,
    LaterDraw,
    Opened,
    Renamed,
    Substituted,
    What,
)

Entered: TypeAlias = tuple[int, int]
"""A player, by the number of the entry that brought them in, and their place in it."""

_NAMED = {"name", "names", "order", "players", "winner", "one", "other", "absent"}
"""The entry fields that contain player names."""


_NAMING = Opened | Late | Substituted | Renamed | Edited


class ReadRename(Renamed):
    """A rename that has been applied to the other entries."""


@dataclass(frozen=True)
class History:
    """An evening's entries: `kept` and `undone` (last one last) by number, from 1.

    `former` maps players' earlier names to their current ones.
    """

    kept: Mapping[int, Event]
    undone: Mapping[int, TakenBack[Event]]
    entries: Mapping[str, Entered]
    former: Mapping[str, str]


def read(events: Sequence[Event]) -> History:
    """Return an evening's entries as they are read.

    Raises InputError if something is undone that doesn't exist, or redone that wasn't undone.
    """
    log: Log[Event] = Log(fixed=1)
    renames = any(isinstance(event.what, Renamed) for event in events)
    called: dict[int, Mapping[str, Entered]] = {}  # by what names, when each entry was made
    names: dict[str, Entered] = {}
    for number, event in enumerate(events, 1):
        entry = log.take(number, event)
        if entry is None:
            before, names = names, _names_after(names, number, event.what)
            if renames:
                called[number] = {**before, **names}
        elif isinstance(events[entry - 1].what, _NAMING):
            names = _names(log.kept)
    kept, undone = log.kept, log.undone
    former: dict[str, str] = {}
    if renames:
        now = {who: name for name, who in names.items()}
        kept = {number: _read(event, called[number], now) for number, event in kept.items()}
        undone = {
            number: one._replace(event=_read(one.event, called[number], now))
            for number, one in undone.items()
        }
        former = {
            name: now[who]
            for known in called.values()
            for name, who in known.items()
            if name not in names and who in now
        }
    return History(kept, undone, names, former)


def as_read(events: Sequence[Event]) -> list[Event]:
    """Return all of an evening's entries as they are read, including undone ones."""
    history = read(events)
    undone = {number: one.event for number, one in history.undone.items()}
    told = {**history.kept, **undone}
    return [told.get(number, event) for number, event in enumerate(events, 1)]


def _names(kept: Mapping[int, Event]) -> dict[str, Entered]:
    names: dict[str, Entered] = {}
    for number, event in kept.items():
        names = _names_after(names, number, event.what)
    return names


def _names_after(names: dict[str, Entered], number: int, what: What) -> dict[str, Entered]:
    """Return who is called what after an entry; earlier names are unchanged."""
    match what:
        case Opened(entrants=entrants):
            return {one.name: (number, k) for k, one in enumerate(entrants)}
        case Late(entrant=entrant) | Substituted(entrant=entrant):
            return {**names, entrant.name: (number, 0)}
        case Renamed(name=old, to=now) if not isinstance(what, ReadRename) and old in names:
            return {now if name == old else name: who for name, who in names.items()}
        case Edited(name=old, entrant=entrant) if old != entrant.name and old in names:
            return {entrant.name if name == old else name: who for name, who in names.items()}
    return names


def _read(event: Event, called: Mapping[str, Entered], now: Mapping[Entered, str]) -> Event:
    """Return an entry with the players' current names."""
    what = event.what
    if isinstance(what, Renamed):
        return replace(event, what=ReadRename(what.name, what.to))
    if isinstance(what, LaterDraw) and not what.stage.startswith("R"):
        return event  # of matches
    names = {name: now[who] for name, who in called.items() if now.get(who, name) != name}
    return replace(event, what=_with(what, names)) if names else event


def _with(what: Any, names: Mapping[str, str]) -> Any:
    """Return an entry with other names."""
    changed: dict[str, Any] = {}
    for one in fields(what):
        value = getattr(what, one.name)
        if one.name == "entrants":
            changed[one.name] = tuple(_with(entrant, names) for entrant in value)
        elif one.name == "entrant" and is_dataclass(value):
            changed[one.name] = _with(value, names)
        elif one.name in _NAMED and isinstance(value, str):
            changed[one.name] = names.get(value, value)
        elif one.name in _NAMED and isinstance(value, tuple):
            changed[one.name] = tuple(names.get(name, name) for name in value)
    return replace(what, **changed)
