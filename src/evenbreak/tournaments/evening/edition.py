"""What an evening takes over from the one before it, and what its tables are called."""

from __future__ import annotations

import re
from dataclasses import replace

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import Entrant, Plan
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.format import MOST_TABLES

_SPAN = re.compile(r"([0-9]{1,4})\s*[-–—]\s*([0-9]{1,4})")


def table_names(text: str) -> tuple[int, tuple[str, ...]]:
    """Return how many tables there are, and what the house calls them; () if they are numbered.

    Raises
    ------
    InputError
        if there are none or too many, or two have one name.

    >>> table_names("4"), table_names("1-3, TV"), table_names("5-8")
    ((4, ()), (4, ('1', '2', '3', 'TV')), (4, ('5', '6', '7', '8')))
    """
    names: list[str] = []
    parts = [" ".join(one.split()) for one in re.split(r"[,;]", text) if one.strip()]
    if len(parts) == 1 and re.fullmatch("[0-9]{1,4}", parts[0], re.ASCII):
        count = int(parts[0])
    else:
        for part in parts:
            span = _SPAN.fullmatch(part)
            names += map(str, range(int(span[1]), int(span[2]) + 1)) if span else [part]
        count = len(names) if len(names) > 1 else 0  # a word alone is a slip
    if not 1 <= count <= MOST_TABLES or any(len(name) > 12 for name in names):
        raise InputError(
            "{tables!r}: write how many tables there are, from 1 to {most:,}, or their names, "
            "such as 1-3, TV",
            tables=text[:60],
            most=MOST_TABLES,
        )
    known = [name.casefold() for name in names]
    twice = next((name for name in names if known.count(name.casefold()) > 1), None)
    if twice:
        raise InputError("two tables are called {name}; give each its own name", name=twice)
    plain = names == [str(k) for k in range(1, count + 1)]
    return count, () if plain else tuple(names)


def tables_text(plan: Plan) -> str:
    """Return the tables of a plan as `table_names` reads them.

    >>> tables_text(Plan("single", 5, tables=4, labels=("1", "2", "TV", "4")))
    '1, 2, TV, 4'
    """
    if not plan.labels:
        return str(plan.tables)
    return ", ".join(plan.table_name(table) for table in range(1, plan.tables + 1))


def next_edition(state: Evening, date: str = "") -> tuple[Plan, tuple[Entrant, ...]]:
    """Return the plan and the entrants of an evening like one before: same people, same options.

    The people are also those who were left out of the draw, or asked to play.

    Raises
    ------
    InputError
        if its bracket came from another program.
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
