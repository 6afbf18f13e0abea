"""Elimination for one large class, in the dense fronts of a nested dissection.

The states of a front are eliminated together in a dense array (see `dense_elimination`); what
is left of the front is added to the front of the first state that remains.

References: Liu 1992, "The multifrontal method for sparse matrix solution".
"""

from __future__ import annotations

from bisect import bisect_right
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.chains.arcs import put_back
from evenbreak.chains.dense_elimination import less, solved, split

if TYPE_CHECKING:
    from collections.abc import Iterator

    from scipy.sparse import csc_array

    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Places
    from evenbreak.chains.dense_elimination import Factors
    from evenbreak.chains.dissection import Front


class FrontElimination:
    """(I - T) factored, for one class of states.

    Parameters
    ----------
    T
        sparse, shape (m, m): T[i, j] is the arc from j to i; no diagonal.
    leak
        shape (m,): the probability of leaving the class, given the state; not all zero.
    order, fronts
        the order of elimination, and its fronts (see `dissection`).
    """

    def __init__(self, T: csc_array, leak: Floats, order: Places, fronts: list[Front]) -> None:
        self._order = order
        self._steps: list[tuple[Front, Factors]] = []
        arcs = _arcs_by_front(T, order, fronts)
        leak = leak[order]
        ends = [front.last for front in fronts]
        place = np.empty(len(order), dtype=np.intp)  # in the front at hand
        rests: list[list[tuple[Places, Floats]]] = [[] for _ in fronts]
        for number, (front, (sources, targets, chances)) in enumerate(
            zip(fronts, arcs, strict=True)
        ):
            first, last, later = front
            size = last - first
            place[first:last] = np.arange(size)
            place[later] = np.arange(size, size + len(later))
            A = np.zeros((size + len(later) + 1, size + len(later)), order="F")
            A[place[targets], place[sources]] = -chances
            A[-1, :size] = -leak[first:last]
            for states, rest in rests[number]:
                at = place[states]
                A.T[at[:, None], np.append(at, len(A) - 1)] += rest.T
            rests[number].clear()
            factors, rest = split(A, size)
            self._steps.append((front, factors))
            if len(later):
                rests[bisect_right(ends, later[0])].append((later, rest))
        pivots = np.concatenate([factors.block.diagonal() for _, factors in self._steps])
        self.pivots = put_back(pivots, order)

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._solved(b, transposed=False)

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._solved(r, transposed=True)

    def _solved(self, b: Floats, *, transposed: bool) -> Floats:
        x = b[self._order]
        near, far = ("U", "L") if transposed else ("L", "U")
        steps = [
            (front, block, *((back, onward[:, :-1]) if transposed else (onward[:, :-1], back)))
            for front, (block, onward, back) in self._steps
        ]
        for (first, last, later), block, on, _ in steps:
            x[first:last] = solved(block, x[first:last], near, transposed=transposed)
            x[later] = less(x[later], on, x[first:last], transposed=True)
        for (first, last, later), block, _, back in reversed(steps):
            right = less(x[first:last], back, x[later])
            x[first:last] = solved(block, right, far, transposed=transposed)
        return put_back(x, self._order)


def _arcs_by_front(
    T: csc_array, order: Places, fronts: list[Front]
) -> Iterator[tuple[Places, Places, Floats]]:
    """Yield, for each front, its arcs that no earlier front has: sources, targets, chances."""
    arcs = T.tocoo()
    rank = np.empty(len(order), dtype=np.intp)
    rank[order] = np.arange(len(order))
    sources, targets = rank[arcs.col], rank[arcs.row]
    ends = [front.last for front in fronts]
    home = np.searchsorted(ends, np.minimum(sources, targets), side="right")
    by_front = np.argsort(home, kind="stable")
    sources, targets, chances = sources[by_front], targets[by_front], arcs.data[by_front]
    marks = np.append(0, np.cumsum(np.bincount(home, minlength=len(fronts)))).tolist()
    for begin, end in pairwise(marks):
        yield sources[begin:end], targets[begin:end], chances[begin:end]
