"""The chance of winning a match, for one pair of probabilities or for arrays of them."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import one_of, plain, probability, together, whole, whole_numbers
from evenbreak.errors import InputError
from evenbreak.game import Game
from evenbreak.games.match import Match, Score
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.endings import race_endings
from evenbreak.matches.outcomes import outcomes_of
from evenbreak.matches.parameters import at_score, ends_of_game, in_shape, rack_in
from evenbreak.stats.beta_tail import beta_tail


@overload
def win_probability(
    match: Match[float],
    score: Score | None = None,
    *,
    player: int = 1,
    exact: Literal[False] = False,
    via: Way | None = None,
) -> float: ...
@overload
def win_probability(  # type: ignore[overload-overlap]  # a match is a game too
    match: Match[Any], score: Score | None = None, *, player: int = 1, exact: Literal[False] = False
) -> Floats: ...
@overload
def win_probability(
    match: Game, score: Any = None, *, player: int = 1, exact: Literal[True]
) -> Fraction: ...
@overload
def win_probability(
    match: Game,
    score: Any = None,
    *,
    player: int = 1,
    exact: Literal[False] = False,
    via: Way | None = None,
) -> float: ...
def win_probability(
    match: Game,
    score: Any = None,
    *,
    player: int = 1,
    exact: bool = False,
    via: Way | None = None,
) -> Any:
    """Return P(`player` wins the match).

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks, sets or custom games, or any other game (see
        `evenbreak.game`). The probabilities of its innermost rack may be arrays; p1 and p2 are
        broadcast together.
    score
        the current score, in racks (in sets for a match of sets); the match's first breaker breaks
        the next rack. None: the match's own start score. For any other game, the current state.
    player
        1 or 2, or any player in a custom game. Each player's chance is calculated separately, never
        as 1 minus the others', so all are accurate even if tiny. They add up to 1 minus P(the match
        never ends).
    exact
        whether to calculate in fractions. A rack's chance given as a `Fraction` is used unchanged;
        a float is used as the decimal that it prints: 0.6 is 3/5.
    via
        the method of calculating a chance in plain numbers. 'kernel': the fast closed form or
        recursion of this package. 'elimination', 'eigen': the stochastic limit of the game's graph,
        by elimination or by eigenvectors (see `evenbreak.chains.limit_of`); the three agree to
        1e-12. None: the kernel, or elimination for a custom game, which has no kernel.

    Returns
    -------
    float, numpy.ndarray or Fraction
        a float for plain numbers, otherwise an array of the shape of the parameters; a
        fraction if `exact`.

    Raises
    ------
    InputError
        if the score cannot be reached, `match` is not a game, `player` is not one, an exact answer
        is requested for arrays, or `via` is unknown.
    AccuracyError
        by eigenvectors, if the error may be above 1e-12.
    GameError, ChainError
        as `game_odds` does, for a custom game; also, with `exact`, if the moves from a state of it
        do not sum to exactly 1.

    Notes
    -----
    Source: problems P5.5 and P5.6 (races), P5.8 (sets), P5.24 (break formats), P5.27
    (n-ahead). The plain race is a regularized incomplete beta function.

    >>> from evenbreak.games import Race, Rack, winner_breaks
    >>> round(win_probability(Race(9, 5, Rack(2 / 3))), 3)
    0.552
    >>> win_probability(Race(2, 1, Rack([0.5, 0.9], 0.5), breaks=winner_breaks)).round(3)
    array([0.25, 0.81])
    >>> win_probability(Race(3, 2, Rack(0.6)), exact=True)
    Fraction(297, 625)
    >>> from evenbreak.games import OneBall
    >>> win_probability(OneBall(0.5, 0.25)), win_probability(Race(2, 2, OneBall(0.5, 0.25)))
    (0.8, 0.896)
    """
    way = way_of_limit(via, exact=exact)
    if way is not None:  # these bring all chains along, which the kernels do without
        from evenbreak.matches.by_limit import odds_by_limit
    if exact:
        from evenbreak.matches.exact_win import exact_win, exact_win_of_game
    if not isinstance(match, Match) and isinstance(match, Game):
        whole(player, "player", at_least=1)
        if way is not None:
            return odds_by_limit(match, way, score).p_win(player)
        if via == "kernel":
            raise InputError("via is 'kernel', but a game of your own has none. Use elimination.")
        ends = ends_of_game(match, score)
        return exact_win_of_game(ends, player) if exact else ends.p_win(player)
    one_of(player, "player", (1, 2))
    if exact and isinstance(match, Match):
        return exact_win(match if score is None else replace(match, score=score), player)
    if way is not None and isinstance(match, Match):
        match = match if score is None else replace(match, score=score)
        return odds_by_limit(match, way).p_win(player)
    match, shape = at_score(match, score)
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
        p = _win(rack, player) if isinstance(rack, Match) else rack_in(match).chance(player)
        mine, theirs = need if player == 1 else need[::-1]
        return beta_tail(mine, theirs, p)
    if isinstance(rack, Rack):
        endings = race_endings(*need, rack, match.breaks, match.first_breaker)[player - 1]
        return np.minimum(endings.sum(axis=0), 1.0)  # rounding may take a sum above 1
    return outcomes_of(match, lengths=False).p_win(player)


@overload
def race_win_probability(p: float, m: int, n: int) -> float: ...
@overload
def race_win_probability(p: ArrayLike, m: ArrayLike, n: ArrayLike) -> Floats: ...
def race_win_probability(p: ArrayLike, m: ArrayLike, n: ArrayLike) -> Any:
    """Return W(p; m, n): P(player 1 wins m games before player 2 wins n), elementwise.

    Parameters
    ----------
    p
        P(player 1 wins a game), regardless of who breaks.
    m, n
        the games that player 1 and player 2 need: whole numbers, 0 for a player who has
        already won; not both 0. The three are broadcast together.

    Returns
    -------
    float or numpy.ndarray
        the regularized incomplete beta function I_p(m, n). Player 2's chance is
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
    chance = np.asarray(beta_tail(needs_1, needs_2, chances))
    if not (needs_1.all() and needs_2.all()):
        won_1, won_2 = needs_1 == 0, needs_2 == 0
        if (won_1 & won_2).any():
            raise InputError(
                "m and n are both 0 somewhere, but only one player can have won. Make one of "
                "them 1 or more."
            )
        chance = np.where(won_1, 1.0, np.where(won_2, 0.0, chance))
    return plain(np.asarray(chance))
