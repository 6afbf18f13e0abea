"""`evenbreak tournament export`: the matches for the ratings, or all that happened."""

from __future__ import annotations

from pathlib import PurePath

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.terminal import write_file
from evenbreak.cli.tournament.evening import file_option

EXAMPLES = """\b
Examples:
  evenbreak tournament export --out matches.csv
  evenbreak rate matches.csv
  evenbreak tournament export --events --out cup.csv
"""


@click.command("export", epilog=EXAMPLES)
@file_option
@click.option("--out", metavar="FILE.csv", help="Write them to this file.")
@click.option(
    "--events",
    is_flag=True,
    help="List all that happened instead, which evenbreak tournament import reads.",
)
@faces()
def command(*, file: str, out: str | None, events: bool) -> Answer:
    """List the matches that were played, as CSV that evenbreak rate reads.

    Matches that no longer count in the bracket after a correction are in it: they were played.
    """
    from evenbreak.answers.faces.to_csv import to_csv
    from evenbreak.answers.tournament.printed import (
        tournament_events_answer,
        tournament_matches_answer,
    )
    from evenbreak.files.store.tournament import read_events, read_tournament

    name = PurePath(file).stem
    if events:
        answer = tournament_events_answer(read_events(file), name)
    else:
        answer = tournament_matches_answer(read_tournament(file), name)
    if out is not None:
        write_file(out, "".join(to_csv(answer)).encode())
    return answer
