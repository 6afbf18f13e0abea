"""Eigenpairs of a transition matrix: LAPACK (small), ARPACK (large), and solves for eigenvalue 1.

The pairs of eigenvalue 1 are known (`UnitPairs`), and a closed class of period d also has the
other d-th roots of 1. All other vectors are projected off these and made biorthogonal,

    L = (Y R)^-1 Y for left vectors Y and right vectors R,

which exists if neither set is defective and both belong to the same eigenvalues.

`UnitPairs`. The structure says how often eigenvalue 1 occurs and where its vectors live: once for
each closed class, whose right vector R is the stationary distribution and whose left vector L is
the chance of ending there. Both are solved for from the arcs, by LU factors that are applied again
to the residual, in pairs of doubles (see `certified`). With A = D - T, the arcs T among some states
and D the chances of leaving them:

- L v, for a start v, needs one solve for all classes: x = A^-1 v_T are visits to the transient
  states, and L_C v = v_C + B_C x with the arcs B_C into class C. Every column of A and B together
  sums to 0, so residuals r change the chances by no more than sum |r|.
- R: a state where some steps from anywhere spend much time is cut out of each class; the others
  solve A x = the arcs out of it. A w >= 1, checked in pairs too, proves that no entry is off by
  more than its w times the largest residual (A is an M-matrix).

Other eigenvalues may therefore be arbitrarily close to 1 without mixing in.

References: Golub and Van Loan, Matrix Computations, chapter 7, for LAPACK's QR algorithm; Lehoucq,
Sorensen and Yang 1998 for ARPACK; Varga 1962, Matrix Iterative Analysis, for bounds by M-matrices.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import scipy.sparse
import scipy.sparse.linalg
from numpy.typing import NDArray
from scipy.linalg.lapack import dgeev, dgeev_lwork
from scipy.sparse import csc_array, diags_array

from evenbreak.arrays import Bools, Floats
from evenbreak.chains.arcs import Places, reachable, sums
from evenbreak.chains.certified import CertifiedSolve, spread
from evenbreak.chains.dissection import dissect, neighbors
from evenbreak.chains.powers import evened
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from evenbreak.chains.chain import Chain


DENSE = 1000
"""Number of states up to which LAPACK finds all eigenvalues at once."""
SHIFT = 1.0 + 1e-10
"""Distance of the shift from eigenvalue 1: as close as a factorization allows."""
TOLERANCE = 1e-8
"""Residuals and error estimates above this raise an error."""


class Eigenpairs(NamedTuple):
    """Eigenvalues, with conjugate pairs adjacent, upper one first; real vectors.

    The right vectors x + iy and x - iy of a conjugate pair are kept as x and y, its left vectors x
    + iy and x - iy as 2x and -2y, so products L R are unchanged. `left` has shape (k, n), `right`
    (n, k).
    """

    values: NDArray[Any]
    left: Floats
    right: Floats

    def and_then(self, more: Eigenpairs) -> Eigenpairs:
        """Return these pairs followed by more."""
        return Eigenpairs(
            np.concatenate((self.values, more.values)),
            np.vstack((self.left, more.left)),
            np.hstack((self.right, more.right)),
        )

    def missed(self, M: NDArray[Any] | csc_array) -> float:
        """Return the largest entry of M R - R diag(values), L M - diag(values) L and L R - I."""
        turn = self.values.imag.clip(0.0)[:-1]
        diagonals: Any = (self.values.real, turn, -turn)
        values = diags_array(diagonals, offsets=(0, 1, -1))
        return max(
            float(np.abs(M @ self.right - self.right @ values).max()),
            float(np.abs(self.left @ M - values @ self.left).max()),
            float(np.abs(self.left @ self.right - np.eye(len(self.values))).max()),
        )

    def in_complex(self) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
        """Return the values and the left and right vectors; real if all are real."""
        upper = np.flatnonzero(self.values.imag > 0.0)
        if not len(upper):
            return self.values.real, self.left, self.right
        left, right = self.left.astype(complex), self.right.astype(complex)
        left[upper] = (self.left[upper] - 1j * self.left[upper + 1]) / 2.0
        right[:, upper] += 1j * self.right[:, upper + 1]
        left[upper + 1], right[:, upper + 1] = left[upper].conj(), right[:, upper].conj()
        return self.values, left, right


def _whole_pairs(values: NDArray[Any], order: Places, k: int) -> Places:
    """Return the first k places, or one more, of an order that keeps conjugates together.

    A value without its conjugate is left out.
    """
    ordered = values[order]
    whole = ordered.imag == 0.0
    upper = np.flatnonzero((ordered.imag[:-1] > 0.0) & (ordered[:-1].conj() == ordered[1:]))
    whole[upper] = whole[upper + 1] = True
    order = order[whole]
    if len(order) < k:
        raise no_basis(k)
    return order[: k + int(values[order[k - 1]].imag > 0.0)]


def leading_pairs(chain: Chain, units: UnitPairs, k: int) -> tuple[Eigenpairs, float]:
    """Return the k leading pairs of a chain, or one more, and their residual.

    Pairs of eigenvalue 1 come first. Raises AccuracyError if there are not k independent vectors,
    or if the iteration does not converge.
    """
    n, ones = units.right.shape
    M = chain.matrix
    certain = Eigenpairs(np.ones(ones), units.left, units.right)
    certain = certain.and_then(roots_of_one(chain, units, k - ones))
    missing = k - (len(certain.values) if n <= DENSE else ones)
    if missing > 0:
        rest = (_dense_others if n <= DENSE else _sparse_others)(M, certain, missing)
        # The known vectors are exact; only the others are adjusted.
        right = rest.right - certain.right @ (certain.left @ rest.right)
        try:
            if k == n:
                left = np.linalg.inv(np.hstack((certain.right, right)))[len(certain.values) :]
            else:
                left = rest.left - (rest.left @ certain.right) @ certain.left
                left = np.asarray(np.linalg.solve(left @ right, left), dtype=np.float64)
        except np.linalg.LinAlgError:
            raise no_basis(k, ones) from None
        certain = certain.and_then(Eigenpairs(rest.values, left, right))
        if n > DENSE:
            order = np.argsort(np.abs(certain.values - 1.0), kind="stable")
            certain = Eigenpairs(
                certain.values[order], certain.left[order], certain.right[:, order]
            )
    k += int(certain.values[k - 1].imag > 0.0)  # so that no conjugate pair is parted
    pairs = Eigenpairs(certain.values[:k], certain.left[:k], certain.right[:, :k])
    return pairs, pairs.missed(M.toarray() if n <= DENSE else M)


def within_unit_disc(values: NDArray[Any]) -> NDArray[Any]:
    """Return eigenvalues of a stochastic matrix, with those outside the unit circle moved onto it.

    The true eigenvalues are in the disc, so this moves none further from its true value.

    >>> within_unit_disc(np.array([1.0, -1.0000000000000007, 0.5]))
    array([ 1. , -1. ,  0.5])
    """
    turned = values / np.maximum(np.abs(values), 1.0)
    return np.asarray(np.where(np.abs(turned) > 1.0, turned * (1.0 - EPS), turned))


def roots_of_one(chain: Chain, units: UnitPairs, k: int) -> Eigenpairs:
    """Return k pairs (or one more) of eigenvalues of modulus 1 other than 1, closest to 1 first.

    A closed class of period d has each d-th root w of 1 once. Its right vector is the stationary
    distribution and its left vector is 1 in the class, both turned by w once for each step of the
    period; on the transient states the left vector solves L (w I - M) = 0.
    """
    structure, n = chain.structure, len(chain)
    classes = np.flatnonzero(structure.closed).tolist()
    periods = structure.periods[classes].tolist()
    turns = [(t / d, i, t) for i, d in enumerate(periods) for t in range(1, d // 2 + 1)]
    values: list[complex] = []
    left, right = np.zeros((0, n)), np.zeros((n, 0))
    outside = np.flatnonzero(~structure.recurrent)
    out = evened(chain)[:, outside] if turns and len(outside) else None
    for share, i, turn in sorted(turns):
        if len(values) >= k:
            break
        period = periods[i]
        roots = np.exp(2j * np.pi * np.arange(period) / period)
        roots[np.arange(period) * 2 == period] = -1.0
        turned = roots[turn * structure.phases % period]
        row = np.where(structure.label == classes[i], turned, 0.0)
        if out is not None:
            row[outside] = _turned_chances(out[outside], roots[turn], out.T @ row)
        column = units.right[:, i] * turned.conj()
        if share == 0.5:
            values.append(-1.0)
            rows, columns = [row.real], [column.real]
        else:
            values += [roots[turn], roots[turn].conj()]
            rows, columns = [2.0 * row.real, -2.0 * row.imag], [column.real, column.imag]
        left, right = np.vstack((left, *rows)), np.column_stack((right, *columns))
    return Eigenpairs(np.array(values, dtype=complex), left, right)


def _turned_chances(T: csc_array, root: complex, entered: NDArray[Any]) -> NDArray[Any]:
    """Return x with x (root I - T) = entered, for transient states T."""
    A = csc_array((diags_array(np.full(len(entered), root)) - T).T)
    try:
        return np.asarray(scipy.sparse.linalg.splu(A).solve(entered.astype(complex)))
    except RuntimeError:
        raise AccuracyError(
            "the chain circles among transient states for so long that the eigenvectors of "
            "modulus 1 can't be told apart. Ask only for eigenvalues of 1, or use "
            "stochastic_limit."
        ) from None


def no_basis(k: int, ones: int | None = None, residual: float = np.inf) -> AccuracyError:
    """Return the error for a matrix without k independent eigenvectors."""
    fewer = "" if ones is None else f" (k={ones} gives just the limit)"
    return AccuracyError(
        f"{k} independent eigenvectors couldn't be found (residual {residual:.1e}): either the "
        "matrix is defective or nearly so, or k cuts through a repeated eigenvalue. Ask for "
        f"fewer{fewer}, or use stochastic_limit and spectral_gap."
    )


def _dense_others(M: csc_array, apart: Eigenpairs, k: int) -> Eigenpairs:
    """Return k other pairs in LAPACK's form: conjugates adjacent, in real parts.

    If all pairs are known with these, the left vectors are omitted: they follow from the right
    ones.
    """
    n = M.shape[0]
    real, imaginary, left, right, failed = dgeev(
        M.toarray(order="F"),
        compute_vl=len(apart.values) + k < n,
        lwork=int(dgeev_lwork(n)[0]),
        overwrite_a=True,
    )
    if failed:
        raise no_basis(k)
    values = real + 1j * imaginary
    # Moduli that differ only by rounding are ties.
    order: Places = np.lexsort((-np.abs(imaginary), -real, -np.abs(values).round(10)))
    for value in apart.values:
        order = np.delete(order, np.argmin(np.abs(values[order] - value)))
    order = _whole_pairs(values, order, k)
    left = left.T[order] if len(left) == n else right.T[:0]
    return Eigenpairs(values[order], left, right[:, order])


def _sparse_others(M: csc_array, apart: Eigenpairs, k: int) -> Eigenpairs:
    n = M.shape[0]
    factors: Any = scipy.sparse.linalg.splu(csc_array(SHIFT * scipy.sparse.eye_array(n) - M))
    by_side = []
    for way, project, basis in (("N", apart.left, apart.right), ("T", apart.right.T, apart.left.T)):

        def resolvent(
            x: NDArray[Any], way: str = way, project: Any = project, basis: Any = basis
        ) -> Any:
            """Return (SHIFT I - M)^-1 x, or its transpose's, with the known pairs projected out."""
            x = factors.solve(x - basis @ (project @ x), way)
            return x - basis @ (project @ x)

        operator = scipy.sparse.linalg.LinearOperator((n, n), matvec=resolvent, dtype=float)
        start = np.random.default_rng(0).standard_normal(n)
        try:
            by_side.append(scipy.sparse.linalg.eigs(operator, k=min(k + 1, n - 2), v0=start))
        except scipy.sparse.linalg.ArpackNoConvergence as error:
            raise AccuracyError(
                f"the iteration for {k} of {n} eigenvalues didn't converge. Ask for fewer."
            ) from error
    (values, right), (turned, left) = by_side
    # The two runs may list the eigenvalues in different orders.
    partner = [int(np.argmin(np.abs(turned - value))) for value in values]
    values = SHIFT - 1.0 / values
    order: Places = np.lexsort((-values.imag, np.abs(values.imag), -values.real))
    order = _whole_pairs(values, order, k)
    values, left, right = values[order], left.T[partner][order], right[:, order]
    lower = np.flatnonzero(values.imag < 0.0)
    rows, columns = left.real.copy(), right.real.copy()
    rows[lower], columns[:, lower] = left[lower].imag, -right[:, lower].imag
    return Eigenpairs(values, rows, columns)


