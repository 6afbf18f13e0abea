"""Elimination for one class of some thousand states, in blocks along a band or all at once.

The states are put in an order in which arcs join states near each other (reverse
Cuthill-McKee), so that eliminating a state touches only a window of the matrix. Within a
window a panel of columns is eliminated state by state, and the rest of the window is then
updated by one matrix product:

    W[i, j] += sum over k in the panel of W[i, k] W[k, j] / d[k].

All that is added is nonnegative and the pivots d are sums of arcs, so the order of the
additions does not matter: each entry is as accurate as in the elimination of Grassmann,
Taksar and Heyman, at the speed of BLAS. With bandwidth w, time is O(n w^2) and memory
O(n w); a class without a band has w = n.

References: Grassmann, Taksar and Heyman 1985; Alfa, Xue and Ye 2002; George and Liu 1981,
Computer Solution of Large Sparse Positive Definite Systems, chapter 4 (the ordering).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from scipy.linalg.blas import dgemm, dtrsm
from scipy.sparse import csc_array, csgraph

from evenbreak.chains.arcs import put_back

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places

_PANEL = 96
# BLAS does not spread smaller products over threads; for small windows waking the threads
# would cost more than the work.
_NARROW, _UNTHREADED = 256, 2**18
_STEP = 512


class _Window(NamedTuple):
    """States first..last, which are eliminated together, and their arcs to later states."""

    first: int
    last: int
    factor: NDArray[np.float64]
    onward: NDArray[np.float64]
    back: NDArray[np.float64]


def band_order(T: csc_array) -> tuple[Places, int]:
    """Return an order of the states with a narrow band, and the width of the band."""
    order = csgraph.reverse_cuthill_mckee(csc_array(T + T.T), symmetric_mode=True)
    place = np.empty(len(order), dtype=np.intp)
    place[order] = np.arange(len(order))
    source = np.repeat(place, np.diff(T.indptr))
    return order, int(np.abs(place[T.indices] - source).max(initial=0))


class BandedElimination:
    """(I - T) factored, for one class of states.

    Parameters
    ----------
    T
        sparse, shape (m, m): T[i, j] is the arc from j to i; no diagonal.
    leak
        shape (m,): the probability of leaving the class, given the state; not all zero.
    order, width
        the order of elimination, and the largest distance of an arc in it.
    """

    def __init__(self, T: csc_array, leak: NDArray[np.float64], order: Places, width: int) -> None:
        n = len(order)
        self._order = order
        self._windows: list[_Window] = []
        T = csc_array(T[:, order])[order]
        step = max(min(width, _STEP), _PANEL)
        pivots = np.empty(n)
        left = np.zeros((0, 0))
        leaks = leak[order]
        for first in range(0, n, step):
            last = min(first + step, n)
            end = min(last + width, n)
            W = np.zeros((end - first + 1, end - first), order="F")
            W[:-1] = T[first:end, first:end].toarray()
            W[-1] = leaks[first:end]
            known = len(left) - 1
            if known > 0:
                # What earlier windows have added, leaks included.
                W[:known, :known] = left[:-1]
                W[-1, :known] = left[-1]
            size = last - first
            _eliminate(W, size, pivots[first:last])
            factor = np.asfortranarray(-W[:size, :size])
            np.fill_diagonal(factor, pivots[first:last])
            onward = np.asfortranarray(W[size:-1, :size])
            back = np.asfortranarray(W[:size, size:])
            left = W[size:, size:].copy()
            self._windows.append(_Window(first, last, factor, onward, back))
        self.pivots = put_back(pivots, order)

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        x = b[self._order]
        for first, last, factor, onward, _ in self._windows:
            x[first:last] = _solve(factor, x[first:last], "pivots")
            x[last : last + len(onward)] += onward @ x[first:last]
        for first, last, factor, onward, back in reversed(self._windows):
            top = x[first:last] + back @ x[last : last + len(onward)]
            x[first:last] = _solve(factor, top, "units")
        return put_back(x, self._order)

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        y = r[self._order]
        for first, last, factor, onward, back in self._windows:
            y[first:last] = _solve(factor, y[first:last], "units", trans=1)
            y[last : last + len(onward)] += back.T @ y[first:last]
        for first, last, factor, onward, _ in reversed(self._windows):
            top = y[first:last] + onward.T @ y[last : last + len(onward)]
            y[first:last] = _solve(factor, top, "pivots", trans=1)
        return put_back(y, self._order)


def _solve(
    factor: NDArray[np.float64],
    b: NDArray[np.float64],
    part: str,
    trans: Literal[0, 1] = 0,
) -> NDArray[np.float64]:
    """Solve with the lower part (pivots on its diagonal) or the upper (ones on it).

    Entries off the diagonal are negative and b is not, so nothing is subtracted.
    """
    lower = part == "pivots"
    x: NDArray[np.float64] = dtrsm(1.0, factor, b, lower=lower, trans_a=trans, diag=not lower)
    return x


def _eliminate(W: NDArray[np.float64], count: int, pivots: NDArray[np.float64]) -> None:
    """Eliminate the first `count` states of a window in place.

    W[i, j] is the arc from j to i; the last row is the leak. Afterwards the columns of the
    eliminated states hold their arcs to later states, and their rows the arcs from later
    states divided by the pivot; the rest is the window without the eliminated states.
    """
    narrow = len(W) <= _NARROW
    panel = max(_UNTHREADED // W.size, 4) if narrow else _PANEL
    for first in range(0, count, panel):
        last = min(first + panel, count)
        _eliminate_panel(W, first, last, W.shape[1] if narrow else last, pivots)
        if last == W.shape[1]:
            return
        if narrow:
            W[last:, last:] += W[last:, first:last] @ W[first:last, last:]
            continue
        top = -W[first:last, first:last]
        np.fill_diagonal(top, pivots[first:last])
        rows = dtrsm(1.0, top, W[first:last, last:], lower=True)
        W[first:last, last:] = rows
        columns = W[:, first:last].copy(order="F")
        columns[:last] = 0.0
        # Whole columns of W are contiguous in memory, so BLAS can add to them in place.
        dgemm(1.0, columns, rows, beta=1.0, c=W[:, last:], overwrite_c=True)


def _eliminate_panel(
    W: NDArray[np.float64], first: int, last: int, width: int, pivots: NDArray[np.float64]
) -> None:
    """Eliminate the states first..last, updating only their own rows, up to `width`."""
    rows = W[:last]
    for k in range(first, last):
        # The column below the panel is updated only now, by one product.
        below = W[last:, k]
        below += W[last:, first:k] @ W[first:k, k]
        pivots[k] = rows[k + 1 :, k].sum() + below.sum()
        row = rows[k, k + 1 : width]
        row /= pivots[k]
        rows[k + 1 :, k + 1 : width] += np.outer(rows[k + 1 :, k], row)
