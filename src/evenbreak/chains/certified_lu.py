"""Sparse LU factorisation of I - T, with a proved bound on the error of every entry.

LU subtracts, so it loses digits where states are hard to leave; the bound says how many are
left. A = I - T, for states that are all left in the end, is an M-matrix: its inverse has no
negative entry. Hence, if some e >= 0 has

    A e >= |b - A x|,

no entry of x is off by more than its entry of e. The diagonal of A is the sum of the arcs,
never 1 minus a self-loop, and both sides of the inequality are computed in the platform's
extended precision, with their own rounding allowed for. A small residual alone would prove
nothing about a chain that is slow to leave its states.

Where a long double is no wider than a double (Windows, some ARM) the bounds still hold but
are wider, so that more answers carry a residual or are refused.

References: Skeel 1980 for the refinement; Rump 1999, "INTLAB", and Neumaier 1999 for
bounds by M-matrices.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

import numpy as np
from scipy.sparse import csc_array, diags_array, eye_array
from scipy.sparse.linalg import splu

from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Arcs, Places

    Wide = NDArray[np.longdouble]

GUARANTEED = 1e-12
"""Answers whose entries may be off by more than this, relatively, carry a residual."""
_USABLE = 1e-6
_ROUNDS = 6
_WIDE_EPS = np.finfo(np.longdouble).eps


class CertifiedLU:
    """A = I - T factored, where T holds the arcs among states that are all left in the end.

    Parameters
    ----------
    T
        sparse, shape (m, m): T[i, j] is the arc from j to i; no diagonal.
    outflow
        shape (m,): the chance to leave each state in a step, in extended precision.
    terms
        how many numbers an entry of `outflow` is the sum of, at most.

    Raises
    ------
    AccuracyError
        if A is singular in floats.
    """

    def __init__(self, T: csc_array, outflow: Wide, terms: int) -> None:
        wide = csc_array(T.astype(np.longdouble))
        self._arcs = {False: wide.tocsr(), True: wide.T}
        self._outflow = outflow
        self.outflow: NDArray[np.float64] = outflow.astype(np.float64)
        into = int(np.diff(self._arcs[False].indptr).max(initial=0))
        self._rounding = (into + terms + 8) * _WIDE_EPS
        scaled = T @ diags_array(1.0 / self.outflow)
        try:
            self._lu = splu(
                csc_array(eye_array(len(outflow)) - scaled),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError:
            raise AccuracyError(
                f"{len(outflow)} states that reach each other are left too rarely to be solved "
                "in floats; join some of them or leave them out"
            ) from None

    @classmethod
    def of_states(cls, arcs: Arcs, states: Places) -> Self:
        """Return the factors for some states of a chain; `states` increasing, shape (m,)."""
        out = arcs.matrix()[:, states]
        outflow = np.asarray(out.astype(np.longdouble).sum(axis=0), dtype=np.longdouble)
        try:
            return cls(csc_array(out[states]), outflow, int(np.diff(arcs.indptr)[states].max()))
        except AccuracyError as error:
            hint = "for the limit alone, use stochastic_limit, by elimination"
            raise AccuracyError(f"{error}; {hint}") from None

    def solve(self, b: NDArray[np.float64], *, transposed: bool = False) -> NDArray[np.float64]:
        """Return A^-1 b, or A^-T b, for b of shape (m,) or (m, k), as floats give it."""
        outflow = self.outflow.reshape(-1, *[1] * (b.ndim - 1))
        if transposed:
            return np.asarray(self._lu.solve(b / outflow, "T"))  # type: ignore[call-overload]
        return np.asarray(self._lu.solve(b) / outflow)

    def refined(self, b: NDArray[Any], *, transposed: bool = False) -> Wide:
        """Return A^-1 b, or A^-T b, for b of shape (m,), refined in extended precision."""
        x, residual, smallest = np.zeros_like(b, np.longdouble), b.astype(np.longdouble), np.inf
        best = x
        for _ in range(_ROUNDS):
            x = x + self.solve(residual.astype(np.float64), transposed=transposed)
            residual, _ = self.residual(x, b, transposed=transposed)
            size = float(np.abs(residual).max())
            if not size < smallest:
                break
            best, smallest = x, size
        return best

    def residual(
        self, x: NDArray[Any], b: NDArray[Any], *, transposed: bool = False
    ) -> tuple[Wide, Wide]:
        """Return b - A x (A transposed on request), and by how much rounding may have moved it."""
        arcs = self._arcs[transposed]
        out, into = self._outflow * x, arcs @ x.astype(np.longdouble)
        size = np.abs(out) + arcs @ np.abs(x).astype(np.longdouble) + np.abs(b)
        return b - (out - into), self._rounding * size

    def missed(self, x: NDArray[Any], b: NDArray[Any], *, transposed: bool = False) -> Wide:
        """Return at least |b - A x| (A transposed on request)."""
        residual, rounding = self.residual(x, b, transposed=transposed)
        return np.abs(residual) + rounding

    def error(
        self, missed: NDArray[Any], *, transposed: bool = False, floor: float = 0.0
    ) -> NDArray[np.float64]:
        """Return at least |A^-1| `missed` (A transposed on request); inf where it is unknown.

        An entry of `missed` that is 0 leaves no room for rounding. With a `floor`, entries
        count as no smaller than this share of the largest, each over its outflow.
        """
        rate = missed / self._outflow
        wanted = self._outflow * np.maximum(rate, floor * rate.max(initial=0.0))
        e = self.refined(2.0 * wanted, transposed=transposed)
        residual, rounding = self.residual(e, wanted, transposed=transposed)
        if not (e >= 0.0).all() or not (residual + rounding <= 0.0).all():
            return np.full(len(e), np.inf)
        return e.astype(np.float64)


class CertifiedSolve:
    """(I - T) factored for one class too large for elimination, each answer certified.

    Parameters
    ----------
    T
        sparse, shape (m, m): the arcs within the class; no diagonal.
    leak
        shape (m,): the chance to leave the class, given the state; not all zero.

    Raises
    ------
    AccuracyError
        if an answer cannot be certified to a relative error of 1e-6 in every entry.
    """

    def __init__(self, T: csc_array, leak: NDArray[np.float64]) -> None:
        self.residual: float | None = None
        outflow = np.add(T.astype(np.longdouble).sum(axis=0), leak, dtype=np.longdouble)
        self._lu = CertifiedLU(T, outflow, int(np.diff(T.indptr).max()) + 1)
        self.pivots = self._lu.outflow

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

    def _certified(self, b: NDArray[np.float64], *, transposed: bool) -> Wide:
        x = self._lu.refined(b, transposed=transposed)
        worst = np.inf
        if (x > 0).all():
            missed = self._lu.missed(x, b, transposed=transposed)
            worst = float((self._lu.error(missed, transposed=transposed) / x).max())
        if worst > _USABLE:
            raise AccuracyError(
                f"a class of {len(b)} states mixes or is left too slowly for a sparse "
                f"factorisation in floats (relative error up to {worst:.1g}); "
                "join some of its states or split the chain"
            )
        if worst > GUARANTEED:
            residual, _ = self._lu.residual(x, b, transposed=transposed)
            self.residual = max(float(np.abs(residual).max() / b.max()), self.residual or 0.0)
        return x
