"""`evenbreak tournament forfeit`: let a player forfeit a match."""

from __future__ import annotations

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option


@click.command("forfeit")
@click.argument("match")
@click.argument("player")
@file_option
@at_option
@faces()
def command(*, match: str, player: str, file: str, at: str) -> Answer:
    """Let PLAYER forfeit one match; they play on if the format lets them."""
    from evenbreak.answers.tournament_moves import happened
    from evenbreak.tournaments.evening import moves

    before, state = add(file, at, lambda state: [moves.forfeit(state, match, player)])
    return answer_of(file, state, at, happened(before, state, state.events[-1]))
