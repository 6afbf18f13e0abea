"""`evenbreak tournament forfeit`: let a player forfeit a match."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option, yes_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.events import Result
    from evenbreak.tournaments.evening.fold import Evening


@click.command("forfeit")
@click.argument("player")
@click.argument("match", required=False)
@file_option
@at_option
@yes_option
@faces()
def command(*, player: str, match: str | None, file: str, at: str, yes: bool) -> Answer:
    """Let PLAYER forfeit the match they are to play; they play on if the format lets them.

    MATCH is needed only if they have several to play, as in a round robin.
    """
    from evenbreak.answers.tournament.moves import happened
    from evenbreak.tournaments.evening import moves

    def decide(state: Evening) -> list[Result]:
        return [moves.forfeit(state, moves.known_player(state, player), match)]

    before, state = add(file, at, decide, yes=yes)
    return answer_of(file, state, at, happened(before, state, state.events[-1]))
