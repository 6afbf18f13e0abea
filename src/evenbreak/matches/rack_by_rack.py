"""A match rack by rack: its states, and within how many racks it ends from any of them.

P(the match is still going on after k + 1 racks), given the state now, is the mean of P(it is
still going on after k racks) over the states that the next rack leads to. Short matches are
calculated in plain Python, longer ones with a sparse matrix. For very long ones, the matrix of a
rack is squared repeatedly, so 2^j racks cost j products. After every product each row is scaled so
that it sums to 1 together with the probability of having ended; otherwise rounding errors would add
up and the match would seem to end.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import Any

from evenbreak.games.match import Match
from evenbreak.games.rack import Rack
from evenbreak.matches.parameters import rack_in, with_rack
from evenbreak.matches.quantiles import TIE

Moves = Mapping[Hashable, Sequence[tuple[Hashable, float]]]
_Arcs = list[list[tuple[int, float]]]

_PATIENCE = 100_000
"""Number of additions above which plain Python is slower than scipy, loading included."""
_LONGEST = 100_000
"""The most racks that are played one by one in a match with many states."""
_MOST_STATES = 1_000
"""Number of states above which dense products take longer than playing rack by rack."""
_MOST_DOUBLINGS = 1_100
"""Within 2^1100 racks, even an event as unlikely as the smallest float has happened."""


def racks_within(
    moves: Moves, asked: Sequence[tuple[Hashable, float]], never: Mapping[Hashable, float]
) -> list[int | None]:
    """Return the least k with P(the match is over within k racks) >= q, for each (state, q).

    States without `moves` are final; `never` is P(the match never ends), by state, 0 where not
    listed. None if the match never ends with that probability, or if it takes more than 100,000
    racks and has more than 1,000 states.

    >>> moves = {"on": [("on", 0.9), ("over", 0.1)]}
    >>> racks_within(moves, [("on", 0.1), ("on", 0.5), ("over", 0.9)], {})
    [1, 7, 0]
    """
    place = {state: k for k, state in enumerate(moves)}
    arcs = [
        [(place[target], chance) for target, chance in row if target in place]
        for row in moves.values()
    ]
    quantiles: list[int | None] = [None if state in place else 0 for state, _ in asked]
    allowed = [(1.0 - q) * (1.0 + TIE) for _, q in asked]
    wanted = {
        i: place[state]
        for i, (state, _) in enumerate(asked)
        if state in place and never.get(state, 0.0) <= allowed[i]
    }
    if not wanted:
        return quantiles
    for racks, left in enumerate(_still_going_on(arcs), 1):
        for i in [i for i, k in wanted.items() if left[k] <= allowed[i]]:
            quantiles[i] = racks
            del wanted[i]
        if not wanted:
            return quantiles
    if len(arcs) <= _MOST_STATES:
        levels = [(k, asked[i][1]) for i, k in wanted.items()]
        for i, many in zip(wanted, _by_doubling(arcs, moves, levels), strict=True):
            quantiles[i] = many
    return quantiles


def _still_going_on(arcs: _Arcs) -> Iterator[Any]:
    """Yield P(the match is still going on after k racks) for each state now, for k = 1, 2, ..."""
    left: Any = [1.0] * len(arcs)
    for _ in range(_PATIENCE // len(arcs)):
        left = [sum(chance * left[k] for k, chance in row) for row in arcs]
        yield left
    from scipy.sparse import csr_array

    rows, columns, chances = (
        zip(*flat, strict=True)
        if (flat := [(j, k, chance) for j, row in enumerate(arcs) for k, chance in row])
        else ((), (), ())
    )
    matrix = csr_array((chances, (rows, columns)), shape=(len(arcs), len(arcs)))
    for _ in range(_LONGEST // (10 if len(arcs) <= _MOST_STATES else 1)):
        left = matrix @ left
        yield left


def _by_doubling(
    arcs: _Arcs, moves: Moves, levels: Sequence[tuple[int, float]]
) -> list[int | None]:
    """Return the smallest number of racks for each (position of a state, probability)."""
    import numpy as np

    stay = np.zeros((len(arcs), len(arcs)))
    for j, row in enumerate(arcs):
        for k, chance in row:
            stay[j, k] += chance
    end = np.array([sum(p for target, p in row if target not in moves) for row in moves.values()])
    powers = [(stay, end)]
    while any(end[k] < q * (1.0 - TIE) for k, q in levels) and len(powers) < _MOST_DOUBLINGS:
        end = end + stay @ end
        stay = stay @ stay
        total = stay.sum(axis=1) + end
        stay, end = stay / total[:, np.newaxis], end / total
        powers.append((stay, end))
    unit = np.eye(len(arcs))
    return [
        _least_racks(powers, unit[k], q) if end[k] >= q * (1.0 - TIE) else None for k, q in levels
    ]


def _least_racks(powers: list[Any], density: Any, q: float) -> int:
    """Return the smallest number of racks within which the match ends with probability q."""
    racks, ended = 0, 0.0
    for j in range(len(powers) - 1, -1, -1):
        stay, end = powers[j]
        then = ended + float(density @ end)
        if then < q * (1.0 - TIE):
            racks, ended, density = racks + 2**j, then, density @ stay
    return racks + 1


RackMoves = dict[Any, tuple[tuple[Any, Any], tuple[Any, Any]]]


def rack_moves(match: Match, start: Any = None) -> RackMoves:
    """Return the next state and its chance for each winner of the next rack, by state.

    The entry for player 1 comes first. Both are listed, even with a chance of 0, since people win
    racks in which a model gives them no chance. States that are not listed are final.

    >>> from evenbreak.games import Race
    >>> rack_moves(Race(2, 1, Rack(0.75)))
    {(0, 0): (((1, 0), 0.75), ((0, 1), 0.25)), (1, 0): (((2, 0), 0.75), ((1, 1), 0.25))}
    """
    rack = rack_in(match)
    template = with_rack(match, Rack(0.5, 0.5) if rack.break_matters else Rack(0.5))
    chances = {breaker: (rack.chance(1, breaker), rack.chance(2, breaker)) for breaker in (1, 2)}
    moves: RackMoves = {}
    queue = [template.start if start is None else start]
    for state in queue:
        if state in moves or template.winner(state) is not None:
            continue
        # A state's moves are listed with the one that player 1 wins first.
        won, lost = template.moves(state)
        p_won, p_lost = chances[breaker_in(match, state)]
        moves[state] = (won, p_won), (lost, p_lost)
        queue += [won, lost]
    return moves


def breaker_in(match: Match, state: Any) -> int:
    """Return who breaks the next rack in a state; 1 if the break does not matter.

    >>> from evenbreak.games import Race, winner_breaks
    >>> breaker_in(Race(2, 1, Rack(0.6, 0.5), breaks=winner_breaks), (1, 0, 2))
    2
    """
    if not match.break_matters:
        return 1
    innermost = state[-1]
    return breaker_in(match, innermost) if isinstance(innermost, tuple) else int(innermost)
