"""After how many racks a match ends, and who wins it.

Races of racks are solved on antidiagonals. Every other match is played rack by rack over all
its states at once: a rack leads from each state to one of two, depending on who wins it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from evenbreak.arrays import Floats
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.matches.antidiagonals import Endings, race_endings
from evenbreak.matches.parameters import rack_in
from evenbreak.matches.rack_graph import rack_moves

_LONGEST = 100_000
_MOST_CELLS = 20_000_000


def is_bounded(match: Match) -> bool:
    """Return whether the match has a longest possible length."""
    if match.decided(*match.score) is not None:
        return True
    if not isinstance(match, Race) or match.win_by > 1:
        return False
    return not isinstance(match.rack, Match) or is_bounded(match.rack)


def endings_of(match: Match, never: Any, tail: float) -> Endings:
    """Return P(player 1, 2 wins after exactly k racks), k = 0, 1, ... along the first axis.

    Parameters
    ----------
    match
        a match whose p1 and p2 have the same shape.
    never
        P(the match never ends), of that shape.
    tail
        for a match without a longest length: follow it until P(it is still going on, but will
        end) is at most this, for 100,000 racks at most, and fewer where so many parameters
        would not fit in memory.
    """
    winner = match.decided(*match.score)
    rack = rack_in(match)
    shape = rack.shape
    if winner is not None:
        return Endings(*(np.full((1, *shape), float(winner == player)) for player in (1, 2)))
    if isinstance(match, Race) and match.win_by == 1 and match.rack is rack:
        need_1, need_2 = match.m - match.score[0], match.n - match.score[1]
        return race_endings(need_1, need_2, rack, match.breaks, match.first_breaker)
    enough, most = np.broadcast_to(never, shape).ravel() + tail, math.inf
    if is_bounded(match):
        enough = np.zeros(enough.size)
    else:
        most = min(_LONGEST, max(1_000, _MOST_CELLS // max(enough.size, 1)))
    wins = _followed(match, enough, most)
    return Endings(*(wins[:, i].reshape(len(wins), *shape) for i in (0, 1)))


def _followed(match: Match, enough: Floats, most: float) -> Floats:
    """Return P(player 1, 2 wins after exactly k racks); shape (racks + 1, 2, parameters).

    The match is followed until P(it is still going on) is at most `enough`, one value for each
    pair of parameters, but for `most` racks at the most.
    """
    moves = rack_moves(match)
    row = {state: i for i, state in enumerate(moves)}
    alive, size, columns = len(moves), enough.size, np.arange(len(moves))

    def place(state: Any) -> int:
        """Return a state's row; the wins of player 1, player 2 are collected in the last two."""
        return row[state] if state in row else alive + (match.winner(state) == 2)

    def after(player: int) -> tuple[csr_array, Floats]:
        targets, chances = zip(*(pair[player - 1] for pair in moves.values()), strict=True)
        rows = [place(state) for state in targets]
        matrix = csr_array((np.ones(alive), (rows, columns)), shape=(alive + 2, alive))
        flat = {id(p): np.broadcast_to(np.ravel(p), (size,)) for p in chances}
        return matrix, np.array([flat[id(p)] for p in chances])

    (won, p_won), (lost, p_lost) = after(1), after(2)
    mass = np.zeros((alive, size))
    mass[0] = 1.0
    wins = [np.zeros((2, size))]
    while len(wins) <= most and (mass.sum(axis=0) > enough).any():
        moved: Floats = won @ (p_won * mass) + lost @ (p_lost * mass)
        mass = moved[:alive]
        wins.append(moved[alive:].copy())
    return np.array(wins)
