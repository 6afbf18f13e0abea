"""What a finished evening shows about its venue's pace, for the next evening there."""

from __future__ import annotations

from collections.abc import Iterable

from evenbreak.tournaments.clock.event_pace import SLOWEST, EarlierNight, event_pace
from evenbreak.tournaments.evening.events import Called, Changed, Scored
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.outlook import Outlook

_MOST_NIGHTS = 20  # at a venue: it changes, and more of them would say no more


def night_played(state: Evening) -> EarlierNight | None:
    """Return how long an evening took, and the time expected before its first match.

    Return None if it doesn't show the pace: it isn't over, no match was called, tables or races
    were changed, it is a chip tournament, or it took less than half or more than twice as long as
    usual, as when results were entered afterward.
    """
    calls = [k for k, one in enumerate(state.events) if isinstance(one.what, Called)]
    if not state.drawn or not calls or state.plan.form == "chips":
        return None
    if not all(match.name in state.standing.winners for match in state.whole.matches):
        return None
    begun = state.events[: calls[0]]
    meanwhile = [one.what for one in state.events[calls[0] :]]
    if any(isinstance(what, Changed) for what in meanwhile):
        return None
    start = evening([one for one in begun if not isinstance(one.what, Scored)])
    if not start.drawn or start.winners:
        return None
    now = Outlook(state, state.events[-1].at)
    ends = [
        min(one.at for one in state.records[name] if set(one.result.players) == set(result.players))
        for name, result in state.counted.items()
        if name in state.records
    ]
    at = state.events[calls[0]].at
    took = now.minutes(max(ends, default=at))
    planned = Outlook(start, at)
    usual = planned.finish(pace=event_pace(start.plan.discipline)).finish(0.5)
    ratio = took / (usual - planned.minutes(at))
    if not 1.0 / SLOWEST <= ratio <= SLOWEST:
        return None
    return EarlierNight(at, start.plan.discipline, ratio)


def nights_until(evenings: Iterable[Evening]) -> tuple[EarlierNight, ...]:
    """Return a venue's nights, oldest first: these evenings, and the nights they know about."""
    found: dict[str, EarlierNight] = {}
    for state in evenings:
        found |= {one.at: one for one in state.plan.earlier}
        if (one := night_played(state)) is not None:
            found[one.at] = one
    return tuple(found[at] for at in sorted(found))[-_MOST_NIGHTS:]
