"""Which match goes to which table: what is proposed, and what a result calls by itself."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.tournaments.evening.events import Called, CalledBack
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.moves import free_tables


def tables_to_give(state: Evening) -> list[int]:
    """Return the free tables that are given out by themselves: those not reserved."""
    return [table for table in free_tables(state) if table not in state.plan.reserved]


def ready_matches(state: Evening, order: Sequence[str] = ()) -> list[str]:
    """Return the matches that can be called now, the best first.

    One that is waiting for somebody is not among them, and one that was taken off its table comes
    last.

    Parameters
    ----------
    state
        the evening.
    order
        the matches in the order that ends the evening soonest, as far as worked out; the others
        follow by their numbers.
    """
    if not state.drawn or state.plan.form == "chips":
        return []
    busy = {player for one in state.on_tables.values() for player in one.call.players}
    busy |= {player for players in state.elsewhere.values() for player in players}
    last: dict[str, bool] = {}
    for event in state.events:
        if isinstance(event.what, Called | CalledBack):
            last[event.what.match] = isinstance(event.what, CalledBack)
    place = {name: k for k, name in enumerate(order)}
    names = [
        name
        for name in state.standing.to_play
        if name not in state.on_tables
        and name not in state.waiting_for
        and not busy.intersection(state.pair(name))
    ]
    return sorted(
        names,
        key=lambda n: (last.get(n, False), place.get(n, len(place)), state.number_of(n)),
    )


def proposed_calls(
    state: Evening, order: Sequence[str] = (), tables: Sequence[int] | None = None
) -> list[Called]:
    """Return a match for each free table, as far as there are any whose players are free."""
    given = list(tables_to_give(state) if tables is None else tables)
    busy: set[str] = set()
    found: list[Called] = []
    for name in ready_matches(state, order):
        pair = state.pair(name)
        if len(found) < len(given) and not busy.intersection(pair):
            busy.update(pair)
            found.append(Called(name, given[len(found)], pair))
    return found


def calls_after(before: Evening, after: Evening, order: Sequence[str] = ()) -> list[Called]:
    """Return the calls that follow from a result by themselves.

    They go to the table that it frees. A table that was free before with a match ready for it is
    left free: somebody keeps it; one that only waited for a match gets one.
    """
    kept = set(free_tables(before)) if ready_matches(before) else set()
    tables = [table for table in tables_to_give(after) if table not in kept]
    return proposed_calls(after, order, tables)
