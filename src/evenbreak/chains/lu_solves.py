"""Solves with I - T by LU with pivoting, and a bound on the error of what they give.

The textbook's way, kept apart from the eliminations as their witness. It subtracts, so that
digits go where states are hard to leave; what is left of them is certified. I - T on states
that are left in the end is an M-matrix, its inverse nonnegative: if A e >= |b - A x| then
no entry of x is off by more than its entry of e. The diagonal of A is the sum of the arcs,
never 1 minus a self-loop, and both sides are computed in the platform's extended precision
with their own rounding allowed for (the bounds are wider where that is a double's, see
`sparse_lu`).

Reference: Rump 1999, "INTLAB", and Neumaier 1999, for bounds by M-matrices.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csc_array, diags_array, eye_array
from scipy.sparse.linalg import splu

from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Arcs, Places

    Wide = NDArray[np.longdouble]

_WIDE_EPS = np.finfo(np.longdouble).eps
_FLOOR = 1e-3


class LUSolves:
    """A = I - T factored, where T holds the arcs among some states that are left in the end.

    Parameters
    ----------
    arcs
        the arcs of the whole chain.
    states
        positions of the states, increasing; shape (m,).

    Raises
    ------
    AccuracyError
        if A is singular in floats.
    """

    def __init__(self, arcs: Arcs, states: Places) -> None:
        T = arcs.matrix()[:, states]
        outflow = np.asarray(T.astype(np.longdouble).sum(axis=0), dtype=np.longdouble)
        T = csc_array(T[states])
        wide = csc_array(T.astype(np.longdouble))
        self._arcs = {False: wide.tocsr(), True: wide.T}
        self._outflow = outflow
        self._scale = outflow.astype(np.float64)
        # Each entry is a sum of so many numbers, counting those of its outflow.
        terms = np.diff(T.tocsr().indptr).max(initial=0) + np.diff(arcs.indptr)[states].max()
        self._rounding = (int(terms) + 8) * _WIDE_EPS
        try:
            self._lu = splu(csc_array(eye_array(len(states)) - T @ diags_array(1.0 / self._scale)))
        except RuntimeError:
            raise AccuracyError(
                f"{len(states)} states are left too rarely for the eigenvectors of eigenvalue 1 "
                "to be told apart in floats; use stochastic_limit"
            ) from None

    def solve(self, b: NDArray[np.float64], *, transposed: bool = False) -> NDArray[np.float64]:
        """Return A^-1 b, or A^-T b, for b of shape (m,) or (m, k), as floats give it."""
        by_column = self._scale.reshape(-1, *[1] * (b.ndim - 1))
        if transposed:
            return np.asarray(self._lu.solve(b / by_column, "T"))  # type: ignore[call-overload]
        return np.asarray(self._lu.solve(b) / by_column)

    def missed(
        self, x: NDArray[np.float64], b: NDArray[Any], *, transposed: bool = False
    ) -> NDArray[np.float64]:
        """Return at least |b - A x| (A transposed on request); shape (m,)."""
        residual, rounding = self._residual(x, b.astype(np.longdouble), transposed=transposed)
        return np.asarray(np.abs(residual) + rounding, dtype=np.float64)

    def error(
        self, missed: NDArray[np.float64], *, transposed: bool = False
    ) -> NDArray[np.float64]:
        """Return at least |A^-1| `missed` (A transposed on request); inf where it is unknown."""
        rate = missed / self._scale
        # No entry may vanish: the check below needs room for its rounding.
        wanted = self._scale * np.maximum(rate, _FLOOR * rate.max(initial=0.0))
        e = self.solve(2.0 * wanted, transposed=transposed)
        residual, rounding = self._residual(e, wanted.astype(np.longdouble), transposed=transposed)
        if not (e >= 0.0).all() or not (residual + rounding <= 0.0).all():
            return np.full(len(e), np.inf)
        return e

    def _residual(self, x: NDArray[np.float64], b: Wide, *, transposed: bool) -> tuple[Wide, Wide]:
        """Return b - A x and by how much its rounding may have moved it."""
        out, into = self._outflow * x, self._arcs[transposed] @ x.astype(np.longdouble)
        size = np.abs(out) + self._arcs[transposed] @ np.abs(x).astype(np.longdouble) + np.abs(b)
        return b - (out - into), self._rounding * size
