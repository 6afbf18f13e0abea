"""`evenbreak tournament change`: other tables, or other races from now on."""

from __future__ import annotations

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import Whole
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option
from evenbreak.tournaments.evening.format import LONGEST_RACE, MOST_TABLES

EXAMPLES = """\b
Examples:
  evenbreak tournament change --tables 5
  evenbreak tournament change --losers-race 4
"""


@click.command("change", epilog=EXAMPLES)
@click.option("--tables", type=Whole(1, MOST_TABLES), metavar="T", help="The number of tables.")
@click.option("--race", type=Whole(1, LONGEST_RACE), metavar="N", help="What is raced to.")
@click.option(
    "--losers-race", type=Whole(1, LONGEST_RACE), metavar="N", help="The same on the losers' side."
)
@click.option(
    "--final-race", type=Whole(1, LONGEST_RACE), metavar="N", help="The same in the final."
)
@file_option
@at_option
@faces()
def command(
    *,
    tables: int | None,
    race: int | None,
    losers_race: int | None,
    final_race: int | None,
    file: str,
    at: str,
) -> Answer:
    """Change the number of tables, or the races of the matches that have not begun.

    What it would bring is in evenbreak tournament time, under What if.
    """
    from evenbreak.tournaments.evening import moves

    asked = {
        "tables": tables,
        "race": race,
        "losers_race": losers_race,
        "final_race": final_race,
    }
    _, state = add(file, at, lambda state: [moves.change(state, **asked)])
    return answer_of(file, state, at)
