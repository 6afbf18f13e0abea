"""`evenbreak tournament drop`: a player goes home."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option, yes_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.events import Dropped
    from evenbreak.tournaments.evening.fold import Evening


@click.command("drop")
@click.argument("player")
@file_option
@at_option
@yes_option
@faces()
def command(*, player: str, file: str, at: str, yes: bool) -> Answer:
    """Let PLAYER go home: they forfeit all their matches to come.

    In the next rounds of a Swiss they are not paired. In a chip tournament they are out, and the
    next in the line takes their place at the table.
    """
    from evenbreak.answers.tournament.moves import forfeited
    from evenbreak.tournaments.evening import moves

    def decide(state: Evening) -> list[Dropped]:
        return [moves.drop(state, moves.known_player(state, player))]

    before, state = add(file, at, decide, yes=yes)
    return answer_of(file, state, at, forfeited(before, state))