EPS = float(np.finfo(float).eps)
_FEW, _MUCH_WORK = 1000, 1e11
"""Number of states factored regardless of their graph; beyond it, a limit on multiplications."""


class UnitPairs:
    """The eigenvectors of eigenvalue 1 for a chain with n states.

    Every method raises AccuracyError if no bound on the errors is found.
    """

    def __init__(self, chain: Chain) -> None:
        self._chain = chain
        structure = chain.structure
        number = np.full(structure.count, -1)
        number[structure.closed] = np.arange(structure.closed.sum())
        self._class = number[structure.label]
        """The number of each state's closed class, -1 if the state is transient."""
        self.count = int(structure.closed.sum())

    @cached_property
    def right(self) -> Floats:
        """The stationary distributions; shape (n, closed classes)."""
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

        The product L v must be accurate to about one rounding; see `limit_by`.
        """
        return self._all_laws[1] + self._chances[1] + 2.0 * EPS

    def limit(self, v: Floats) -> tuple[Floats, float]:
        """Return the limit R (L v), and a bound on the sum of its errors.

        One solve gives L v; the rest of L is not calculated.
        """
        arcs = self._chain.arcs
        seen = reachable(arcs.size, arcs.sources, arcs.targets, v > 0.0)
        visits, lost = np.zeros(arcs.size), 0.0
        states = np.flatnonzero(seen & (self._class < 0))
        if len(states):
            visits[states], missed = self._equations(states).forward.near(v[states])
            lost = float(missed.sum())
        entering = (self._class[arcs.sources] < 0) & (self._class[arcs.targets] >= 0)
        flow = arcs.chances[entering] * visits[arcs.sources[entering]]
        own = np.flatnonzero(self._class >= 0)
        into = self._class[np.concatenate((own, arcs.targets[entering]))]
        chances = sums(into, np.concatenate((v[own], flow)), self.count)
        law, error = self._laws(chances > 0.0)
        return law * np.where(self._class < 0, 0.0, chances[self._class]), lost + error + 6.0 * EPS

    @cached_property
    def _all_laws(self) -> tuple[Floats, float]:
        return self._laws(np.ones(self.count, dtype=bool))

    def _laws(self, wanted: Bools) -> tuple[Floats, float]:
        """Return the wanted closed classes' distributions, by state, and an error bound for each.

        If x = 1 at the state that is cut out of a class, the distribution is x over its sum. If x
        is off by e, the distribution is off by no more than 2 sum |e|.
        """
        law = np.zeros(len(self._chain))
        here = self._class >= 0
        here[here] = wanted[self._class[here]]
        alone = here & (np.diff(self._chain.arcs.indptr) == 0)
        law[alone] = 1.0
        states = np.flatnonzero(here & ~alone)
        if not len(states):
            return law, 0.0
        arcs = self._chain.arcs
        out = np.bincount(arcs.sources, arcs.chances, arcs.size)
        likely = spread(arcs.matrix(), np.where(out > 0.0, out, 1.0))
        order = np.lexsort((likely[states], self._class[states]))
        last = np.append(np.diff(self._class[states[order]]) > 0, True)
        law[states[order[last]]] = 1.0
        rest = states[law[states] == 0.0]
        equations = self._equations(rest).forward
        law[rest], missed = equations.near((arcs.matrix() @ law)[rest])
        total = sums(self._class[states], law[states], self.count)
        law[states] /= total[self._class[states]]
        return law, 2.0 * float(equations.error(missed).sum()) + 4.0 * EPS

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
        place = np.full(arcs.size, -1)
        place[states] = np.arange(len(states))
        entering = (place[arcs.sources] >= 0) & (place[arcs.targets] < 0)
        sources, targets = place[arcs.sources[entering]], self._class[arcs.targets[entering]]
        ways = targets * len(states) + sources
        into = sums(ways, arcs.chances[entering], self.count * len(states))
        equations = self._equations(states).backward
        missed = np.zeros(len(states))
        for row, column in zip(left, into.reshape(self.count, -1), strict=True):
            row[states], more = equations.near(column)
            missed += more
        return left, float(equations.error(missed).max()) + 4.0 * EPS

    def _equations(self, states: Places) -> CertifiedSolve:
        """Return the factored equations of some states.

        Raises AccuracyError if factoring would take too long, or if the factors are singular in
        floating point.
        """
        arcs, leak = self._chain.arcs.among(states)
        T, m = arcs.matrix(), len(states)
        work = sum(front.work for front in dissect(neighbors(T))[1]) if m > _FEW else 0.0
        if work > _MUCH_WORK:
            raise AccuracyError(
                f"a block of {m:,} states that can't be split would take about {work:.0e} "
                "multiplications to factor, too many for eigenvectors. Use elimination, as "
                "stochastic_limit does."
            )
        return CertifiedSolve(T, leak, factored=True)


def limit_by(right: NDArray[Any], left: NDArray[Any], v: Floats) -> Floats:
    """Return the limit R (L v) by the eigenvectors of 1, with L v accurate to one rounding.

    >>> limit_by(np.eye(2), np.array([[1.0, 0.25], [0.0, 0.75]]), np.array([0.5, 0.5]))
    array([0.625, 0.375])
    """
    chances = [math.fsum(row) for row in left.real[:, v > 0.0] * v[v > 0.0]]
    return np.asarray(right.real @ np.array(chances))
