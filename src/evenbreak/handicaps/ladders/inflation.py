"""What happens to the sum of a league's ratings, and to ratings that a rising skill outruns.

If the winner gains what the loser loses, the sum of all ratings stays the same. The errors that
newcomers bring then stay in the league forever, spread over all players; only moves that the
opponent's move does not balance can remove them. A newcomer's longer steps are such moves. So
are the moves of a system that gives the winner more than it takes from the loser: they add to the
sum with each match, and no result will ever show it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from evenbreak.errors import AccuracyError
from evenbreak.handicaps.ladders.error_chain import error_on, move_matrix
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponent_pairs import opponent_pairs_of

_AT_THE_ENDS = 1e-6


class NewcomerInflation(NamedTuple):
    """What one newcomer does to the sum of the league's rating errors, in points.

    Parameters
    ----------
    brought
        the newcomer's rating error on arrival.
    made
        what their longer steps are expected to add: the part of their moves that no opponent's
        move balances.
    left
        brought + made: what the league is left with once they are established.
    """

    brought: int
    made: float
    left: float


class Lag(NamedTuple):
    """How a rating follows a rising skill.

    Parameters
    ----------
    drift
        how many points the skill rises with each match, on average.
    mean, sd
        of the rating error in the long run, in points; a negative mean is a rating that lags.
    """

    drift: float
    mean: float
    sd: float


def inflation(ladder: Ladder) -> float:
    """Return how much a match raises the sum of the two ratings on average, in points.

    The mean is over the matches of a player whose error has the ladder's distribution.

    >>> from evenbreak.handicaps import Ladder
    >>> inflation(Ladder("npl")), round(inflation(Ladder("step 2 1")), 12)
    (0.0, 1.0)
    """
    pairs = opponent_pairs_of(ladder)
    both = pairs.mean_of(pairs.table.moves.sum(axis=2))
    return float(np.asarray(ladder.law().probability, dtype=float) @ both)


def newcomer_inflation(ladder: Ladder, start: int) -> NewcomerInflation:
    """Return what a newcomer does to the sum of the league's rating errors.

    Each mean is conditional on the error on arrival, and on established opponents as the ladder
    has them.

    Parameters
    ----------
    ladder
        how ratings move; its system defines the newcomer's steps.
    start
        the newcomer's rating less their skill, in whole points.

    Raises
    ------
    InputError
        if start is not on the ladder.

    Notes
    -----
    The k-th match moves a newcomer by f_k times what it moves an established player, and the
    opponent once, so it adds (f_k - 1) times the newcomer's mean move: a sum over the schedule,
    found by propagating the distribution of the error.

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
    """Return how far the rating lags behind a skill that drifts as the ladder's does.

    Raises
    ------
    AccuracyError
        if the ladder's ends hold the error: the skill outruns it, or the ladder is too narrow.

    >>> from evenbreak.handicaps import Ladder
    >>> following = lag(Ladder("npl", drift=0.1))
    >>> round(following.mean, 1), round(following.sd, 1)
    (-4.0, 4.5)
    """
    law = ladder.law()
    share = float(law.probability[0] + law.probability[-1])
    if share > _AT_THE_ENDS:
        raise AccuracyError(
            f"the rating error is at the ladder's ends {share:.2g} of the time: the steps do not "
            f"keep up with a drift of {ladder.drift:g} a match, or the ladder is too narrow; give "
            f"a widest above {ladder.widest}"
        )
    return Lag(ladder.drift, law.mean, law.sd)
