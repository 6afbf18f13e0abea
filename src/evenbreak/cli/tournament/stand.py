"""`evenbreak tournament stand`: let a match stand that the wrong player has played."""

from __future__ import annotations

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option, yes_option


@click.command("stand")
@click.argument("match")
@file_option
@at_option
@yes_option
@faces()
def command(*, match: str, file: str, at: str, yes: bool) -> Answer:
    """Let a match stand that was played before a correction sent somebody else into it.

    The corrected score is kept, but those who have played on stay where they are.
    """
    from evenbreak.answers.tournament.moves import reopened, settled_words
    from evenbreak.tournaments.evening.settling import stand

    before, state = add(file, at, lambda state: stand(state, match), yes=yes)
    return answer_of(file, state, at, [*settled_words(before, state), *reopened(before, state)])
