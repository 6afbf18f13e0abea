"""After how many racks a match ends, and who wins it.

Races of racks are solved on antidiagonals. Every other match is played rack by rack over all its
states at once: from each state, a rack leads to one of two states, depending on who wins it.

All scores i : k - i of a race that are possible after k racks lie on an antidiagonal of the score
table. Its probabilities, one row for each breaker, move to the next antidiagonal by two products
with a slice: a rack that player 1 wins shifts the row by one, a rack that player 2 wins leaves it
in place.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array

from evenbreak.arrays import Floats
from evenbreak.games.breaks import BreakFormat
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.parameters import rack_in
from evenbreak.matches.rack_by_rack import rack_moves

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

    p1, p2 and `never`, P(the match never ends), have the same shape. A match without a longest
    length is followed until P(it is still going on, but will end) is at most `tail`, for at most
    100,000 racks, or fewer if the parameters would not fit in memory.
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
    pair of parameters, but for at most `most` racks.
    """
    moves = rack_moves(match)
    row = {state: i for i, state in enumerate(moves)}
    alive, size, columns = len(moves), enough.size, np.arange(len(moves))

    def place(state: Any) -> int:
        """Return a state's row; wins by player 1 and player 2 are collected in the last two."""
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


# Parameters are taken in blocks small enough for the processor's cache.
_BLOCK = 1 << 16


class Endings(NamedTuple):
    """P(player 1, 2 wins after exactly k racks): arrays of shape (racks + 1, *parameters)."""

    win_1: Floats
    win_2: Floats


def race_endings(
    need_1: int, need_2: int, rack: Rack, breaks: BreakFormat | None, first_breaker: int
) -> Endings:
    """Return who wins a race, and after how many racks.

    The chances may be arrays, which are broadcast together; `breaks` is needed if the break
    matters.

    Source: problems P5.5 and P5.24.

    >>> endings = race_endings(2, 1, Rack(0.5), None, 1)
    >>> endings.win_1.tolist(), endings.win_2.tolist()
    ([0.0, 0.0, 0.25], [0.0, 0.5, 0.25])
    """
    shape = rack.shape
    kinds, chances = _kinds(rack, breaks if rack.break_matters else None, shape)
    first = first_breaker - 1 if rack.break_matters else 0
    ends = np.zeros((2, need_1 + need_2, chances.shape[2]))
    block = max(1, _BLOCK // (need_1 * len(kinds)))
    for at in range(0, chances.shape[2], block):
        part = slice(at, at + block)
        _play(need_1, first, kinds, chances[:, :, part], ends[:, :, part])
    win_1, win_2 = ends.reshape(2, need_1 + need_2, *shape)
    return Endings(win_1, win_2)


def _kinds(
    rack: Rack, breaks: BreakFormat | None, shape: tuple[int, ...]
) -> tuple[list[tuple[int, int]], Floats]:
    """Return the outcomes of a rack as (winner, row of the next breaker), losses first.

    The array holds the probability of each outcome, by row of the breaker and by parameter.
    """
    chance: dict[tuple[int, int], Floats] = {}
    rows = 2 if breaks is not None else 1
    for breaker in range(1, rows + 1):
        for winner in (2, 1):
            kind = (winner, breaks(breaker, winner) - 1 if breaks is not None else 0)
            by_row = chance.setdefault(kind, np.zeros((rows, int(np.prod(shape)))))
            by_row[breaker - 1] = np.broadcast_to(rack.chance(winner, breaker), shape).ravel()
    for row in range(rows):
        # Every row must be written at every rack, or it would keep the scores of an earlier one.
        if not any(after == row for _, after in chance):
            chance[2, row] = np.zeros((rows, int(np.prod(shape))))
    kinds = sorted(chance, reverse=True)
    return kinds, np.array([chance[kind] for kind in kinds])


def _play(
    need_1: int,
    first: int,
    kinds: list[tuple[int, int]],
    chances: Floats,
    ends: Floats,
) -> None:
    """Fill `ends` for one block of parameters."""
    _, rows, size = chances.shape
    need_2 = ends.shape[1] - need_1
    mass = np.zeros((rows, need_1, size))
    mass[first, 0] = 1.0
    leaving = np.zeros((2, ends.shape[1], len(kinds), size))
    if size == 1:
        # One product of small matrices replaces several array operations.
        mass, chances, leaving = mass[:, :, 0], chances[:, :, 0].copy(), leaving[:, :, :, 0]
    written = [any(after == row for _, after in kinds[:i]) for i, (_, row) in enumerate(kinds)]
    for k in range(ends.shape[1] - 1):
        low, high = max(0, k - need_2 + 1), min(k, need_1 - 1) + 1
        here = mass[:, low:high]
        moved = chances @ here if size == 1 else _move(chances, here)
        for (winner, row), part, again in zip(kinds, moved, written, strict=True):
            if winner == 2:
                mass[row, low:high] = part
            elif again:
                mass[row, low + 1 : high + 1] += part[: need_1 - low - 1]
            else:
                mass[row, low] = 0.0
                mass[row, low + 1 : high + 1] = part[: need_1 - low - 1]
        if high == need_1:
            leaving[0, k + 1] = moved[:, -1]
        if k >= need_2 - 1:
            leaving[1, k + 1] = moved[:, 0]
    for i, (winner, _) in enumerate(kinds):
        ends[winner - 1] += leaving[winner - 1, :, i].reshape(ends.shape[1:])


def _move(chances: Floats, mass: Floats) -> Floats:
    moved = np.zeros((len(chances), *mass.shape[1:]))
    for kind, row in zip(*np.nonzero(chances.any(axis=2)), strict=True):
        moved[kind] += chances[kind, row] * mass[row]
    return moved
