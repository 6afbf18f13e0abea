"""Which match goes to which table: suggestions, and calls that a result makes automatically."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from evenbreak.tournaments.evening.events import Called, CalledBack
from evenbreak.tournaments.evening.fold import Evening


def ready_matches(state: Evening, order: Sequence[str] = ()) -> list[str]:
    """Return the matches that can be called now, best first.

    A match that is waiting for someone is left out; a match already in play comes first, and a
    match that was taken off its table comes last. `order` ends the evening soonest, as far as
    calculated; others follow by number.
    """
    return [name for _, name in night_queue({0: state}, [(0, name) for name in order])]


def night_queue(
    states: Mapping[int, Evening], order: Sequence[tuple[int, str]] = ()
) -> list[tuple[int, str]]:
    """Return the callable matches in all a night's events, as in `ready_matches`.

    Each is a pair of its event's number and its name, and so are those in `order`.
    """
    place = {one: k for k, one in enumerate(order)}
    found = []
    for n, state in states.items():
        if not state.drawn or state.plan.form == "chips":
            continue
        busy = {player for one in state.on_tables.values() for player in one.call.players}
        busy |= {player for players in state.elsewhere.values() for player in players}
        last: dict[str, bool] = {}
        for event in state.events:
            if isinstance(event.what, Called | CalledBack):
                last[event.what.match] = isinstance(event.what, CalledBack)
        found += [
            (
                last.get(name, False),
                name not in state.live,
                place.get((n, name), len(place)),
                state.number_of(name),
                n,
                name,
            )
            for name in state.standing.to_play
            if name not in state.on_tables
            and name not in state.waiting_for
            and not busy.intersection(state.pair(name))
        ]
    return [(n, name) for *_, n, name in sorted(found)]


def proposed_calls(
    states: Mapping[int, Evening],
    order: Sequence[tuple[int, str]] = (),
    tables: Sequence[int] | None = None,
) -> list[tuple[int, Called]]:
    """Return a match for each free table, as long as there are any whose players are free.

    `order` is as in `night_queue`; by default, tables are those assigned automatically.
    """
    given = list(states[min(states)].free_tables if tables is None else tables)
    busy: set[str] = set()
    found: list[tuple[int, Called]] = []
    for n, name in night_queue(states, order):
        pair = states[n].pair(name)
        if len(found) < len(given) and not busy.intersection(pair):
            busy.update(pair)
            found.append((n, Called(name, given[len(found)], pair)))
    return found


def calls_after(
    before: Mapping[int, Evening],
    after: Mapping[int, Evening],
    order: Sequence[tuple[int, str]] = (),
) -> list[tuple[int, Called]]:
    """Return the calls that follow from a result automatically, each with its event.

    They go to the table that it frees, whichever event is next. A table that was already free
    although a match was ready is left free, because someone is keeping it; a table that was only
    waiting for a match gets one.
    """
    kept = set(before[min(before)].free_tables) if night_queue(before) else set()
    tables = [one for one in after[min(after)].free_tables if one not in kept]
    return proposed_calls(after, order, tables)
