"""`evenbreak tournament tiebreak`: break the ties of a round robin."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import seed_option
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.events import Ranked
    from evenbreak.tournaments.evening.fold import Evening


@click.command("tiebreak")
@file_option
@click.option("--lot", is_flag=True, help="Break them by lot alone; games do not count.")
@seed_option("The seed of the lots.  [default: a new one each time]", default=None)
@at_option
@faces()
def command(*, file: str, lot: bool, seed: int | None, at: str) -> Answer:
    """Break the ties of a round robin when all its matches are played.

    Players are ranked by matches won, and those who are level by the matches among them. Who is
    still level is ranked by games won minus games lost, and finally by lot.
    """
    import numpy as np

    from evenbreak.answers.tournament.moves import tie_words
    from evenbreak.tournaments.evening.settling import TieBreak, break_ties

    found: list[TieBreak] = []
    rng = np.random.default_rng(seed)

    def decide(state: Evening) -> list[Ranked]:
        found.append(break_ties(state, rng, only_lots=lot))
        return [found[-1].ranked]

    _, state = add(file, at, decide)
    return answer_of(file, state, at, tie_words(found[-1]))
