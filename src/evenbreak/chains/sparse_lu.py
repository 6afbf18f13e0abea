"""A sparse factorisation for one large class, refined, and certified where possible.

For classes that are too large for elimination free of subtraction. A = I - T, its columns
scaled to a diagonal of ones, is factored by SuperLU and the answer refined with residuals
in the platform's extended precision. A is an M-matrix, so that its inverse is nonnegative;
hence, if some e >= 0 has A e >= |b - A x| (which is checked, with the rounding of the check
itself), no entry of x is off by more than its entry of e. A small residual alone would
prove nothing about a chain that is slow to leave its states.

Where a long double is no wider than a double (Windows, some ARM) the refinement gains nothing
and the rounding of the check is that of doubles: the bounds still hold, but are wider, so
that more answers carry a residual or are refused.

References: Skeel 1980 for the refinement; Rump 1999, "INTLAB", and Neumaier 1999 for
bounds by M-matrices.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array, diags_array, eye_array
from scipy.sparse.linalg import splu

from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Wide = NDArray[np.longdouble]

GUARANTEED = 1e-12
_USABLE = 1e-6
_ROUNDS = 6


class SparseFactorisation:
    """I - T factored, for one large class.

    Parameters
    ----------
    T
        sparse, shape (m, m): the arcs within the class; no diagonal.
    leak
        shape (m,): the chance to leave the class, given the state; not all zero.
    """

    def __init__(self, T: csc_array, leak: NDArray[np.float64]) -> None:
        m = len(leak)
        self.residual: float | None = None
        wide = T.astype(np.longdouble)
        self._arcs = {False: wide.tocsr(), True: csc_array(wide).T}
        diagonal: Wide = np.add(wide.sum(axis=0), leak, dtype=np.longdouble)
        self._diagonal = diagonal
        self.pivots = diagonal.astype(np.float64)
        A = csc_array(eye_array(m) - T @ diags_array(1.0 / self.pivots))
        try:
            self._lu = splu(
                A,
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError:
            raise AccuracyError(
                f"a class of {m} states is left too rarely to be solved in floats; "
                "join its states or leave it out"
            ) from None

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._columns(b, transposed=False)

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._columns(r, transposed=True)

    def _columns(self, b: NDArray[np.float64], *, transposed: bool) -> NDArray[np.float64]:
        x = np.zeros_like(b)
        for k in np.flatnonzero(b.any(axis=0)):
            x[:, k] = self._certified(b[:, k], transposed=transposed)
        return x

    def _certified(self, b: NDArray[np.float64], *, transposed: bool) -> NDArray[np.float64]:
        x, residual = self._refined(b.astype(np.longdouble), transposed=transposed)
        # What the residual may be off by itself: its terms, each rounded a few times.
        terms = self._diagonal * np.abs(x) + self._arcs[transposed] @ np.abs(x) + b
        bound = np.abs(residual) + 64 * np.finfo(np.longdouble).eps * terms
        error, miss = self._refined(2 * bound, transposed=transposed)
        ok = (x > 0).all() and (error >= 0).all() and (np.abs(miss) <= bound / 2).all()
        worst = float((error / x).max()) if ok else np.inf
        if worst > _USABLE:
            raise AccuracyError(
                f"a class of {len(b)} states mixes or is left too slowly for a sparse "
                f"factorisation in floats (relative error up to {worst:.1g}); "
                "join its states or split the chain"
            )
        if worst > GUARANTEED:
            missed = float(np.abs(residual).max() / b.max())
            self.residual = max(missed, self.residual or 0.0)
        return x.astype(np.float64)

    def _refined(self, b: Wide, *, transposed: bool) -> tuple[Wide, Wide]:
        """Return x and b - A x (A transposed on request), after steps of refinement."""
        arcs = self._arcs[transposed]
        x, residual, smallest = np.zeros_like(b), b, np.inf
        best = x, residual
        for _ in range(_ROUNDS):
            x = x + self._step(residual.astype(np.float64), transposed=transposed)
            residual = b - (self._diagonal * x - arcs @ x)
            size = float(np.abs(residual).max())
            if not size < smallest:
                break
            best, smallest = (x, residual), size
        return best

    def _step(self, b: NDArray[np.float64], *, transposed: bool) -> NDArray[np.float64]:
        """Return A^-1 b (A transposed on request), as far as the factors are right."""
        x: NDArray[np.float64]
        if transposed:
            x = self._lu.solve(b / self.pivots, "T")  # type: ignore[call-overload]
            return x
        x = self._lu.solve(b)
        return x / self.pivots
