"""What can be taken back, starting with the director's last entry, and what an entry removes.

An entry can remove matches in play, and results that stop counting.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.evening.events import (
    BY_ITSELF,
    Called,
    CalledBack,
    CheckedIn,
    Declined,
    Event,
    Redone,
    Registered,
    Result,
    Scored,
    Substituted,
    Undone,
    Waits,
)
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.matches import LiveScore, OnTable
from evenbreak.words import Sentence, say

_LIGHT = Called | CalledBack | Scored | Waits | CheckedIn | Registered | Declined
"""Entries that no result depends on."""


def own_last(state: Evening, by: str = "") -> int | None:
    """Return the number of an author's last action; all directors count as one author.

    Scores tapped by players, or entered by a program, aren't actions.
    """
    phone = Event("", Undone(), by).by_phones
    for number, event in zip(state.numbers[:0:-1], state.events[:0:-1], strict=True):
        if isinstance(event.what, Scored) and event.by_program:
            continue
        if phone and event.by == by and not isinstance(event.what, Scored):
            return number
        if not phone and not event.by_phones and not event.by.startswith(BY_ITSELF):
            return number
    return None


def undoable(state: Evening) -> dict[int, Event]:
    """Return what can be taken back at once, by number: the director's last action, and players'.

    A result entered by both players can be taken back this way until the director enters something.
    """
    events = dict(zip(state.numbers, state.events, strict=True))
    own = own_last(state)
    found = {
        number: event
        for number, event in events.items()
        if event.by_phones and isinstance(event.what, Result) and number > (own or 1)
    }
    last = {max(found): found[max(found)]} if found else {}
    return last if own is None else last | {own: events[own]}


def free_entries(state: Evening) -> set[int]:
    """Return the numbers of entries that nothing depends on.

    Undoing them leaves every other result and every match in play as it is. Scores tapped by
    players are left out.
    """
    return {number for number in state.numbers[1:] if is_free(state, number)}


def is_free(state: Evening, entry: int) -> bool:
    """Return whether nothing follows from an entry."""
    events = dict(zip(state.numbers, state.events, strict=True))
    if entry not in events or entry == 1:
        return False
    what, at = events[entry].what, state.events[-1].at
    if isinstance(what, Called | CalledBack) and _is_past(state, entry, what.match):
        return False
    own = _own(events, entry)
    if (isinstance(what, Scored) and events[entry].by_phones) or own[-1] != entry:
        return False
    back = _taken_back(state, events, entry)
    if len(own) == 1 and (isinstance(what, _LIGHT) or _leads_nowhere(state, what)):
        return True
    try:
        after = state.then(*(Event(at, one) for one in back))
        return not (losses(state, after) or _open_behind(state, after)) and (
            after.drawn or not state.drawn
        )
    except InputError:
        return False


def _own(events: Mapping[int, Event], entry: int) -> list[int]:
    """Return what was entered with an entry, without automatic calls."""
    act = _act(events, entry) if isinstance(events[entry].what, Called | Result) else [entry]
    return [number for number in act if events[number].by != BY_ITSELF] or [entry]


def _is_past(state: Evening, entry: int, match: str) -> bool:
    """Return whether a match is over, or has been called again, since one of its calls."""
    if not state.drawn or match not in state.standing.to_play:
        return True
    return any(
        number > entry and isinstance(event.what, Called | CalledBack) and event.what.match == match
        for number, event in zip(state.numbers, state.events, strict=True)
    )


def _open_behind(before: Evening, after: Evening) -> bool:
    """Return whether a match from an earlier Swiss round is open again."""
    if before.plan.form != "swiss" or not after.drawn:
        return False
    last = f"R{len(after.later)}."
    open_again = before.counted.keys() - after.counted.keys()
    return any(not name.startswith(last) for name in open_again & after.standing.seats.keys())


def _leads_nowhere(state: Evening, what: object) -> bool:
    """Return whether a result's match leads only to matches that haven't started."""
    if not isinstance(what, Result) or not state.drawn or state.plan.form in ("chips", "swiss"):
        return False
    sources = {what.match, *(g.name for g in state.bracket.groups if what.match in g.matches)}
    begun = {*state.records, *state.on_tables, *state.live}
    return not any(
        isinstance(slot, Source) and slot.match in sources
        for name in begun
        if name in state.bracket.by_name
        for slot in state.bracket.match(name).slots
    )


def undo(state: Evening, entry: int | None = None) -> list[Undone]:
    """Undo an entry; None: the director's last one.

    Calls that came with it, as when two matches trade tables, are undone too. Raises InputError if
    something depends on it.
    """
    own = own_last(state)
    chosen = own if entry is None else entry
    if chosen is None:
        raise InputError("there's nothing to undo")
    events = dict(zip(state.numbers, state.events, strict=True))
    if chosen not in undoable(state) and not is_free(state, chosen):
        raise InputError(_why_not(state, events, chosen))
    return _taken_back(state, events, chosen)


def _why_not(state: Evening, events: Mapping[int, Event], entry: int) -> Sentence:
    """Return why an entry can't be taken back."""
    if not 1 <= entry <= len(state.log):
        return say("there is no entry {entry}", entry=entry)
    if entry in state.undone:
        return say("entry {entry} has already been undone", entry=entry)
    if entry not in events:
        return say("entry {entry} is an undo or a redo; those can't be undone", entry=entry)
    what = events[entry].what
    if isinstance(what, Called | CalledBack) and _is_past(state, entry, what.match):
        match = state.match_words(what.match) if state.drawn else what.match
        return say("{match} has been played or called again since that call", match=match)
    if entry not in (own := _own(events, entry)):
        return say(
            "entry {entry} came with entry {other}. Undo entry {other} instead.",
            entry=entry,
            other=own[-1],
        )
    return say(
        "other entries depend on entry {entry}. Undo those first, or correct entry {entry}.",
        entry=entry,
    )


