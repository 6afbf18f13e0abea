"""Nested dissection: an elimination order that creates few arcs, and its dense fronts.

A few states that cut a graph in two (a separator) are eliminated after the states on both sides,
and each side is cut again in the same way until it is small. States that are eliminated together
make a front; eliminating them changes only arcs among themselves and a few later states.

The cuts follow a breadth-first order of the states. If the states before place c form one
side, then the states from c on that have a neighbor before c separate it from the others; among the
places near the middle, the one with the fewest such states is chosen. On a square grid of n states
the factors then have O(n log n) entries and take O(n^1.5) operations.

The states of a front are eliminated together in a dense array (see `dense_elimination`); the
remainder of the front is added to the front of the first state that remains.

References: George 1973, "Nested dissection of a regular finite element mesh"; George and Liu 1981,
Computer Solution of Large Sparse Positive Definite Systems, chapters 7 and 8; Liu 1992, "The
multifrontal method for sparse matrix solution".
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np
from scipy.sparse import csc_array, csgraph, eye_array

from evenbreak.arrays import Floats
from evenbreak.chains.arcs import Places, put_back
from evenbreak.chains.dense_elimination import Factors, less, solved, split

_LEAF = 96
"""Number of states below which a part is not cut again."""
_MIDDLE = 0.25
"""Minimum share of the states on each side of a cut, separator included."""
_WIDEST = 0.5
"""A part is not cut if its separator would hold more than this share of the part."""


class Front(NamedTuple):
    """States that are eliminated together, by their places in the elimination order.

    `first` to `last` - 1 are the states, and `later` the later states that they have arcs to or
    from when they are eliminated, increasing. Arcs created among these are added to the front of
    the first of them.
    """

    first: int
    last: int
    later: Places

    @property
    def entries(self) -> int:
        """The number of entries in its factors."""
        return (self.last - self.first) * (self.last - self.first + 2 * len(self.later))

    @property
    def work(self) -> float:
        """The approximate number of multiplications in its elimination."""
        size = self.last - self.first
        return float(size * (size + len(self.later)) ** 2)


def neighbors(T: csc_array) -> csc_array:
    """Return which states are joined by an arc either way, and each with itself; entries are 1."""
    graph = csc_array(T + T.T + eye_array(T.shape[0], format="csc"))
    graph.data = np.ones(graph.nnz, dtype=np.int8)
    return graph


def bandwidth(graph: csc_array) -> int:
    """Return the largest distance between `neighbors` when the states are put in a good order.

    >>> bandwidth(neighbors(csc_array([[0.0, 0.5, 0.5], [0.5, 0.0, 0.0], [0.5, 0.0, 0.0]])))
    1
    """
    order = csgraph.reverse_cuthill_mckee(graph, symmetric_mode=True)
    place = np.empty(len(order), dtype=np.intp)
    place[order] = np.arange(len(order))
    source = np.repeat(place, np.diff(graph.indptr))
    return int(np.abs(place[graph.indices] - source).max(initial=0))


def dissect(graph: csc_array) -> tuple[Places, list[Front]]:
    """Return the states in elimination order, and the fronts in this order.

    The graph has the `neighbors` among the states.

    >>> path = csc_array([[0.0, 0.5, 0.0], [1.0, 0.0, 1.0], [0.0, 0.5, 0.0]])
    >>> dissect(neighbors(path))[1]
    [Front(first=0, last=3, later=array([], dtype=int32))]
    """
    groups = [*_groups(graph)][::-1]
    order = np.concatenate(groups)
    graph = csc_array(graph[:, order][order])
    ends = [*accumulate(len(group) for group in groups)]
    inherited: list[list[Places]] = [[] for _ in groups]
    fronts: list[Front] = []
    for number, (first, last) in enumerate(pairwise([0, *ends])):
        own = graph.indices[graph.indptr[first] : graph.indptr[last]]
        touched = np.concatenate([own, *inherited[number]])
        later = np.unique(touched[touched >= last])
        if len(later):
            inherited[bisect_right(ends, later[0])].append(later)
        front = Front(first, last, later)
        while fronts and _better_together(fronts[-1], front):
            front = Front(fronts.pop().first, last, later)
        fronts.append(front)
    return order, fronts


def _better_together(front: Front, following: Front) -> bool:
    """Whether one front for both would hold no more entries, as when all states are joined."""
    if not len(front.later) or front.later[0] >= following.last:
        return False
    together = Front(front.first, following.last, following.later)
    return together.entries <= front.entries + following.entries


def _groups(graph: csc_array) -> Iterator[Places]:
    """Yield the states of each front, separators before the parts that they separate.

    All parts are cut at once, so that there are only as many rounds as there are levels.
    """
    states = np.arange(graph.shape[0])
    part = np.zeros(len(states), dtype=np.intp)
    while len(states):
        order = csgraph.reverse_cuthill_mckee(graph, symmetric_mode=True)
        order = order[np.argsort(part[order], kind="stable")]
        place = np.empty(len(order), dtype=np.intp)
        place[order] = np.arange(len(order))
        earliest = np.minimum.reduceat(place[graph.indices], graph.indptr[:-1])[order]
        crossing = _crossing(earliest)
        bounds = np.append(0, np.cumsum(np.bincount(part))).tolist()
        part = np.full(len(order), -1)
        parts = 0
        for begin, end in pairwise(bounds):
            cut = _cut(crossing, begin, end)
            if cut is None:
                yield states[order[begin:end]]
                continue
            part[begin:cut], part[cut:end] = parts, parts + 1
            parts += 2
            separator = cut + np.flatnonzero(earliest[cut:end] < cut)
            if len(separator):
                part[separator] = -1
                yield states[order[separator]]
        left = part >= 0
        kept, part = order[left], part[left]
        states = states[kept]
        graph = csc_array(graph[:, kept][kept])


def _crossing(earliest: Places) -> Places:
    """Return how many states from each place on have a neighbor before it.

    `earliest` is the place of the first neighbor of the state in each place, or the state's own
    place if that is earlier.
    """
    size = len(earliest)
    return np.cumsum(np.bincount(earliest + 1, minlength=size + 1)[:size]) - np.arange(size)


def _cut(crossing: Places, begin: int, end: int) -> int | None:
    """Return where to cut the part from `begin` to `end`, or None if it is best left uncut."""
    size = end - begin
    if size <= _LEAF:
        return None
    margin = max(int(_MIDDLE * size), 1)
    cut = begin + margin + int(np.argmin(crossing[begin + margin : end - margin]))
    return None if crossing[cut] > _WIDEST * size else cut


class FrontElimination:
    """(I - T) factored, for one class of states; for order and fronts see `dissection`.

    T is sparse, shape (m, m): T[i, j] is the arc from j to i; no diagonal. `leak`, not all zero, is
    the probability of leaving the class, given the state.
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
    """Yield, for each front, the arcs that no earlier front has: sources, targets, chances."""
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
