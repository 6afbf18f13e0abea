"""`evenbreak tournament export`: the matches that were played, for the ratings."""

from __future__ import annotations

from pathlib import PurePath

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import file_option

EXAMPLES = """\b
Examples:
  evenbreak tournament export > matches.csv
  evenbreak rate matches.csv
"""


@click.command("export", epilog=EXAMPLES)
@file_option
@faces()
def command(*, file: str) -> Answer:
    """List the matches that were played; into a file it is CSV that evenbreak rate reads.

    Matches that no longer count in the bracket after a correction are in it: they were played.
    """
    from evenbreak.answers.tournament_matches import tournament_matches_answer
    from evenbreak.files.tournament_store import read_tournament

    return tournament_matches_answer(read_tournament(file), PurePath(file).stem)