def _taken_back(state: Evening, events: Mapping[int, Event], entry: int) -> list[Undone]:
    """Return the entries that take back an entry and whatever came with it, last first.

    A match that was called with a result and has started since then stays on its table.
    """
    begun = {*state.live, *state.counted} if state.drawn else set()
    return [
        Undone(number)
        for number in reversed(_act(events, entry))
        if number == entry
        or events[number].by != BY_ITSELF
        or events[number].what.match not in begun  # type: ignore[union-attr]
    ]


def redoable(state: Evening) -> int | None:
    """Return the entry that was undone last, unless the director has entered something since.

    If an action has several entries, such as a correction and the call it needed, it is the one
    that gives the action its name, as when it is undone.
    """
    if not state.undone:
        return None
    entry, last = list(state.undone.items())[-1]
    if last.by <= (own_last(state) or 1):
        return None
    events = _all_events(state)
    act = [number for number in _act(events, entry) if number in state.undone]
    return [n for n in act if events[n].by != BY_ITSELF or n == entry][-1]


def _all_events(state: Evening) -> dict[int, Event]:
    """Return all entries by number, including undone ones."""
    events = dict(zip(state.numbers, state.events, strict=True))
    return events | {number: one.event for number, one in state.undone.items()}


def redo(state: Evening, entry: int | None = None) -> list[Redone]:
    """Let an undone entry count again, with whatever came with it; None: the last one."""
    last = redoable(state)
    if last is None or entry not in (None, last):
        raise InputError("there's nothing to redo")
    return [Redone(n) for n in _act(_all_events(state), last) if n in state.undone]


def _act(events: Mapping[int, Event], number: int) -> list[int]:
    """Return an entry with the calls that came with it, or that it came with."""
    first = last = number
    while _came_with_next(events, first - 1):
        first -= 1
    while _came_with_next(events, last):
        last += 1
    return [*range(first, last + 1)]


