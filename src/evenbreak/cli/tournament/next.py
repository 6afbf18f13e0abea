"""`evenbreak tournament next`: who plays next, and on which table."""

from __future__ import annotations

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import answer_of, at_option, file_option


@click.command("next")
@file_option
@at_option
@faces()
def command(*, file: str, at: str) -> Answer:
    """Show what is on the tables and which match to call next, so that it ends soonest.

    In a chip tournament it shows who is at which table and who is next in the line.
    """
    from evenbreak.files.tournament_store import read_tournament

    return answer_of(file, read_tournament(file), at)
