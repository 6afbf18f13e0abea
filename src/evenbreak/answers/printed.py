"""What has been written to be printed: the cards, and everybody's first match."""

from __future__ import annotations

from typing import NamedTuple

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.tournament import pair_words
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.fold import Evening


def printed_answer(state: Evening, what: str, place: str) -> Answer:
    """Return what has been written, with the list of the draw: who plays first where.

    Parameters
    ----------
    state
        the tournament.
    what
        what has been written, such as '4 score cards' or 'The bracket'.
    place
        the file.
    """
    columns = [
        Column("seed", "seed"),
        Column("name", "player", left=True),
        Column("match", "first match", left=True),
        Column("between", "between", left=True),
        Column("table", "table"),
    ]
    rows = [
        [one.seed, one.name, one.match, " - ".join(one.pair), one.table]
        for one in first_matches(state)
    ]
    verb = "are" if what[0].isdigit() and not what.startswith("1 ") else "is"
    return Answer("The draw", [f"{what} {verb} in {place}.", Table("draw", columns, rows)])


class First(NamedTuple):
    """A player's first match: its name, who plays it, and the table if it has been called."""

    seed: int
    name: str
    match: str | None
    pair: tuple[str, ...]
    table: int | None


def first_matches(state: Evening) -> list[First]:
    """Return the first match of each player, in seed order.

    Parameters
    ----------
    state
        the tournament, drawn.
    """
    now = state.standing
    first: dict[str, str] = {}
    for match in state.bracket.matches:
        for seat in now.seats[match.name]:
            if seat is not None and seat != NOBODY:
                first.setdefault(state.order[seat], match.name)
    found = []
    for seed, name in enumerate(state.order, start=1):
        where = first.get(name)
        pair = () if where is None else pair_words(now, where)
        called = None if where is None else state.on_tables.get(where)
        found.append(First(seed, name, where, pair, called.call.table if called else None))
    return found
