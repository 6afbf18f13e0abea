"""How long a match takes, played rack by rack in plain numbers, all its courses at once."""

from __future__ import annotations

import math
from typing import Any

from evenbreak.games.match import Match
from evenbreak.matches.quantiles import quantile_of

_ROUNDING = 1e-9
_PATIENCE = 200_000
"""Moves of mass after which numpy is loaded to go on with."""

_Moves = dict[Any, list[tuple[Any, float]]]


def length_quantiles(match: Match, ends: float, levels: tuple[float, ...]) -> list[int | None]:
    """Return the least number of racks within which `match` ends with each chance in `levels`.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets, with plain numbers as chances.
    ends
        P(the match ends at all).
    levels
        the chances, rising.

    Returns
    -------
    list of int or None
        None where the match never ends with that chance, or only after more than
        100,000 racks of a match with more than 1,000 states.

    >>> from evenbreak.games import Ahead, Rack
    >>> length_quantiles(Ahead(2, 2, Rack(0.5)), 1.0, (0.5, 0.9))
    [2, 8]
    """
    wanted = [q for q in levels if q <= ends * (1.0 + _ROUNDING)]
    play = _Play(match)
    while wanted and play.ended < wanted[-1] * (1.0 + _ROUNDING) and play.mass:
        play.one_rack()
        if play.steps > _PATIENCE:
            found = _by_way_of_numpy(match, play.moves, wanted)
            return found + [None] * (len(levels) - len(found))
    beyond = max(0.0, 1.0 - play.ended)
    return [quantile_of(play.chances, q, beyond=beyond) if q in wanted else None for q in levels]


def _by_way_of_numpy(match: Match, moves: _Moves, levels: list[float]) -> list[int | None]:
    from evenbreak.matches.length import match_length
    from evenbreak.matches.slow_ends import MOST_STATES, quantiles_by_doubling

    if len(moves) <= MOST_STATES:
        return list(quantiles_by_doubling(moves, match.start, levels))
    length = match_length(match, tail=0.5 * (1.0 - levels[-1]))
    reached = 1.0 - length.p_never_ends - length.tail_mass
    return [length.quantile(q) if q <= reached else None for q in levels]


class _Play:
    """The mass in each state that is not over, and the chance of each length so far."""

    def __init__(self, match: Match) -> None:
        self.moves: _Moves = _all_moves(match)
        self.mass: dict[Any, float] = {}
        self.chances: list[float] = []
        self.ended = 0.0
        self.steps = 0
        self._settle({match.start: 1.0})

    def one_rack(self) -> None:
        """Move the mass on by one rack; what is over is taken off."""
        after: dict[Any, float] = {}
        for state, held in self.mass.items():
            for target, chance in self.moves[state]:
                after[target] = after.get(target, 0.0) + held * chance
        self.steps += len(self.mass)
        self._settle(after)

    def _settle(self, mass: dict[Any, float]) -> None:
        self.mass = {state: held for state, held in mass.items() if self.moves[state]}
        over = math.fsum(held for state, held in mass.items() if not self.moves[state])
        self.chances.append(over)
        self.ended += over


def _all_moves(match: Match) -> _Moves:
    moves: _Moves = {}
    queue = [match.start]
    for state in queue:
        if state not in moves:
            moves[state] = list(match.moves(state).items())
            queue.extend(target for target, _ in moves[state])
    return moves
