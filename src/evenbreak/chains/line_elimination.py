"""Elimination for a class whose states stand in a line, every second state at a time.

No two states at odd places are neighbours, so all of them can be eliminated at once, in one
vector operation: with up[i] and down[i] the arcs out of state i and d[i] their sum and its
leak, the arc from i - 1 to i + 1 becomes up[i - 1] up[i] / d[i], and likewise down the line.
Half the states are left, again in a line; after log2(n) rounds one is. This is the
elimination of Grassmann, Taksar and Heyman (1985) in the order of cyclic reduction (Hockney
1965), and it subtracts nothing.

It works in the platform's extended precision. Where all arcs are equal, each round repeats
the rounding errors of the round before, which in doubles would show at n = 10,000; and arcs
between states far apart are smaller than any double. Where a long double is no wider than a
double (Windows, some ARM), lines are solved in another way (see `factorisation`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.sparse import csc_array, csgraph

from evenbreak.chains.arcs import put_back

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Places

    Wide = NDArray[np.longdouble]


class _Round(NamedTuple):
    """The states at odd places: their pivots, their arcs down and up, and arcs to them."""

    pivot: Wide
    out: tuple[Wide, Wide]
    into: tuple[Wide, Wide]


def line_order(T: csc_array) -> Places | None:
    """Return the order in which the states of a class stand in a line, or None.

    `T` holds the arcs within the class, without its diagonal.

    >>> line_order(csc_array([[0.0, 0.0, 0.5], [0.0, 0.0, 0.5], [1.0, 1.0, 0.0]]))
    array([0, 2, 1], dtype=int32)
    """
    size = T.shape[0]
    if T.nnz != 2 * (size - 1):
        return None
    ends = np.flatnonzero(np.diff(T.indptr) == 1)
    if len(ends) != 2:
        return None
    order = csgraph.breadth_first_order(T, ends[0], return_predecessors=False)
    place = np.empty(size, dtype=np.intp)
    place[order] = np.arange(size)
    sources = np.repeat(place, np.diff(T.indptr))
    return order if (np.abs(place[T.indices] - sources) == 1).all() else None


class LineElimination:
    """(I - T) factored, for a class whose states stand in a line.

    Parameters
    ----------
    T
        sparse, shape (m, m): T[i, j] is the arc from j to i; no diagonal.
    leak
        shape (m,): the probability to leave the line, given the state; not all zero.
    order
        the order of the states along the line.
    """

    def __init__(self, T: csc_array, leak: Floats, order: Places) -> None:
        self._order = order
        self._rounds: list[_Round] = []
        line = csc_array(T[:, order])[order]
        u = np.append(line.diagonal(-1), 0.0).astype(np.longdouble)
        d = np.concatenate(([0.0], line.diagonal(1))).astype(np.longdouble)
        leaks = leak[order].astype(np.longdouble)
        pivots = np.empty(len(leak))
        place = np.arange(len(leak))
        while len(leaks) > 1:
            pivot = u[1::2] + d[1::2] + leaks[1::2]
            share_up, share_down, share_leak = u[1::2] / pivot, d[1::2] / pivot, leaks[1::2] / pivot
            from_left, from_right = u[0::2][: len(pivot)], d[2::2]
            self._rounds.append(_Round(pivot, (d[1::2], u[1::2]), (from_left, from_right)))
            pivots[place[1::2]] = pivot
            inner = len(from_right)
            leaks = leaks[0::2].copy()
            leaks[: len(pivot)] += from_left * share_leak
            leaks[1 : inner + 1] += from_right * share_leak[:inner]
            u, d = np.zeros_like(leaks), np.zeros_like(leaks)
            u[: len(pivot)] = from_left * share_up
            d[1 : inner + 1] = from_right * share_down[:inner]
            place = place[0::2]
        self._last = leaks
        pivots[place] = leaks
        self.pivots = put_back(pivots, order)

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._solved(b, transposed=False)

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._solved(r, transposed=True)

    def _solved(self, b: Floats, *, transposed: bool) -> Floats:
        x = b[self._order].astype(np.longdouble)
        rounds = [(r.pivot, r.into, r.out) if transposed else r for r in self._rounds]
        waiting = []
        for pivot, (left, right), _ in rounds:
            odd, x = x[1::2] / pivot[:, None], x[0::2].copy()
            inner = len(x) - 1
            x[: len(pivot)] += odd * left[:, None]
            x[1:] += odd[:inner] * right[:inner, None]
            waiting.append(odd)
        x /= self._last[:, None]
        for (pivot, _, (left, right)), odd in zip(rounds[::-1], waiting[::-1], strict=True):
            inner = len(x) - 1
            more = x[: len(pivot)] * left[:, None]
            more[:inner] += x[1:] * right[:inner, None]
            even, x = x, np.empty((len(x) + len(odd), x.shape[1]), dtype=np.longdouble)
            x[0::2], x[1::2] = even, odd + more / pivot[:, None]
        return put_back(x.astype(np.float64), self._order)
