"""`evenbreak tournament correct`: correct the result of a match."""

from __future__ import annotations

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import SCORE_OR_NAME
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option, yes_option

EXAMPLES = """\b
Examples:
  evenbreak tournament correct W1.1 5:7
  evenbreak tournament correct W1.1 5:7 --at 20:15
  evenbreak tournament correct R12 bo          (a chip tournament: Bo won rack R12)
"""


@click.command("correct", epilog=EXAMPLES)
@click.argument("match")
@click.argument("score", metavar="SCORE", type=SCORE_OR_NAME)
@file_option
@at_option
@yes_option
@faces()
def command(*, match: str, score: tuple[int, int] | str, file: str, at: str, yes: bool) -> Answer:
    """Correct the result of a match, at any time.

    If others move on because of it, later matches that the wrong players have played are open
    again, and those that they are playing leave their tables: it is then refused without --yes.
    Results and scores are kept, and count again if the correction is undone or corrected.

    In a chip tournament name the winner, and the rack or, for the last rack on a table, the table.
    The chip goes back to its owner; racks that were played since still count, unless a player had
    no chips left by then.
    """
    from evenbreak.answers.tournament.moves import happened
    from evenbreak.tournaments.evening import moves

    before, state = add(file, at, lambda state: [moves.correct(state, match, score)], yes=yes)
    return answer_of(file, state, at, happened(before, state, state.events[-1]))
