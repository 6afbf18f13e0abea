"""After how many racks a match ends, and who has won it then: the one distribution.

Races of racks go by antidiagonals. Every other match is played rack by rack over all
its states at once: a rack from any state leads to one of two, by who wins it.
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
from evenbreak.matches.parameters import shape_of, with_rack

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
        a match whose parameters have one shape.
    never
        P(the match never ends), of that shape.
    tail
        a match without a longest length is followed until no more than this much
        mass has not ended (beyond what never ends), or for 100,000 racks, or for
        fewer where there are so many parameters that this would not fit in memory.
    """
    winner = match.decided(*match.score)
    rack = match.innermost_rack
    shape = shape_of(rack)
    if winner is not None:
        return Endings(*(np.full((1, *shape), float(winner == player)) for player in (1, 2)))
    if isinstance(match, Race) and match.win_by == 1 and match.rack is rack:
        need_1, need_2 = match.m - match.score[0], match.n - match.score[1]
        return race_endings(need_1, need_2, rack, match.breaks, match.first_breaker)
    size = math.prod(shape)
    play = _play_of(match, rack, size)
    if is_bounded(match):
        wins = _followed(play, np.zeros(size), math.inf)
    else:
        most = min(_LONGEST, max(1_000, _MOST_CELLS // max(size, 1)))
        wins = _followed(play, np.broadcast_to(never, shape).ravel() + tail, most)
    return Endings(*(wins[:, i].reshape(len(wins), *shape) for i in (0, 1)))


@dataclass(frozen=True)
class _Play:
    """The states of a match as arrays: what a won and a lost rack do to the mass on them."""

    won: csr_array
    lost: csr_array
    p_won: NDArray[np.float64]
    p_lost: NDArray[np.float64]
    alive: int


def _play_of(match: Match, rack: Rack, size: int) -> _Play:
    even = Rack(0.5, 0.5) if rack.break_matters else Rack(0.5)
    template = with_rack(match, even)
    after: dict[Any, list[Any]] = {}
    queue = [template.start]
    for state in queue:
        if state not in after:
            after[state] = list(template.moves(state))
            queue.extend(after[state])
    alive = [state for state, targets in after.items() if targets]
    row = {state: i for i, state in enumerate(alive)}
    # The two rows after the states that go on collect the wins of player 1 and of player 2.
    row |= {
        state: len(alive) + (template.winner(state) == 2) for state in after if state not in row
    }
    ones, columns = np.ones(len(alive)), np.arange(len(alive))
    shape = (len(alive) + 2, len(alive))
    # A state's moves are listed with the one that player 1 wins first.
    won, lost = (
        csr_array((ones, ([row[after[state][i]] for state in alive], columns)), shape=shape)
        for i in (0, 1)
    )
    breakers = [_breaker(state) if rack.break_matters else 1 for state in alive]
    chance = {
        (player, breaker): np.broadcast_to(np.ravel(rack.chance(player, breaker)), (size,))
        for player in (1, 2)
        for breaker in set(breakers)
    }
    p_won, p_lost = (
        np.array([chance[player, breaker] for breaker in breakers]) for player in (1, 2)
    )
    return _Play(won, lost, p_won, p_lost, len(alive))


def _breaker(state: Any) -> int:
    return _breaker(state[-1]) if isinstance(state[-1], tuple) else int(state[-1])


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
