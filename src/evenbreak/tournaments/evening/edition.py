"""What an evening takes over from the previous one, and its tables in typed form."""

from __future__ import annotations

from dataclasses import replace

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import Entrant, Plan
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.format import names_text


def tables_text(plan: Plan) -> str:
    """Return a plan's tables in the form that `house_tables` reads.

    >>> tables_text(Plan("single", 5, tables=4, labels=("1", "2", "TV", "4")))
    '1-2, TV, 4'
    """
    if not plan.labels:
        return str(plan.tables)
    return names_text([plan.table_name(table) for table in range(1, plan.tables + 1)])


def next_edition(state: Evening, date: str = "") -> tuple[Plan, tuple[Entrant, ...]]:
    """Return the plan and entrants for an evening like an earlier one: same people and options.

    The people include anyone who was left out of the draw or asked to play. Raises InputError if
    the bracket came from another program.
    """
    if state.plan.layout:
        raise InputError(
            "the bracket of this tournament came from another program, so it has no next edition"
        )
    left_out = [
        state.plan.newcomer(name) if rating is None else Entrant(name, rating)
        for name, rating in state.registered.items()
    ]
    return replace(state.plan, date=date, by_match={}), (*state.entrants.values(), *left_out)
