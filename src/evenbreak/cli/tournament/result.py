"""`evenbreak tournament result`: enter the result of a match."""

from __future__ import annotations

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import SCORE_OR_NAME
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option

EXAMPLES = """\b
Examples:
  evenbreak tournament result W1.1 7:5
  evenbreak tournament result W1.1 7:5 --at 20:15
  evenbreak tournament result 3 ann            (a chip tournament: Ann won the rack on table 3)
"""


@click.command("result", epilog=EXAMPLES)
@click.argument("match")
@click.argument("score", metavar="SCORE", type=SCORE_OR_NAME)
@file_option
@at_option
@faces()
def command(*, match: str, score: tuple[int, int] | str, file: str, at: str) -> Answer:
    """Enter the result of a match: the games of its first player, a colon, those of the second.

    In a chip tournament the number of the table and the winner's name will do; a first name is
    enough if no other player has it.

    If a forfeit was meant, use evenbreak tournament forfeit.
    """
    from evenbreak.answers.tournament.moves import happened
    from evenbreak.tournaments.evening import moves

    before, state = add(file, at, lambda state: [moves.result(state, match, score)])
    return answer_of(file, state, at, happened(before, state, state.events[-1]))
