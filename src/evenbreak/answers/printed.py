"""What has been written to be printed: the cards, and everybody's first match."""

from __future__ import annotations

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.tournament import pair_words
from evenbreak.answers.wording import count_of
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.fold import Evening


def printed_answer(state: Evening, cards: int, place: str) -> Answer:
    """Return what has been written, with the list of the draw: who plays first where.

    Parameters
    ----------
    state
        the tournament.
    cards
        how many score cards there are; 0 for the bracket.
    place
        the file.
    """
    said = (
        f"{count_of(cards, 'score card')} in {place}." if cards else f"The bracket is in {place}."
    )
    now = state.standing
    first: dict[str, str] = {}
    for match in state.bracket.matches:
        for seat in now.seats[match.name]:
            if seat is not None and seat != NOBODY:
                first.setdefault(state.order[seat], match.name)
    rows = []
    for seed, name in enumerate(state.order, start=1):
        where = first.get(name)
        against = "" if where is None else " - ".join(pair_words(now, where))
        table = None if where is None else state.on_tables.get(where)
        rows.append([seed, name, where, against, None if table is None else table.call.table])
    columns = [
        Column("seed", "seed"),
        Column("name", "player", left=True),
        Column("match", "first match", left=True),
        Column("between", "between", left=True),
        Column("table", "table"),
    ]
    return Answer("The draw", [said, Table("draw", columns, rows)])
