"""After how many racks a match ends, and who wins it then.

Races of racks are solved on antidiagonals. Every other match is played rack by rack over all
its states at once: a rack leads from each state to one of two, depending on who wins it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.antidiagonals import Endings, race_endings
from evenbreak.matches.rack_graph import rack_moves

_LONGEST = 100_000
_MOST_CELLS = 20_000_000


def is_bounded(match: Match) -> bool:
    """Return whether the match has a longest possible length."""
    if match.decided(*match.score) is not None:
        return True
    if not isinstance(match, Race) or match.win_by > 1:
        return False
    return isinstance(match.rack, Rack) or is_bounded(match.rack)


def endings_of(match: Match, never: Any, tail: float) -> Endings:
    """Return P(player 1, 2 wins after exactly k racks), k = 0, 1, ... along the first axis.

    Parameters
    ----------
    match
        a match whose p1 and p2 have the same shape.
    never
        P(the match never ends), of that shape.
    tail
        a match without a longest length is followed until the probability that it is still
        going on (and ends some time) is at most this; for 100,000 racks at most, or fewer if
        there are so many parameters that they would not fit in memory.
    """
    winner = match.decided(*match.score)
    rack = match.innermost_rack
    shape = rack.shape
    if winner is not None:
        return Endings(*(np.full((1, *shape), float(winner == player)) for player in (1, 2)))
    if isinstance(match, Race) and match.win_by == 1 and match.rack is rack:
        need_1, need_2 = match.m - match.score[0], match.n - match.score[1]
        return race_endings(need_1, need_2, rack, match.breaks, match.first_breaker)
    size = math.prod(shape)
    play = _play_of(match, size)
    if is_bounded(match):
        wins = _followed(play, np.zeros(size), math.inf)
    else:
        most = min(_LONGEST, max(1_000, _MOST_CELLS // max(size, 1)))
        wins = _followed(play, np.broadcast_to(never, shape).ravel() + tail, most)
    return Endings(*(wins[:, i].reshape(len(wins), *shape) for i in (0, 1)))


@dataclass(frozen=True)
class _Play:
    """The states of a match as arrays: where a won and a lost rack lead, and how likely each is."""

    won: csr_array
    lost: csr_array
    p_won: NDArray[np.float64]
    p_lost: NDArray[np.float64]
    alive: int


def _play_of(match: Match, size: int) -> _Play:
    moves = rack_moves(match)
    row = {state: i for i, state in enumerate(moves)}
    alive, columns = len(moves), np.arange(len(moves))

    def place(state: Any) -> int:
        """Return a state's row; the wins of player 1, player 2 are collected in the last two."""
        return row[state] if state in row else alive + (match.winner(state) == 2)

    def after(player: int) -> tuple[csr_array, NDArray[np.float64]]:
        targets, chances = zip(*(pair[player - 1] for pair in moves.values()), strict=True)
        rows = [place(state) for state in targets]
        matrix = csr_array((np.ones(alive), (rows, columns)), shape=(alive + 2, alive))
        flat = {id(p): np.broadcast_to(np.ravel(p), (size,)) for p in chances}
        return matrix, np.array([flat[id(p)] for p in chances])

    (won, p_won), (lost, p_lost) = after(1), after(2)
    return _Play(won, lost, p_won, p_lost, alive)


def _followed(play: _Play, enough: NDArray[np.float64], most: float) -> NDArray[np.float64]:
    states, size = play.p_won.shape
    mass = np.zeros((states, size))
    mass[0] = 1.0
    wins = [np.zeros((2, size))]
    while len(wins) <= most and (mass.sum(axis=0) > enough).any():
        moved: NDArray[np.float64] = play.won @ (play.p_won * mass) + play.lost @ (
            play.p_lost * mass
        )
        mass = moved[: play.alive]
        wins.append(moved[play.alive :].copy())
    return np.array(wins)
