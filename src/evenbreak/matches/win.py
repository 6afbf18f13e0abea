"""The chance of winning a match, for one pair of probabilities or for arrays of them."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import betainc

from evenbreak.checks import one_of, plain, probability, together, whole_numbers
from evenbreak.errors import InputError
from evenbreak.games.match import Match, Score
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.antidiagonals import race_endings
from evenbreak.matches.outcomes import outcomes_of
from evenbreak.matches.parameters import at_score, broadcast, in_shape


@overload
def win_probability(
    match: Match[float], score: Score | None = None, *, player: int = 1
) -> float: ...
@overload
def win_probability(
    match: Match[Any], score: Score | None = None, *, player: int = 1
) -> NDArray[np.float64]: ...
def win_probability(match: Match, score: Score | None = None, *, player: int = 1) -> Any:
    """Return P(`player` wins the match).

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets. The probabilities of its innermost
        rack may be arrays; p1 and p2 are broadcast together.
    score
        the score now, in racks (in sets for a match of sets); the match's first breaker
        breaks the next rack. None: the match's own start score.
    player
        1 or 2. Each player's chance is worked out by itself, never as 1 minus the other's, so
        both are accurate even if tiny. They add up to 1 minus P(the match never ends).

    Returns
    -------
    float or numpy.ndarray
        a float for plain numbers, otherwise an array of the shape of the parameters.

    Raises
    ------
    InputError
        if the score cannot be reached, `match` is another game, or `player` is not 1 or 2.

    Notes
    -----
    Source: problems P5.5 and P5.6 (races), P5.8 (sets), P5.24 (break formats), P5.27
    (n-ahead). The plain race is a regularised incomplete beta function.

    >>> from evenbreak.games import Race, Rack, winner_breaks
    >>> round(win_probability(Race(9, 5, Rack(2 / 3))), 3)
    0.552
    >>> win_probability(Race(2, 1, Rack([0.5, 0.9], 0.5), breaks=winner_breaks)).round(3)
    array([0.25, 0.81])
    """
    one_of(player, "player", (1, 2))
    match, shape = broadcast(at_score(match, score))
    return in_shape(_win(match, player), shape)


def _win(match: Match, player: int) -> Any:
    winner = match.decided(*match.score)
    if winner is not None:
        return float(winner == player)
    if not isinstance(match, Race) or match.win_by > 1:
        return outcomes_of(match, lengths=False).p_win(player)
    need = match.m - match.score[0], match.n - match.score[1]
    rack = match.rack
    if not match.break_matters:
        one = rack.chance(player) if isinstance(rack, Rack) else _win(rack, player)
        mine, theirs = need if player == 1 else need[::-1]
        return betainc(mine, theirs, one)
    if isinstance(rack, Rack):
        endings = race_endings(*need, rack, match.breaks, match.first_breaker)[player - 1]
        return np.minimum(endings.sum(axis=0), 1.0)  # rounding may take a sum above 1
    return outcomes_of(match, lengths=False).p_win(player)


@overload
def race_win_probability(p: float, m: int, n: int) -> float: ...
@overload
def race_win_probability(p: ArrayLike, m: ArrayLike, n: ArrayLike) -> NDArray[np.float64]: ...
def race_win_probability(p: ArrayLike, m: ArrayLike, n: ArrayLike) -> Any:
    """Return W(p; m, n): P(player 1 wins m games before player 2 wins n), elementwise.

    Parameters
    ----------
    p
        P(player 1 wins a game), whoever breaks.
    m, n
        the games that player 1 and player 2 need: whole numbers, 0 for a player who has
        already won; not both 0. The three are broadcast together.

    Returns
    -------
    float or numpy.ndarray
        the regularised incomplete beta function I_p(m, n). Player 2's chance is
        W(1 - p; n, m), which is accurate even if it is tiny.

    Raises
    ------
    InputError
        if p is not a probability, or m or n is not a whole number from 0 on, or both
        are 0, or the shapes do not broadcast.

    Notes
    -----
    Source: problems P5.5 and P5.6.

    >>> race_win_probability(0.5, [1, 2, 3], 2)
    array([0.75  , 0.5   , 0.3125])
    """
    needs_1, needs_2 = whole_numbers(m, "m", at_least=0), whole_numbers(n, "n", at_least=0)
    chances = probability(p, "p")
    together(p=chances, m=needs_1, n=needs_2)
    chance = betainc(needs_1, needs_2, chances)
    if not (needs_1.all() and needs_2.all()):
        won_1, won_2 = needs_1 == 0, needs_2 == 0
        if (won_1 & won_2).any():
            raise InputError(
                "m and n are both 0 somewhere, but only one player can have won; give 1 or more "
                "for the other"
            )
        chance = np.where(won_1, 1.0, np.where(won_2, 0.0, chance))
    return plain(np.asarray(chance))
