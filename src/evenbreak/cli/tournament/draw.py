"""`evenbreak tournament draw`: make the draw."""

from __future__ import annotations

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import seed_option
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option


@click.command("draw")
@file_option
@seed_option("The seed of a blind draw.  [default: a new one each time]", default=None)
@at_option
@faces()
def command(*, file: str, seed: int | None, at: str) -> Answer:
    """Make the draw, in the way that --seeding of evenbreak tournament new said.

    Later it draws what comes next: the next round of a Swiss once a round is over, or, with
    --placement redraw, the losers' side's qualifiers for the knock-out.
    """
    import numpy as np

    from evenbreak.answers.tournament.moves import draw_words
    from evenbreak.tournaments.evening import moves

    rng = np.random.default_rng(seed)
    before, state = add(file, at, lambda state: moves.draw_next(state, rng))
    return answer_of(file, state, at, [draw_words(before, state)])
