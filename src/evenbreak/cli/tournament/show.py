"""`evenbreak tournament show`: the bracket as it stands."""

from __future__ import annotations

from dataclasses import replace

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.tournament.evening import answer_of, at_option, file_option


@click.command("show")
@file_option
@at_option
@faces()
def command(*, file: str, at: str) -> Answer:
    """Show the bracket: each match with its players, its score and its table."""
    from evenbreak.answers.tournament_night import bracket_table
    from evenbreak.files.tournament_store import read_tournament

    state = read_tournament(file)
    answer = answer_of(file, state, at)
    if not state.drawn:
        return answer
    table = bracket_table(state)
    return replace(answer, parts=[answer.parts[0], table, *answer.parts[1:]], csv=table)
