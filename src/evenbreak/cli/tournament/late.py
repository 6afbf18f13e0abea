"""`evenbreak tournament late`: let a late player in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.starters import POINTS
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.events import Late
    from evenbreak.tournaments.evening.fold import Evening


@click.command("late")
@click.argument("player")
@click.option(
    "--rating", type=POINTS, metavar="R", help="Their rating.  [default: that of a new player]"
)
@file_option
@at_option
@faces()
def command(*, player: str, rating: float | None, file: str, at: str) -> Answer:
    """Let PLAYER in: before the draw, or afterwards in place of a bye that is still open.

    In a chip tournament they get chips by the chart and go to the end of the line.
    """
    from dataclasses import replace

    from evenbreak.answers.kit.scales import far_doubts
    from evenbreak.answers.tournament.moves import entry_words
    from evenbreak.files.tables.names import NAME, clean_name, is_name
    from evenbreak.tournaments.evening import moves
    from evenbreak.tournaments.evening.events import Entrant

    name = clean_name(player)
    if not is_name(name):
        refuse(f"{player!r} is not {NAME}")

    def decide(state: Evening) -> list[Late]:
        plan = state.plan
        if rating is None:
            return [moves.late(state, Entrant(name, plan.starter, plan.starter_error))]
        return [moves.late(state, Entrant(name, rating))]

    before, state = add(file, at, decide)
    answer = answer_of(file, state, at, [entry_words(state, name)])
    known = [entrant.rating for entrant in before.entrants.values()]
    if rating is None or far_doubts(state.scale, known):
        return answer
    return replace(answer, warnings=[*far_doubts(state.scale, [*known, rating]), *answer.warnings])
