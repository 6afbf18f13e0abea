"""The transient part of a chain, and the two solves from which all else is made.

With T the arcs among the transient states (T[i, j] = P(j -> i)):

- visits: x = (I - T)^-1 b, the expected number of visits to each state from the density b;
- values: y = (I - T)^-T r, the expected sum of r over all visits, from each state.

Both are free of subtraction for nonnegative b and r. A right-hand side with both signs is
to be split in its positive and its negative part by who asks.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from evenbreak.chains.elimination import Elimination

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Arcs

__all__ = ["TransientPart"]


class TransientPart:
    """(I - T)^-1 for a set of states, from each of which the other states can be reached.

    Parameters
    ----------
    arcs
        the arcs of the whole chain.
    states
        positions of the states, increasing; shape (m,).
    """

    def __init__(self, arcs: Arcs, states: NDArray[np.intp]) -> None:
        self.states = states
        place = np.full(arcs.size, -1)
        place[states] = np.arange(len(states))
        source, target = place[arcs.sources], place[arcs.targets]
        leaves = (source >= 0) & (target < 0)
        stays = (source >= 0) & (target >= 0)
        leak = np.bincount(source[leaves], arcs.chances[leaves], len(states))
        rows: list[dict[int, float]] = [{} for _ in states]
        for j, i, chance in zip(
            source[stays].tolist(),
            target[stays].tolist(),
            arcs.chances[stays].tolist(),
            strict=True,
        ):
            rows[j][i] = chance
        self._factor = Elimination(rows, leak.tolist())

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-1 b for b >= 0 of shape (m,) or (m, k), in the order of `states`."""
        return self._columns(self._factor.visits, b)

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-T r for r >= 0 of shape (m,) or (m, k), in the order of `states`."""
        return self._columns(self._factor.values, r)

    def _columns(self, solve, b):  # type: ignore[no-untyped-def]
        b = np.asarray(b, dtype=float)
        if b.ndim == 1:
            return np.array(solve(b.tolist()))
        return np.array([solve(column) for column in b.T.tolist()]).reshape(b.T.shape).T
