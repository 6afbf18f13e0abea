"""The eigenvectors of eigenvalue 1, and the limit that they give, with a proved bound.

The structure says how often eigenvalue 1 occurs and where its vectors live: once for each closed
class, whose right vector R is the stationary law and whose left vector L is the chance of ending
there. Both are solved for from the arcs, by sparse LU factors that are applied again to what is
still missed, in pairs of doubles. With A = D - T, the arcs T among some states and D the chances
of leaving them:

- L v, for a start v, needs one solve for all classes: x = A^-1 v_T are the visits to the transient
  states, and L_C v = v_C + B_C x with the arcs B_C into class C. Every column of A and B together
  sums to 0, so that residuals r put the chances off by no more than sum |r|.
- R: a likely state is cut out of each class, found by one step of inverse iteration; the others
  solve A x = the arcs out of it. A w >= 1, checked in pairs too, proves that no entry is off by
  more than its w times the largest residual (A is an M-matrix).

Other eigenvalues may therefore lie as close to 1 as they like without mixing in.

References: Golub and Van Loan, Matrix Computations, section 7.6, for inverse iteration; Varga 1962,
Matrix Iterative Analysis, for bounds by M-matrices.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.linalg.lapack import dgetrf, dgetrs
from scipy.sparse import csc_array, csr_array, eye_array
from scipy.sparse.linalg import splu

from evenbreak.chains.arcs import reachable, sums
from evenbreak.chains.dissection import dissect, neighbours
from evenbreak.chains.double_double import ROUND, Balance, Pair, Rows, two_sum
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places
    from evenbreak.chains.chain import Chain

    Floats = NDArray[np.float64]

EPS = float(np.finfo(float).eps)
SHIFT = 1.0 + 1e-10
"""As close to eigenvalue 1 as a factorisation can be made."""
_DENSE = 0.2
"""A matrix with this share of entries is factored as a dense one."""
_FEW, _MUCH_WORK = 1000, 1e11
"""So few states are factored whatever their graph; others, with up to so many multiplications."""
_TRIES, _ENOUGH = 6, 4.0
"""How often w is sought; so many times what no residual can show is missed by little enough."""


class UnitPairs:
    """The vectors of eigenvalue 1 of a chain.

    Parameters
    ----------
    chain
        the chain, n states.

    Raises
    ------
    AccuracyError
        from all that is asked of it, if no bound on the errors is found.
    """

    def __init__(self, chain: Chain) -> None:
        self._chain = chain
        structure = chain.structure
        number = np.full(structure.count, -1)
        number[structure.closed] = np.arange(structure.closed.sum())
        self._class = number[structure.label]
        """The number of the closed class of each state, -1 if it is transient."""
        self.count = int(structure.closed.sum())

    @cached_property
    def right(self) -> Floats:
        """The stationary laws; shape (n, closed classes)."""
        right = np.zeros((len(self._chain), self.count))
        states = np.flatnonzero(self._class >= 0)
        right[states, self._class[states]] = self._all_laws[0][states]
        return right

    @property
    def left(self) -> Floats:
        """The chances of ending in each class; shape (closed classes, n)."""
        return self._chances[0]

    @property
    def error(self) -> float:
        """A bound on the sum of the errors of the limit R (L v), from any start v.

        The product L v is to be right to about one rounding; see `limit_by`.
        """
        return self._all_laws[1] + self._chances[1] + 2.0 * EPS

    def limit(self, v: Floats) -> tuple[Floats, float]:
        """Return the limit R (L v), and a bound on the sum of its errors.

        One solve gives L v; no more of L is calculated.
        """
        arcs = self._chain.arcs
        seen = reachable(arcs.size, arcs.sources, arcs.targets, v > 0.0)
        visits, lost = np.zeros(arcs.size), 0.0
        states = np.flatnonzero(seen & (self._class < 0))
        if len(states):
            T, outflow = self._equations(states)
            _refuse_giants(T)
            x, missed = _System(T, outflow).solve(v[states])
            visits[states], lost = x, float(missed.sum())
        entering = (self._class[arcs.sources] < 0) & (self._class[arcs.targets] >= 0)
        flow = arcs.chances[entering] * visits[arcs.sources[entering]]
        own = np.flatnonzero(self._class >= 0)
        into = self._class[np.concatenate((own, arcs.targets[entering]))]
        chances = sums(into, np.concatenate((v[own], flow)), self.count)
        law, error = self._laws(chances > 0.0)
        return law * np.where(self._class < 0, 0.0, chances[self._class]), lost + error + 4.0 * EPS

    @cached_property
    def _all_laws(self) -> tuple[Floats, float]:
        return self._laws(np.ones(self.count, dtype=bool))

    def _laws(self, wanted: NDArray[np.bool_]) -> tuple[Floats, float]:
        """Return the laws of the wanted closed classes, by state, and a bound on the errors of one.

        With x = 1 at the state that is cut out of a class, the law is x over its sum. If x is off
        by e, the law is off by no more than 2 sum |e|.
        """
        law = np.zeros(len(self._chain))
        here = self._class >= 0
        here[here] = wanted[self._class[here]]
        alone = here & (np.diff(self._chain.arcs.indptr) == 0)
        law[alone] = 1.0
        states = np.flatnonzero(here & ~alone)
        if not len(states):
            return law, 0.0
        T, outflow = self._equations(states)
        _refuse_giants(T)
        guess = _factored(T, SHIFT * outflow.high, transposed=False)(np.ones(len(states)))
        order = np.lexsort((guess, self._class[states]))
        last = np.append(np.diff(self._class[states[order]]) > 0, True)
        cut = np.zeros(len(law), dtype=bool)
        cut[states[order[last]]] = True
        rest = states[~cut[states]]
        system = _System(*self._equations(rest))
        arcs = self._chain.arcs
        out = cut[arcs.sources]
        x, missed = system.solve(sums(arcs.targets[out], arcs.chances[out], arcs.size)[rest])
        law[cut], law[rest] = 1.0, x
        total = sums(self._class[states], law[states], self.count)
        law[states] /= total[self._class[states]]
        return law, 2.0 * float(system.error(missed).sum()) + 4.0 * EPS

    @cached_property
    def _chances(self) -> tuple[Floats, float]:
        """The left vectors, and a bound on the sum of the errors of a column."""
        arcs = self._chain.arcs
        left = np.zeros((self.count, arcs.size))
        own = np.flatnonzero(self._class >= 0)
        left[self._class[own], own] = 1.0
        states = np.flatnonzero(self._class < 0)
        if not len(states):
            return left, 0.0
        entering = (self._class[arcs.sources] < 0) & (self._class[arcs.targets] >= 0)
        ways = arcs.sources[entering] * np.int64(self.count) + self._class[arcs.targets[entering]]
        ways, place = np.unique(ways, return_inverse=True)
        chances = sums(place, arcs.chances[entering], len(ways))
        into = np.zeros((self.count, arcs.size))
        into[ways % self.count, ways // self.count] = chances
        T, outflow = self._equations(states)
        _refuse_giants(T)
        system = _System(T, outflow, transposed=True)
        missed = np.zeros(len(states))
        for row, column in zip(left, into[:, states], strict=True):
            x, more = system.solve(column)
            row[states] = x
            missed += more
        return left, float(system.error(missed).max()) + 2.0 * EPS

    @cached_property
    def _outflow(self) -> Pair:
        arcs = self._chain.arcs
        return Rows(arcs.indptr).sum(arcs.chances)

    def _equations(self, states: Places) -> tuple[csc_array, Pair]:
        """Return the arcs T among some states and the diagonal D."""
        T = self._chain.arcs.matrix()
        if len(states) < T.shape[0]:
            T = csc_array(T[:, states][states])
        return T, Pair(*(part[states] for part in self._outflow))


class _System:
    """A x = b for some states of a chain, or the transpose, with A = D - T.

    Parameters
    ----------
    T
        sparse, shape (m, m): the arcs among the states.
    outflow
        shape (m,) each: the diagonal D.
    """

    def __init__(self, T: csc_array, outflow: Pair, *, transposed: bool = False) -> None:
        arcs: csr_array = T.T if transposed else T.tocsr()
        self._balance = Balance(arcs, outflow, Rows(arcs.indptr))
        self._back = _factored(T, outflow.high, transposed=transposed)
        self._terms = np.diff(arcs.indptr) + 8

    def solve(self, b: Floats) -> tuple[Floats, Floats]:
        """Return A^-1 b for b >= 0, and at least by how much the equations are missed.

        The miss is that of an x of which the answer is the rounding; where x is negative, it is 0,
        which is nearer.
        """
        arcs, D = self._balance.arcs, self._balance.outflow.high
        best, least = np.zeros_like(b), b
        with np.errstate(all="ignore"):  # what overflows is no better
            x = Pair(np.maximum(self._back(b), 0.0), np.zeros_like(b))
            while True:
                residual, missed = self._balance.missed(x, b)
                if not missed.max() < least.max() / 2.0:
                    return best, least
                best, least, unseen = x.high, missed, missed - np.abs(residual)
                more = self._back(residual)
                high, lost = two_sum(x.high, more)
                x = Pair(*(np.where(high > 0.0, part, 0.0) for part in two_sum(high, lost + x.low)))
                # So small a change changes the residual by what doubles tell well enough.
                out, into, size = D * more, arcs @ more, np.abs(D * more) + arcs @ np.abs(more)
                rounding = 2.0 * ROUND * self._terms * (size + np.abs(residual))
                missed = np.abs(residual - (out - into)) + rounding + unseen
                if missed.max() < _ENOUGH * unseen.max():
                    return x.high, missed

    def error(self, missed: Floats) -> Floats:
        """Return at least |A^-1| `missed`, by w >= 0 with A w >= D.

        Raises
        ------
        AccuracyError
            if no such w is found.
        """
        arcs, D = self._balance.arcs, self._balance.outflow.high
        w, residual = np.zeros_like(D), 2.0 * D
        with np.errstate(all="ignore"):
            for _ in range(_TRIES):
                w = np.maximum(w + self._back(residual), 0.0)
                out, into = D * w, arcs @ w
                residual = 2.0 * D - (out - into)
                rounding = 2.0 * ROUND * self._terms * (out + into + 2.0 * D)
                if (np.abs(residual) + rounding <= D).all():
                    return np.asarray(w * (missed / D).max())
        raise _unbounded()


def _factored(T: csc_array, outflow: Floats, *, transposed: bool) -> Callable[[Floats], Floats]:
    """Return x -> A^-1 x by LU factors in floats, A = D - T."""
    m = len(outflow)
    if T.nnz > _DENSE * m * m:
        A = T.toarray() / -outflow
        A[np.arange(m), np.arange(m)] = 1.0
        lu, pivots, singular = dgetrf(A, overwrite_a=True)
        if singular:
            raise _unbounded()

        def solve(b: Floats, way: str) -> Any:
            return dgetrs(lu, pivots, b, trans=int(way == "T"))[0]
    else:
        shares = T.data / np.repeat(outflow, np.diff(T.indptr))
        sparse = csc_array(eye_array(m) - csc_array((shares, T.indices, T.indptr), T.shape))
        try:
            factors: Any = splu(
                sparse,
                "MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError:
            raise _unbounded() from None
        solve = factors.solve
    if transposed:
        return lambda b: np.asarray(solve(b / outflow, "T"))
    return lambda b: np.asarray(solve(b, "N") / outflow)


def _refuse_giants(T: csc_array) -> None:
    """Refuse states whose factors would take too long."""
    m = T.shape[0]
    work = sum(front.work for front in dissect(neighbours(T))[1]) if m > _FEW else 0.0
    if work > _MUCH_WORK:
        raise AccuracyError(
            f"{m:,} states that nothing cuts in two take some {work:.0e} multiplications to "
            "factor, which is too much for eigenvectors; use elimination, as stochastic_limit does"
        )


def _unbounded() -> AccuracyError:
    return AccuracyError(
        "the errors of the eigenvectors of eigenvalue 1 cannot be bounded: the chain is too "
        "slow or too close to falling apart; use elimination, as stochastic_limit does"
    )


def limit_by(right: NDArray[Any], left: NDArray[Any], v: Floats) -> Floats:
    """Return the limit R (L v) by the vectors of eigenvalue 1, L v being right to one rounding.

    >>> limit_by(np.eye(2), np.array([[1.0, 0.25], [0.0, 0.75]]), np.array([0.5, 0.5]))
    array([0.625, 0.375])
    """
    chances = [math.fsum(row) for row in left.real[:, v > 0.0] * v[v > 0.0]]
    return np.asarray(right.real @ np.array(chances))
