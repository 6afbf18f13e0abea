"""`evenbreak tournament drop`: a player goes home."""

from __future__ import annotations

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option


@click.command("drop")
@click.argument("player")
@file_option
@at_option
@faces()
def command(*, player: str, file: str, at: str) -> Answer:
    """Let PLAYER go home: they forfeit all their matches to come.

    In the next rounds of a Swiss they are not paired. In a chip tournament they are out, and the
    next in the line takes their place at the table.
    """
    from evenbreak.answers.tournament_moves import forfeited
    from evenbreak.tournaments.evening import moves

    before, state = add(
        file, at, lambda state: [moves.drop(state, moves.known_player(state, player))]
    )
    return answer_of(file, state, at, forfeited(before, state))
