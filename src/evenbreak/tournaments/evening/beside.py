"""Several events on one night and one set of tables, and a second chance for players who are out.

The tables, their names and the venue's pace come from the first event. No one plays in two events
at once, and no table has two matches: if taking back an entry would lead to that, the match that
was called first goes back to the queue.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.evening.events import (
    BY_ITSELF,
    Called,
    Event,
    Opened,
    Redone,
    Renamed,
    Undone,
    What,
)
from evenbreak.tournaments.evening.fold import ELIMINATIONS, Evening
from evenbreak.tournaments.evening.matches import Pairing
from evenbreak.tournaments.evening.roster import rename


def together(states: Mapping[int, Evening]) -> dict[int, Evening]:
    """Return a night's events, each aware of the others; a lone event is unchanged."""
    if len(states) < 2:
        return dict(states)
    first = min(states)
    found = {
        n: replace(one if n == first else one.at_tables_of(states[first]), event=n)
        for n, one in states.items()
    }
    for n, gone in _doubled(found).items():
        calls = {pairing: one for pairing, one in found[n].calls.items() if pairing not in gone}
        found[n] = replace(found[n], calls=calls)
    return {n: _among(n, found) for n in found}


def _among(number: int, states: Mapping[int, Evening]) -> Evening:
    """Return an event with the tables and players that the others have taken."""
    others = [one for n, one in states.items() if n != number]
    calls = [on.call for one in others if one.drawn for on in one.on_tables.values()]
    elsewhere = {call.table: call.players for call in calls}
    return replace(states[number], elsewhere=elsewhere, beside=tuple(others))


def _doubled(states: Mapping[int, Evening]) -> dict[int, set[Pairing]]:
    """Return the calls, by event, whose table is closed, or whose table or player is taken."""
    seated = [
        (on.at, n, name, on.call)
        for n, one in states.items()
        if one.drawn
        for name, on in one.on_tables.items()
    ]
    taken: set[int | str] = set()
    gone: dict[int, set[Pairing]] = {}
    for _, n, name, call in sorted(seated, key=lambda one: one[:2], reverse=True):
        closed = call.table > states[n].plan.tables
        if closed or taken & {call.table, *call.players}:
            gone.setdefault(n, set()).add((name, frozenset(call.players)))
        else:
            taken |= {call.table, *call.players}
    return gone


def with_entry(event: int, number: int) -> str:
    """Return the author of automatic entries that came with an entry in another event."""
    return f"{BY_ITSELF} {event}.{number}"


def carried(
    before: Mapping[int, Evening], after: Mapping[int, Evening], event: int
) -> dict[int, list[Event]]:
    """Return what one event's entries add to the night's other events.

    A person has the same name in all of them. Anything that came with an entry is taken back with
    it, and added again with it, except the call for a match that has started since then.
    """
    then, now = before[event], after[event]
    first = len(then.log) + 1
    gone = {with_entry(event, n) for n in {*then.numbers} - {*now.numbers}}
    back = {with_entry(event, n) for n in {*now.numbers} - {*then.numbers} if n < first}
    found: dict[int, list[Event]] = {}
    for n, other in after.items() if now.log[len(then.log) :] else ():
        if n == event:
            continue
        events = zip(other.numbers, other.events, strict=True)
        what: list[tuple[int, What]] = [
            (first, Undone(k))
            for k, one in reversed(list(events))
            if one.by in gone and not _has_begun(other, one)
        ]
        what += [(first, Redone(k)) for k, one in other.undone.items() if one.event.by in back]
        what += [
            (k, rename(other, one.what.name, one.what.to))
            for k, one in enumerate(now.log[len(then.log) :], first)
            if isinstance(one.what, Renamed) and one.what.name in other.entrants
        ]
        at = now.log[-1].at
        found[n] = [Event(at, one, with_entry(event, k)) for k, one in what]
    return {n: each for n, each in found.items() if each}


def _has_begun(state: Evening, event: Event) -> bool:
    """Return whether an entry calls a match that has started since then."""
    call = event.what
    return isinstance(call, Called) and call.match in {*state.live, *state.counted}


def coming_with(
    more: Sequence[tuple[int, What]], event: int, number: int, at: str
) -> dict[int, list[Event]]:
    """Return what comes automatically with an event's entry, such as calls, by event."""
    found: dict[int, list[Event]] = {}
    for n, what in more:
        by = BY_ITSELF if n == event else with_entry(event, number)
        found.setdefault(n, []).append(Event(at, what, by))
    return found


def out(state: Evening) -> list[str]:
    """Return the players who are out of an elimination and haven't gone home, last out first."""
    slots = [slot for one in state.bracket.matches for slot in one.slots]
    stays = {one.match for one in slots if isinstance(one, Source) and one.outcome == "loser"}
    lost = [
        (one.at, name, one.result.loser)
        for name, played in state.records.items()
        for one in played[-1:]
        if name in state.counted and name not in stays
    ]
    names = [player for _, name, player in sorted(lost, reverse=True) if name in state.counted]
    losers = {one.loser for name, one in state.counted.items() if name not in stays}
    return [name for name in dict.fromkeys(names) if name in losers - {*state.dropped}]


def second_chance(state: Evening, *, race: int | None = None, name: str = "") -> Opened:
    """Return the start of a second event for players who are out of an elimination by now.

    It is a single elimination, by default with the losers' side's race. The last player out is the
    first seed; more players can enter until its draw. Raises InputError if the first event isn't an
    elimination, or fewer than two players are out.
    """
    plan = state.plan
    if plan.form not in ELIMINATIONS or not state.drawn:
        raise InputError(
            "a second chance is for players who have been knocked out of an elimination event"
        )
    names = out(state)
    if len(names) < 2:
        raise InputError("fewer than two players are out, so there's no second chance yet")
    plan = replace(
        plan,
        form="single",
        race=race or plan.losers_race or plan.race,
        losers_race=None,
        final_race=None,
        third_place=False,
        seeding="listed",
        qualifiers=None,
        layout=(),
        by_match={},
        name=name,
    )
    return Opened(plan, tuple(state.entrants[name] for name in names))
