"""What happens to the sum of a league's ratings, and to ratings that skill runs away from.

Where the winner gains what the loser loses, the sum of all ratings stays. The errors that
newcomers bring then stay in the league for ever, spread over all of its players; only moves that
are not answered by an opponent's can take them out. A newcomer's longer steps are such moves,
and so is a system that gives the winner more than it takes from the loser: that adds to the sum
with each match, and no match will ever tell.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from evenbreak.errors import AccuracyError
from evenbreak.handicaps.ladders.error_chain import error_on, move_matrix
from evenbreak.handicaps.ladders.opponent_pairs import meetings_of

if TYPE_CHECKING:
    from evenbreak.handicaps.ladders.ladder import Ladder

_AT_THE_ENDS = 1e-6


class NewcomerInflation(NamedTuple):
    """What one newcomer does to the sum of the league's rating errors, in points.

    Parameters
    ----------
    brought
        his rating error when he came.
    made
        what his longer steps are expected to add: the part of his moves that no opponent's
        move answers.
    left
        brought + made: what the league is left with, once he is established.
    """

    brought: int
    made: float
    left: float


class Lag(NamedTuple):
    """How a rating follows a skill that grows.

    Parameters
    ----------
    drift
        points that the skill rises with each match, on average.
    mean, sd
        of the rating error in the long run, in points; a negative mean is a rating that lags.
    """

    drift: float
    mean: float
    sd: float


def inflation(ladder: Ladder) -> float:
    """Return by how much a match is expected to raise the sum of the two ratings, in points.

    The mean is over the matches of a player whose error has the ladder's law.

    >>> from evenbreak.handicaps import Ladder
    >>> inflation(Ladder("npl")), round(inflation(Ladder("step 2 1")), 12)
    (0.0, 1.0)
    """
    meetings = meetings_of(ladder)
    both = meetings.mean_of(meetings.table.moves.sum(axis=2))
    return float(np.asarray(ladder.law().probability, dtype=float) @ both)


def newcomer_inflation(ladder: Ladder, start: int) -> NewcomerInflation:
    """Return what a newcomer does to the sum of the league's rating errors.

    Each mean is conditional on his error when he comes, and on established opponents as the
    ladder has them.

    Parameters
    ----------
    ladder
        how ratings move; its system says by how much longer a newcomer's steps are.
    start
        the newcomer's rating less his skill, in whole points.

    Raises
    ------
    InputError
        if start is not on the ladder.

    Notes
    -----
    His k-th match moves him by f_k times what it moves an established player, and the opponent
    once, so it adds (f_k - 1) times his mean move: a sum over the schedule, by propagating the
    law of his error.

    >>> from evenbreak.handicaps import Ladder
    >>> weak = newcomer_inflation(Ladder("npl"), -30)
    >>> weak.brought, round(weak.made, 1), round(weak.left, 1)
    (-30, 15.2, -14.8)
    """
    error = error_on(ladder.widest, start)
    law = np.zeros(len(ladder.errors))
    law[error + ladder.widest] = 1.0
    steady = replace(ladder, drift=0.0) if ladder.drift else ladder
    mean_move = steady.kernel @ steady.steps
    made = 0.0
    for matches, factor in ladder.system.newcomer_steps:
        matrix = move_matrix(ladder, factor)
        for _ in range(matches):
            made += (factor - 1) * float(law @ mean_move)
            law = law @ matrix
    return NewcomerInflation(error, made, error + made)


def lag(ladder: Ladder) -> Lag:
    """Return how far the rating of a player lags whose skill drifts as the ladder says.

    Raises
    ------
    AccuracyError
        if the ladder's ends hold the error: the skill runs away, or the ladder is too narrow.

    >>> from evenbreak.handicaps import Ladder
    >>> following = lag(Ladder("npl", drift=0.1))
    >>> round(following.mean, 1), round(following.sd, 1)
    (-4.0, 4.5)
    """
    law = ladder.law()
    share = float(law.probability[0] + law.probability[-1])
    if share > _AT_THE_ENDS:
        raise AccuracyError(
            f"the ladder's ends hold the rating {share:.2g} of the time: the steps do not keep up "
            f"with a drift of {ladder.drift:g} a match, or widest {ladder.widest} is too little"
        )
    return Lag(ladder.drift, law.mean, law.sd)
