"""When a match ends, for matches that may take very many racks.

The chain of racks is squared again and again, so 2^j racks cost j products. Each row,
chance of having ended included, is scaled to sum to 1 after every product: rounding
then cannot add up to an end that is not there, and chances of ending, which are only
ever added, keep their relative accuracy.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

MOST_STATES = 1_000
"""Beyond this many states the dense products take longer than playing rack by rack."""

_TIE = 1e-12


def quantiles_by_doubling(
    moves: Mapping[Any, Sequence[tuple[Any, float]]], start: Any, levels: Sequence[float]
) -> list[int]:
    """Return the smallest k with P(ended within k racks) >= q, for each level q.

    Parameters
    ----------
    moves
        for every state that can be reached from `start`, the next states with their
        chances; none for final states.
    start
        the state before the first rack.
    levels
        chances that are reached after a finite number of racks.

    >>> moves = {"on": [("on", 0.9), ("over", 0.1)], "over": []}
    >>> quantiles_by_doubling(moves, "on", [0.1, 0.5])
    [1, 7]
    """
    import numpy as np

    alive = [state for state, arcs in moves.items() if arcs]
    at = {state: i for i, state in enumerate(alive)}
    stay = np.zeros((len(alive), len(alive)))
    end = np.zeros(len(alive))
    for state in alive:
        for target, chance in moves[state]:
            if target in at:
                stay[at[state], at[target]] += chance
            else:
                end[at[state]] += chance
    first = at[start]
    powers = [(stay, end)]
    while end[first] < max(levels) * (1.0 - _TIE):
        end = end + stay @ end
        stay = stay @ stay
        total = stay.sum(axis=1) + end
        stay, end = stay / total[:, np.newaxis], end / total
        powers.append((stay, end))
    return [_descend(powers, np.eye(len(alive))[first], q) for q in levels]


def _descend(powers: list[Any], density: Any, q: float) -> int:
    """Return one more than the most racks within which the match has not ended with chance q."""
    racks, ended = 0, 0.0
    for j in range(len(powers) - 1, -1, -1):
        stay, end = powers[j]
        then = ended + float(density @ end)
        if then < q * (1.0 - _TIE):
            racks, ended, density = racks + 2**j, then, density @ stay
    return racks + 1
