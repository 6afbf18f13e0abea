"""`evenbreak tournament score`: enter the score of a match in play."""

from __future__ import annotations

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import SCORE
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option


@click.command("score")
@click.argument("match")
@click.argument("score", type=SCORE)
@file_option
@at_option
@faces()
def command(*, match: str, score: tuple[int, int], file: str, at: str) -> Answer:
    """Enter the score of a match in play; the odds and the finish go by it from then on.

    It is not needed: the result alone will do.
    """
    from evenbreak.tournaments.evening import moves

    _, state = add(file, at, lambda state: [moves.score(state, match, score)])
    name = moves.known_match(state, match)
    one, other = state.pair(name)
    return answer_of(file, state, at, [f"{name}: {one} {score[0]}, {other} {score[1]}."])
