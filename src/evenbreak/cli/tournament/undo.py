"""`evenbreak tournament undo`: take back what happened last."""

from __future__ import annotations

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option


@click.command("undo")
@file_option
@at_option
@faces()
def command(*, file: str, at: str) -> Answer:
    """Take back what happened last; once more takes back what happened before that."""
    from evenbreak.answers.tournament_moves import reopened, undone_words
    from evenbreak.tournaments.evening import moves

    before, state = add(file, at, lambda state: [moves.undo(state)])
    said = [undone_words(before.events[-1].what), *reopened(before, state)]
    return answer_of(file, state, at, said)