def _came_with_next(events: Mapping[int, Event], number: int) -> bool:
    """Return whether an entry came with the next one.

    It did if the next one is a result's automatic call, or if it is itself a call that couldn't
    have been made alone: to a table that was taken, or for players who weren't in the match.
    """
    event, following = events.get(number), events.get(number + 1)
    if event is not None and following is not None and following.by == BY_ITSELF:
        return True
    if event is None or following is None or not isinstance(call := event.what, Called):
        return False
    what = following.what
    leads = isinstance(what, Called) or (isinstance(what, Result) and what.corrects)
    if not leads or (event.at, event.by) != (following.at, following.by):
        return False
    try:
        before = evening(events[n] for n in sorted(events) if n < number)
        taken = {one.call.table for name, one in before.on_tables.items() if name != call.match}
        return before.sitting(call.match) != frozenset(call.players) or call.table in taken
    except InputError:  # of what is undone, something does not fit any more
        return False


class Loss(NamedTuple):
    """A match that is no longer played, or whose result no longer counts.

    `table` is the one it leaves, and `score` is the one it loses; `result` is None for a match in
    play.
    """

    match: str
    players: tuple[str, str]
    table: int | None = None
    score: tuple[int, int] | None = None
    result: Result | None = None


def losses(before: Evening, after: Evening) -> list[Loss]:
    """Return what an entry removes apart from its own subject.

    None of it is forgotten: a result counts again, and a match continues at its score, as soon as
    the same players are in the match.
    """
    if not before.drawn:
        return []
    about = matches_of(before, after)
    return [*_no_longer_played(before, after, about), *_no_longer_counted(before, after, about)]


def matches_of(before: Evening, after: Evening) -> set[str]:
    """Return the matches affected directly by what was entered or taken back.

    Calls that come with a correction are for players who weren't in the match before it.
    """
    return {
        one.match
        for one in _between(before, after)
        if isinstance(one, Result | CalledBack | Scored | Waits)
        or (isinstance(one, Called) and before.sitting(one.match) == frozenset(one.players))
    }


def _between(before: Evening, after: Evening) -> list[object]:
    """Return what was entered, or taken back."""
    then, now = (dict(zip(s.numbers, s.events, strict=True)) for s in (before, after))
    return [(then | now)[number].what for number in then.keys() ^ now.keys()]


def _names_after(before: Evening, after: Evening) -> dict[str, str]:
    """Return players' names after a rename or a substitution."""
    now = {who: name for name, who in after.entries.items()}
    names = {name: now[who] for name, who in before.entries.items() if who in now}
    for one in _between(before, after):
        if isinstance(one, Substituted):
            names |= {one.name: one.entrant.name, one.entrant.name: one.name}
    return names


def _no_longer_played(before: Evening, after: Evening, about: set[str]) -> Iterator[Loss]:
    there, on, live = (after.counted, after.on_tables, after.live) if after.drawn else ({}, {}, {})
    names = _names_after(before, after)
    for name in dict.fromkeys([*before.on_tables, *before.live]):
        pair = before.pair(name)
        now = {names.get(player, player) for player in pair}
        ended = name in there and set(there[name].players) == now
        if (ended and not there[name].forfeit) or (name in about and not ended):
            continue
        table, score = None, None
        if name in before.on_tables and not (ended or _plays(on.get(name), now)):
            table = before.on_tables[name].call.table
        if name in before.live and not _plays(live.get(name), now):
            score = before.live[name].of(pair)
        if table is not None or (score is not None and any(score)):
            yield Loss(name, pair, table, score)


def _plays(there: OnTable | LiveScore | None, pair: set[str]) -> bool:
    if there is None:
        return False
    what = there.call if isinstance(there, OnTable) else there.what
    return set(what.players) == pair


def _no_longer_counted(before: Evening, after: Evening, about: set[str]) -> Iterator[Loss]:
    there = after.counted if after.drawn else {}
    names = _names_after(before, after)
    for name, result in before.counted.items():
        entered = any(one.result == result for one in before.records.get(name, ()))
        players = {names.get(player, player) for player in result.players}
        stays = name in there and set(there[name].players) == players
        if entered and not stays and name not in about:
            yield Loss(name, result.players, result=result)
