"""The answers of a chain in fractions.

A chance given as a `Fraction` or as text is taken as it is, and a float as the decimal that it
prints: 0.6 is 3/5. A state whose self-loop is listed stays with what its other arcs leave over;
the arcs of every other state must sum to exactly 1.

States with few arcs are eliminated. Where many arcs are left, the fractions would grow with every
step, so what remains is solved modulo a prime (see `lifting`).

Reference: Kemeny and Snell 1960, Finite Markov Chains, chapter III.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from evenbreak.chains.arcs import reachable
from evenbreak.chains.elimination import eliminated, limit_in, masses_in, rows_of
from evenbreak.chains.lifting import Lifting, whole_numbers
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.arrays import Bools
    from evenbreak.chains.chain import Chain
    from evenbreak.chains.elimination import Elimination, Rows

_FILL = 8
"""States are eliminated in fractions as long as that makes no more than so many arcs a state."""


class ExactPassage(NamedTuple):
    """How many steps it takes to reach a target, in fractions.

    Parameters
    ----------
    p_reached, p_never
        the chances that the target is reached, and that it never is.
    mean_if_reached, variance_if_reached
        of the number of steps, given that the target is reached; None if it cannot be.
    """

    p_reached: Fraction
    p_never: Fraction
    mean_if_reached: Fraction | None
    variance_if_reached: Fraction | None


def exact_limit(chain: Chain, start: Any) -> dict[Any, Fraction]:
    """Return the stochastic limit of each state.

    >>> from evenbreak.chains import chain_of
    >>> exact_limit(chain_of([("rain", "sun", "1/3"), ("rain", "rain", "2/3"), ("sun", "rain", 1)],
    ...                      start="sun"), None)
    {'rain': Fraction(3, 4), 'sun': Fraction(1, 4)}
    """
    rows, v = exact_rows(chain), exact_start(chain, start)
    limit = limit_in(chain.structure, rows, v, _visits)
    return {state: Fraction(limit.get(k, 0)) for k, state in enumerate(chain.states)}


def exact_absorption(chain: Chain, start: Any) -> NDArray[np.object_]:
    """Return the probability of ending in each class, given the start."""
    rows, v = exact_rows(chain), exact_start(chain, start)
    masses = masses_in(chain.structure, rows, v, _visits)
    return np.array([Fraction(masses.get(k, 0)) for k in range(chain.structure.count)], object)


def exact_passage(chain: Chain, start: Any, ends: Bools) -> ExactPassage:
    """Return how many steps it takes to reach one of the `ends`.

    With u the expected steps on the paths that reach them and w the expected sum of u, the
    second moment is 2 w - u.
    """
    rows, v = exact_rows(chain), exact_start(chain, start)
    arcs = chain.arcs
    hopeful = reachable(len(chain), arcs.targets, arcs.sources, ends) & ~ends
    states = np.flatnonzero(hopeful).tolist()
    factor = _factor(rows, states)
    hope = factor.values([sum(p for i, p in rows[j].items() if ends[i]) for j in states])
    steps = factor.values(hope)
    squares = factor.values(steps)
    begun = [v.get(j, Fraction(0)) for j in states]
    reached = sum((x for j, x in v.items() if ends[j]), _dot(begun, hope))
    mean = variance = None
    if reached:
        mean = _dot(begun, steps) / reached
        variance = 2 * _dot(begun, squares) / reached - mean - mean**2
    return ExactPassage(reached, 1 - reached, mean, variance)


def exact_chance(value: Any) -> Fraction:
    """Return a number as a fraction: a float as the decimal that it prints.

    >>> exact_chance(0.6), exact_chance("0.6"), exact_chance(Fraction(2, 3))
    (Fraction(3, 5), Fraction(3, 5), Fraction(2, 3))
    """
    return Fraction(repr(float(value)) if isinstance(value, float) else value)


def exact_rows(chain: Chain) -> Rows:
    """Return the arcs between different states, by source.

    Raises
    ------
    ChainError
        if the arcs of a state without a self-loop do not sum to exactly 1, or those of a state
        with one sum to more.
    """
    rows: Rows = [
        {i: chain.given.get((j, i)) or exact_chance(p) for i, p in row.items()}
        for j, row in enumerate(rows_of(chain.arcs))
    ]
    loops = (chain.matrix.diagonal() > 0.0).tolist()
    for state, row, loop in zip(chain.states, rows, loops, strict=True):
        numerators, whole = whole_numbers(row.values())
        total = Fraction(sum(numerators), whole)
        if total > 1 or (total < 1 and not loop):
            raise ChainError(
                f"the arcs out of state {state!r} sum to {_shown(total)}, not to exactly 1; for an "
                "exact answer give them as fractions, or as decimals that sum to 1"
            )
    return rows


def exact_start(chain: Chain, start: Any) -> dict[int, Fraction]:
    """Return the start as a density: the probability of each position that has one."""
    at = chain.start_index(start)
    if at is not None:
        return {at: Fraction(1)}
    chain.density(start)  # refuses what is no density
    given = start.items() if isinstance(start, Mapping) else zip(chain.states, start, strict=True)
    density = {chain.index(state): exact_chance(p) for state, p in given if p}
    if sum(density.values()) != 1:
        raise ChainError(
            f"the start density sums to {_shown(sum(density.values()))}, not to exactly 1; for an "
            "exact answer give it as fractions, or as decimals that sum to 1"
        )
    return density


def _visits(rows: Rows, states: Sequence[int], b: list[Any]) -> list[Any]:
    return _factor(rows, states).visits(b)


def _factor(rows: Rows, states: Sequence[int]) -> Elimination:
    """Return I - T factored, with T the arcs among the states."""
    return eliminated(rows, states, _FILL * len(states), Lifting)


def _dot(x: Sequence[Fraction], y: Sequence[Fraction]) -> Fraction:
    return sum((a * b for a, b in zip(x, y, strict=True) if a), Fraction(0))


def _shown(total: Any) -> str:
    text = str(total)
    return text if len(text) <= 40 else f"1 {'+' if total > 1 else '-'} {abs(float(total - 1)):.2g}"
