"""`evenbreak tournament export`: the matches for the ratings, the bracket for other programs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.terminal import write_file
from evenbreak.cli.tournament.evening import file_option

EXAMPLES = """\b
Examples:
  evenbreak tournament export --out matches.csv
  evenbreak rate matches.csv
  evenbreak tournament export --brackets-manager cup.json
"""


@click.command("export", epilog=EXAMPLES)
@file_option
@click.option("--out", metavar="FILE.csv", help="Write them to this file.")
@click.option(
    "--events",
    is_flag=True,
    help="List all that happened instead, which evenbreak tournament import reads.",
)
@click.option(
    "--brackets-manager",
    "bracket_file",
    metavar="FILE.json",
    help="Also write the bracket to this file, for brackets-manager and its viewer: of a single or "
    "double elimination, or a round robin.",
)
@faces()
def command(*, file: str, out: str | None, events: bool, bracket_file: str | None) -> Answer:
    """List the matches that were played, as CSV that evenbreak rate reads.

    Matches that no longer count in the bracket after a correction are in it: they were played.
    """
    from evenbreak.answers.faces.to_csv import to_csv
    from evenbreak.answers.tournament_matches import (
        tournament_events_answer,
        tournament_matches_answer,
    )
    from evenbreak.files.tournament_store import read_events, read_tournament

    name = PurePath(file).stem
    warnings: list[str] = []
    if bracket_file is not None:
        from evenbreak.files.brackets_manager_writer import brackets_manager_file

        content, warnings = brackets_manager_file(read_tournament(file), name)
        write_file(bracket_file, content)
    if events:
        answer = tournament_events_answer(read_events(file), name)
    else:
        answer = tournament_matches_answer(read_tournament(file), name)
    if out is not None:
        write_file(out, "".join(to_csv(answer)).encode())
    return replace(answer, warnings=[*warnings, *answer.warnings])
