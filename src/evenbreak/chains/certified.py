"""Solver for large classes, with a proved bound on the relative error of every entry.

For states that are all left eventually, A = D - T is an M-matrix: its inverse has no negative
entry. Hence, if some w >= 0 has A w >= 1, every x is within

    |x - A^-1 b| <= w max |b - A x|,

entry by entry. So it does not matter how x was found: here by a sparse LU factorization or, if the
class has no small separator and the factors would not fit, by Krylov iterations, which use the
aggregates of `aggregation` if plain iterations are slow. Either is repeated on the residual. The
residual is calculated in twice the precision of doubles, its own rounding errors are bounded, and
the inequality for w is checked in the same way.

Unknowns and equations are scaled by powers of 2 so that every unknown and every diagonal entry is
near 1. This is exact and turns the bound into one on relative errors. Entries of any size, such as
1e-200 next to 1, are found equally well: each round, with new scales, finds digits that the last
one could not see.

References: Varga 1962, Matrix Iterative Analysis, and Neumaier 1999 for bounds by M-matrices; Rump
2010, "Verification methods"; van der Vorst 1992 for the iteration.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from itertools import count

import numpy as np
from scipy.linalg.lapack import dgetrf, dgetrs
from scipy.sparse import csc_array, csr_array, diags_array
from scipy.sparse.linalg import LinearOperator, bicgstab, splu

from evenbreak.arrays import Floats
from evenbreak.chains.aggregation import Aggregation
from evenbreak.chains.arcs import Places, reachable
from evenbreak.chains.double_double import ROUND, Balance, Pair, Rows, two_sum
from evenbreak.errors import AccuracyError

GUARANTEED = 1e-14
"""Relative error bound above which answers are not returned."""
_SHARP = 3.0 * ROUND
_NEAR = 2.0**-50
"""Relative residual at which computing a bound is worth the work."""
_SHARE = 1e-10
_DENSE = 0.2
"""Share of nonzero entries at which a matrix is factored as a dense one."""
_PLAIN, _AGGREGATED = 64, 200
"""Iterations before aggregates are made, and with them."""
_ROUNDS, _TRIES, _STALLS = 40, 6, 2
_UNSEEN, _NEAR_ONE = -32, 3
"""An unknown below this power of 2 is not visible in a round; one up to this power is near 1."""
_RARE = 1e-17
"""States that are left no more often than this are left too rarely for a proof."""
_SPREAD = 64
"""Number of steps that finds the part of a class where it spends most of its time."""
_SETTLED = 1e-3
"""Iteration stops when a step changes nothing by more than this share."""


class NotCertifiedError(AccuracyError):
    """No approximation was found whose error could be proved small enough."""

    def __init__(self) -> None:
        super().__init__(
            "the error in the answer can't be bounded: the chain mixes too slowly or nearly "
            "falls apart into separate chains. Use elimination, as stochastic_limit does."
        )


class CertifiedSolve:
    """Solver of (I - T) for one class of states, with a proved error bound for each answer.

    T is sparse, shape (m, m), the arcs within the class; no diagonal. `leak`, not all zero, is the
    chance of leaving the class, given the state. `error` is the largest bound on a relative error
    so far; `pivots` bound each state's chance of not returning, as proved so far.
    """

    def __init__(self, T: csc_array, leak: Floats, *, factored: bool) -> None:
        self._T = T
        out = Rows(T.indptr).sum(T.data)
        high, low = two_sum(out.high, leak)
        self._outflow = two_sum(high, low + out.low)
        self.pivots = outflow = self._outflow.high
        self.error, least = 0.0, _RARE * outflow
        sources = np.repeat(np.arange(len(leak)), np.diff(T.indptr))
        often = T.data >= least[sources]
        rare = not often.all() or ((leak > 0.0) & (leak < least)).any()
        if rare and not reachable(len(leak), T.indices[often], sources[often], leak >= least).all():
            raise NotCertifiedError  # some states are left by rare arcs alone
        self._even = self._spread = np.ones(len(leak))
        self._factors: Callable[..., Floats] | None = None
        if factored:
            self._unit = np.ldexp(1.0, -np.frexp(outflow)[1])
            scaled = csc_array((T.data * self._unit[sources], T.indices, T.indptr), T.shape)
            self._factors = _factors(scaled, outflow * self._unit)
        else:
            self._spread = spread(T, outflow)

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._solved(self.forward, b)

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._solved(self.backward, r)

    @cached_property
    def forward(self) -> Equations:
        """The equations for the visits."""
        solve = self._factors
        factors = solve and (lambda b: self._unit * solve(b, "N"))
        return Equations(csr_array(self._T), self._outflow, self._spread, self._even, factors)

    @cached_property
    def backward(self) -> Equations:
        """The equations for the values."""
        solve = self._factors
        factors = solve and (lambda b: solve(self._unit * b, "T"))
        return Equations(self._T.T, self._outflow, self._even, self._spread, factors)

    def _solved(self, system: Equations, b: Floats) -> Floats:
        x = np.zeros_like(b)
        for k in np.flatnonzero(b.any(axis=0)):
            x[:, k], error, w = system.solve(b[:, k])
            self.error = max(self.error, error)
            self.pivots = np.minimum(self.pivots, self._outflow.high / w)
        return x


def spread(T: csc_array, outflow: Floats) -> Floats:
    """Return roughly the visits to each state after some steps from anywhere, the largest being 1.

    Each state is left in a step or stays, with a chance of 1/2.

    >>> spread(csc_array([[0.0, 0.25], [0.5, 0.0]]), np.array([0.5, 0.25])).round(3)
    array([0.5, 1. ])
    """
    flow, step = np.ones(len(outflow)), 0.5 / outflow
    for _ in range(_SPREAD):
        before = flow
        flow = 0.5 * flow + T @ (step * flow)
        flow /= flow.max()
        if (np.abs(flow - before) <= _SETTLED * flow).all():
            break
    visits = flow / outflow
    return np.asarray(visits / visits.max())


def _factors(T: csc_array, diagonal: Floats) -> Callable[..., Floats]:
    """Return the function (b, "N" or "T") -> A^-1 b or A^-T b in floats, A = D - T.

    Raises NotCertifiedError if A is singular in floating point.
    """
    if T.nnz > _DENSE * T.shape[0] ** 2:
        dense = -T.toarray(order="F")
        np.fill_diagonal(dense, diagonal)
        lu, pivots, singular = dgetrf(dense, overwrite_a=True)
        if singular:
            raise NotCertifiedError
        return lambda b, way: np.asarray(dgetrs(lu, pivots, b, trans=way == "T")[0])
    try:
        A = csc_array(diags_array(diagonal) - T)
        sparse = splu(A, "MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    except (RuntimeError, SystemError, MemoryError):  # singular in floats, or out of memory
        raise NotCertifiedError from None
    return sparse.solve


class Equations:
    """The equations A x = b for any b >= 0, with A = diag(outflow) - arcs.

    The arcs are sparse, shape (m, m), nonnegative, no diagonal; `right` and `left`, both positive,
    approximate the vectors for which A is closest to singular. `factors` returns A^-1 b in floating
    point; None if the factors do not fit.
    """

    def __init__(
        self,
        arcs: csr_array,
        outflow: Pair,
        right: Floats,
        left: Floats,
        factors: Callable[[Floats], Floats] | None,
    ) -> None:
        self.arcs, self.outflow, self.left, self._right = arcs, outflow, left, right
        self.factors, self.plain = factors, True
        self.rows = Rows(arcs.indptr)

    def near(self, b: Floats) -> tuple[Floats, Floats]:
        """Return x >= 0 near A^-1 b, for b >= 0, and an upper bound on each residual.

        The residual is that of the unrounded x.
        """
        nothing, shift = np.zeros(len(b)), self._as_they_are.shift
        best, least, y = nothing, np.ldexp(b, -shift), Pair(nothing, nothing)
        with np.errstate(all="ignore"):  # what overflows is no better
            residual = b = np.ldexp(b, -shift)
            while True:
                y = _sum(y, self._as_they_are.solved(residual, _SHARE))
                y = Pair(*(np.where(y.high > 0.0, part, 0.0) for part in y))
                residual, missed = self._as_they_are.balance.missed(y, b)
                if not missed.max() < least.max() / 2.0:
                    break
                best, least = y.high, missed
                if np.abs(residual).max() < (missed - np.abs(residual)).max():
                    break  # no more can be seen
        return best, np.ldexp(least, shift)

    def error(self, missed: Floats) -> Floats:
        """Return an upper bound on |A^-1| `missed`; NotCertifiedError if none is found."""
        with np.errstate(all="ignore"):
            w = self._as_they_are.witness()
        return np.asarray(w * np.ldexp(missed, -self._as_they_are.shift).max())

    @cached_property
    def _as_they_are(self) -> _Scaled:
        return _Scaled(self, np.zeros(len(self.left), dtype=np.int64), np.ones(len(self.left)))

    def solve(self, b: Floats) -> tuple[Floats, float, Floats]:
        """Return A^-1 b > 0, a bound on the relative error of every entry, and a witness.

        No diagonal entry of A^-1 is larger than the witness over that of A. Raises
        NotCertifiedError if no answer could be proved to `GUARANTEED`.
        """
        nothing = np.zeros(len(b))
        with np.errstate(all="ignore"):  # what overflows is not proved
            power = np.frexp(self._right)[1].astype(np.int64)
            equations = _Scaled(self, power, np.ldexp(self._right, -power))
            y, w, last, stalls = Pair(nothing, nothing), None, np.inf, 0
            best = nothing, np.inf, nothing
            for _ in range(_ROUNDS):
                residual, size = equations.balance.missed(y, np.ldexp(b, -equations.shift))
                missed = size.max()
                if missed <= _NEAR and y.high.min() > 0.0:
                    w = equations.witness() if w is None else w
                    # A little more, for the roundings of the bound itself and of y for the answer.
                    bound = 1.001 * float((missed * w / y.high).max()) + (1.0 + 1e-9) * ROUND
                    if bound < best[1]:
                        best = np.ldexp(y.high, power), bound, w
                stalls += not missed <= last / 4.0
                if best[1] <= _SHARP or stalls > _STALLS:
                    break
                last = missed
                y = _sum(y, equations.solved(residual, _SHARE))
                move = _moves(y.high)
                if move.any():
                    power = power + move
                    y = Pair(*(np.ldexp(np.where(y.high > 0.0, part, 0.0), -move) for part in y))
                    equations = _Scaled(self, power, np.maximum(y.high, 0.5))
                    w, last = None, np.inf
        if best[1] > GUARANTEED:
            raise NotCertifiedError
        return best


class _Scaled:
    """The equations A x = b for x = 2^power y: integer powers, shape (m,), and y near `about`."""

    def __init__(self, system: Equations, power: Places, about: Floats) -> None:
        arcs = system.arcs
        unit = np.frexp(system.outflow.high)[1]
        self._power, self.shift = power, power + unit
        shift = power[arcs.indices] - np.repeat(self.shift, np.diff(arcs.indptr))
        outflow = Pair(*(np.ldexp(part, -unit) for part in system.outflow))
        scaled = csr_array(
            (np.ldexp(arcs.data, shift), arcs.indices, arcs.indptr), shape=arcs.shape
        )
        self.balance = Balance(scaled, outflow, system.rows)
        self._system, self._about = system, about

    def witness(self) -> Floats:
        """Return a w > 0 for which A w >= 1 is proved; NotCertifiedError if none is found."""
        w, two = np.zeros(len(self.shift)), np.full(len(self.shift), 2.0)
        residual = two
        for _ in range(_TRIES):
            w = np.maximum(w + self.solved(residual, 1e-2), 0.0)
            residual, missed = self.balance.missed(Pair(w, np.zeros_like(w)), two)
            if missed.max() <= 1.0:
                return w
        raise NotCertifiedError

    def solved(self, b: Floats, share: float) -> Floats:
        """Return y with A y = b in floating point, to at least a `share` of the size of b."""
        if self._system.factors is not None:
            top = int((np.frexp(b)[1] + self.shift).max())
            x = self._system.factors(np.ldexp(b, self.shift - top))
            return np.ldexp(x, top - self._power)
        m, size = len(b), float(np.abs(b).max()) or 1.0
        A = LinearOperator((m, m), matvec=self._times, dtype=np.float64)
        # The iteration breaks down on a residual that few states have, and by an absolute measure.
        b, y = b / size, np.random.default_rng(0).random(m)
        if self._system.plain:
            y, unfinished = bicgstab(A, b, y, rtol=share, maxiter=_PLAIN)
            if not unfinished:
                return size * y
            self._system.plain = False
        M = LinearOperator((m, m), matvec=self._aggregated, dtype=np.float64)
        steps = count(1)

        def watch(y: Floats) -> None:
            """Give up if the residual is still as large as b after some steps."""
            step = next(steps)
            if step > _PLAIN and step % 16 == 0 and not np.abs(b - self._times(y)).max() <= 1.0:
                raise NotCertifiedError

        y, _ = bicgstab(A, b, y, rtol=share, maxiter=_AGGREGATED, M=M, callback=watch)
        return size * y

    def _times(self, y: Floats) -> Floats:
        return np.asarray(self.balance.outflow.high * y - self.balance.arcs @ y)

    @cached_property
    def _aggregated(self) -> Callable[[Floats], Floats]:
        """A function that returns roughly A^-1 b, on aggregates."""
        weight = np.ldexp(self._system.left, self.shift)
        A = diags_array(self.balance.outflow.high) - self.balance.arcs
        try:
            rough = Aggregation(csr_array(diags_array(weight) @ A @ diags_array(self._about)))
        except RuntimeError:
            raise NotCertifiedError from None
        return lambda b: self._about * rough(weight * b)


def _sum(y: Pair, more: Floats) -> Pair:
    high, lost = two_sum(y.high, more)
    return two_sum(high, lost + y.low)


def _moves(y: Floats) -> Places:
    """Return the powers of 2 that bring all unknowns near 1; all 0 if they are near already.

    Raises NotCertifiedError if an unknown is NaN.
    """
    exponent = np.frexp(y)[1]
    if not np.isfinite(y).all() or y.max() <= 0.0:
        raise NotCertifiedError
    unseen = int(exponent.max()) + _UNSEEN
    move = np.where(y > 0.0, np.maximum(exponent, unseen), unseen)
    return move if np.abs(move).max() > _NEAR_ONE else np.zeros_like(move)
