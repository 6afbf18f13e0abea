"""`evenbreak tournament call`: call matches to tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.events import Called, CalledBack
    from evenbreak.tournaments.evening.fold import Evening


@click.command("call")
@click.argument("match", required=False)
@click.option("--table", type=Whole(1, 1000), metavar="N", help="The table.  [default: a free one]")
@click.option("--back", is_flag=True, help="Take MATCH off its table; it keeps its score.")
@file_option
@at_option
@faces()
def command(*, match: str | None, table: int | None, back: bool, file: str, at: str) -> Answer:
    """Call a match to a table, or move it; without MATCH, call the next to all free tables.

    With --back a match is taken off its table. It can be called again later.

    In a chip tournament players come to the tables by themselves, in the order of the line.

    The times of calls and results show how fast this evening is, and so when it ends.
    """
    from evenbreak.answers.tournament.night import next_calls
    from evenbreak.tournaments.evening import moves
    from evenbreak.tournaments.evening.outlook import Outlook

    if match is None and table is not None:
        refuse("--table is for one match; name it, such as W1.1")

    if back and (match is None or table is not None):
        refuse("--back takes one match off its table; name it alone, such as W1.1 --back")

    def decide(state: Evening) -> Sequence[Called | CalledBack]:
        if state.plan.form == "chips":
            refuse(
                "a chip tournament needs no calls: each result brings the next in the line to the "
                "table; see evenbreak tournament next"
            )
        if match is not None:
            return [moves.call_back(state, match) if back else moves.call(state, match, table)]
        called = [moves.call(state, name, k) for k, name in next_calls(Outlook(state, at))]
        if not called:
            refuse("no match can be called: no table is free, or no match is ready")
        return called

    before, state = add(file, at, decide)
    said = [
        f"Table {one.call.table}: {name}, {' against '.join(one.call.players)}."
        for name, one in state.on_tables.items()
        if before.on_tables.get(name) != one
    ]
    said += [
        f"{name} is off table {one.call.table}."
        for name, one in before.on_tables.items()
        if name not in state.on_tables
    ]
    return answer_of(file, state, at, said)
