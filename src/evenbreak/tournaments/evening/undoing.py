"""What can be taken back: the director's own entries, the last one first."""

from __future__ import annotations

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import Event, Result, Undone
from evenbreak.tournaments.evening.fold import Evening


def undoable(state: Evening) -> dict[int, Event]:
    """Return what can be taken back, by number: the director's last entry, and one of players.

    Live scores of players are their own. A result that both players entered can be taken back as
    long as the director has entered nothing since.
    """
    found: dict[int, Event] = {}
    for number, event in zip(state.numbers[:0:-1], state.events[:0:-1], strict=True):
        if not event.by_phones:
            return found | {number: event}
        if isinstance(event.what, Result) and not found:
            found[number] = event
    return found


def undo(state: Evening, entry: int | None = None) -> Undone:
    """Take back an entry; None: the last that the director made."""
    can = undoable(state)
    own = [number for number, event in can.items() if not event.by_phones]
    if entry is None and not own:
        raise InputError("there is nothing to undo")
    if entry is not None and entry not in can:
        raise InputError("entry {entry} is not the last one, so it can't be undone", entry=entry)
    return Undone(own[0] if entry is None else entry)
