"""What can be taken back, the director's last entry first, and what an entry takes away.

An entry takes away matches in play, and results that no longer count.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Event,
    Redone,
    Result,
    Scored,
    Undone,
    Waits,
)
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.matches import LiveScore, OnTable


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


def own_last(state: Evening, by: str = "") -> int | None:
    """Return the number of the last act of an author; all who direct are one author.

    Scores that players tap are no acts.
    """
    phone = Event("", Undone(), by).by_phones
    for number, event in zip(state.numbers[:0:-1], state.events[:0:-1], strict=True):
        if phone and event.by == by and not isinstance(event.what, Scored):
            return number
        if not phone and not event.by_phones:
            return number
    return None


def free_entries(state: Evening) -> set[int]:
    """Return the numbers of the entries that nothing follows from.

    Undone, they leave every other result and match in play as it is.
    """
    found = set()
    for k, number in enumerate(state.numbers[1:], 1):
        event = state.events[k]
        if event.by_phones and isinstance(event.what, Scored):
            continue
        try:
            after = evening(event for n, event in enumerate(state.events) if n != k)
        except InputError:
            continue
        if not losses(
            state, replace(after, numbers=tuple(n for n in state.numbers if n != number))
        ):
            found.add(number)
    return found


def redoable(state: Evening) -> int | None:
    """Return the entry that was undone last, unless the director has entered something since."""
    if not state.undone:
        return None
    entry, last = list(state.undone.items())[-1]
    mine = [n for n, one in zip(state.numbers, state.events, strict=True) if not one.by_phones]
    return entry if last.by > max(mine) else None


def redo(state: Evening, entry: int | None = None) -> Redone:
    """Let an entry that was undone count again; None: the last that was."""
    last = redoable(state)
    if last is None or entry not in (None, last):
        raise InputError("there is nothing to redo")
    return Redone(last)


class Loss(NamedTuple):
    """A match that is no longer played, or whose result no longer counts.

    Parameters
    ----------
    match, players
        the match, as it was played.
    table
        the table that it leaves; None: it was on none, or stays there.
    score
        its score so far; None: it has none, or keeps it.
    result
        its result; None: it was in play.
    """

    match: str
    players: tuple[str, str]
    table: int | None = None
    score: tuple[int, int] | None = None
    result: Result | None = None


def losses(before: Evening, after: Evening) -> list[Loss]:
    """Return what an entry takes away besides that which it is about.

    Nothing of it is forgotten: a result counts again, and a match goes on at its score, as soon as
    the same players are in the match.
    """
    if not before.drawn:
        return []
    about = matches_of(before, after)
    return [*_no_longer_played(before, after, about), *_no_longer_counted(before, after, about)]


def matches_of(before: Evening, after: Evening) -> set[str]:
    """Return the matches that what was entered, or taken back, is about.

    Calls that come with a correction are of players who were not in the match before it.
    """
    then, now = (dict(zip(s.numbers, s.events, strict=True)) for s in (before, after))
    entries = [(then | now)[number].what for number in then.keys() ^ now.keys()]
    return {
        one.match
        for one in entries
        if isinstance(one, Result | CalledBack | Scored | Waits)
        or (isinstance(one, Called) and before.sitting(one.match) == frozenset(one.players))
    }


def _no_longer_played(before: Evening, after: Evening, about: set[str]) -> Iterator[Loss]:
    there, on, live = (after.counted, after.on_tables, after.live) if after.drawn else ({}, {}, {})
    for name in dict.fromkeys([*before.on_tables, *before.live]):
        pair = before.pair(name)
        ended = name in there and set(there[name].players) == set(pair)
        if (ended and not there[name].forfeit) or (name in about and not ended):
            continue
        table, score = None, None
        if name in before.on_tables and not (ended or _plays(on.get(name), pair)):
            table = before.on_tables[name].call.table
        if name in before.live and not _plays(live.get(name), pair):
            games = before.live[name].what
            score = games.score if games.players == pair else games.score[::-1]
        if table is not None or (score is not None and any(score)):
            yield Loss(name, pair, table, score)


def _plays(there: OnTable | LiveScore | None, pair: tuple[str, str]) -> bool:
    if there is None:
        return False
    what = there.call if isinstance(there, OnTable) else there.what
    return set(what.players) == set(pair)


def _no_longer_counted(before: Evening, after: Evening, about: set[str]) -> Iterator[Loss]:
    there = after.counted if after.drawn else {}
    for name, result in before.counted.items():
        entered = any(one.result == result for one in before.records.get(name, ()))
        stays = name in there and set(there[name].players) == set(result.players)
        if entered and not stays and name not in about:
            yield Loss(name, result.players, result=result)
