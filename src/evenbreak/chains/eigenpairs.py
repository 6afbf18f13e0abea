"""Eigenvectors of a transition matrix: inverse iteration, LAPACK (small) and ARPACK (large).

The structure says how often eigenvalue 1 occurs and where its vectors live: once for each
closed class, whose right vector is the stationary law and whose left vector is the chance
of ending there. Each is computed separately, so other eigenvalues may be as close to 1 as
they like without mixing in, and each comes with a bound on its error (see `certified_lu`).
A closed class of period d also has the other d-th roots of 1. All other vectors are
projected off these and made biorthogonal,

    L = (Y R)^-1 Y for left vectors Y and right vectors R,

which exists if neither set is defective and both belong to the same eigenvalues.

References: Golub and Van Loan, Matrix Computations, chapter 7, for inverse iteration and
LAPACK's QR algorithm; Lehoucq, Sorensen and Yang 1998 for ARPACK.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg
from scipy.sparse import csc_array, diags_array

from evenbreak.chains.certified_lu import CertifiedLU
from evenbreak.chains.powers import evened
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places
    from evenbreak.chains.chain import Chain

DENSE = 1000
"""Up to this many states LAPACK finds all eigenvalues at once."""
TOLERANCE = 1e-8
"""Residuals and error estimates above this are refused."""
SHIFT = 1.0 + 1e-10
"""As close to eigenvalue 1 as a factorisation can be made."""
EPS = float(np.finfo(float).eps)
_WIDE_EPS = float(np.finfo(np.longdouble).eps)
_FLOOR = 1e-3


class UnitPairs:
    """The vectors of eigenvalue 1, and the inverse of SHIFT I - M on all the rest.

    Attributes
    ----------
    right
        shape (n, closed classes): the stationary laws.
    left
        shape (closed classes, n): the chances of ending in each class.
    error
        a bound on the sum of the absolute errors of the limit that they give, from any
        state; inf if no bound was found.
    """

    def __init__(self, chain: Chain) -> None:
        self._chain = chain
        structure = chain.structure
        closed = np.flatnonzero(structure.closed)
        n = len(chain)
        self.right, self.left = np.zeros((n, len(closed))), np.zeros((len(closed), n))
        worst = 0.0
        with np.errstate(all="ignore"):  # what overflows gets no bound, and is refused
            for i, label in enumerate(closed.tolist()):
                states = structure.members(label)
                self.left[i, states] = 1.0
                self.right[states, i], error = _law(chain, np.sort(states))
                worst = max(worst, error)
            self.error = float(worst + self._set_chances() + rounding_of_limit(n))

    def _set_chances(self) -> float:
        """Fill in the chances from the transient states; return a bound on their error."""
        chain = self._chain
        states = np.flatnonzero(~chain.structure.recurrent)
        if not len(states):
            return 0.0
        solves = CertifiedLU.of_states(chain.arcs, states)
        into = (chain.arcs.matrix().astype(np.longdouble)[:, states]).tocsr()
        missed = np.zeros(len(states), dtype=np.longdouble)
        for row in self.left:
            entered = into.T @ row.astype(np.longdouble)
            row[states] = solves.solve(entered.astype(np.float64), transposed=True)
            missed += solves.missed(row[states], entered, transposed=True)
        return float(solves.error(missed, transposed=True, floor=_FLOOR).max())


def limit_by(
    right: NDArray[Any], left: NDArray[Any], v: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the limit R (L v) by the vectors of eigenvalue 1; see `rounding_of_limit`.

    >>> limit_by(np.eye(2), np.array([[1.0, 0.25], [0.0, 0.75]]), np.array([0.5, 0.5]))
    array([0.625, 0.375])
    """
    chances = [float(row.real.astype(np.longdouble) @ v) for row in left]
    return np.asarray(right.real @ np.array(chances))


def rounding_of_limit(n: int) -> float:
    """Return a bound on the sum of the rounding errors of `limit_by`, over n states.

    A chance L v of ending in a class is a sum in extended precision of terms that are not negative,
    rounded once to a float. A state is in one closed class at most, so that R times the chances has
    one product for it, rounded once more, and beside it only zeros. All are relative errors of
    numbers that sum to 1.
    """
    return 2.0 * EPS + (n + 2) * _WIDE_EPS


def _shifted(M: csc_array, n: int) -> csc_array:
    return csc_array(SHIFT * scipy.sparse.eye_array(n) - M)


def _law(chain: Chain, states: Places) -> tuple[NDArray[np.float64], float]:
    """Return the stationary law of a closed class and a bound on its sum of errors.

    A likely state, found by one step of inverse iteration, is cut out; the others then solve
    A x = the arcs out of it. If x misses these equations by m and a = A^-1 m, the law is off
    by a - law sum(a), which is no more than 2 sum |a|.
    """
    m = len(states)
    if m == 1:
        return np.ones(1), 0.0
    M = evened(chain)[:, states][states]
    guess = scipy.sparse.linalg.splu(_shifted(M, m)).solve(np.full(m, 1.0 / m))
    cut = int(np.argmax(guess))
    rest = np.delete(np.arange(m), cut)
    solves = CertifiedLU.of_states(chain.arcs, states[rest])
    out = chain.arcs.matrix()[:, [int(states[cut])]].toarray()[states[rest], 0]
    law = np.ones(m)
    law[rest] = solves.solve(out)
    law /= law.sum()
    missed = solves.missed(law[rest], out.astype(np.longdouble) * law[cut])
    return law, 2.0 * float(solves.error(missed, floor=_FLOOR).sum()) + m * EPS


class Eigenpairs(NamedTuple):
    """Eigenvalues, those of conjugate pairs one after the other, the upper first; real vectors.

    The right vectors x + iy and x - iy of a conjugate pair stand as x and y, its left vectors
    x + iy and x - iy as 2x and -2y, so that products L R stay what they are.

    Parameters
    ----------
    values
        shape (k,).
    left, right
        shapes (k, n) and (n, k).
    """

    values: NDArray[Any]
    left: NDArray[np.float64]
    right: NDArray[np.float64]

    def and_then(self, more: Eigenpairs) -> Eigenpairs:
        """Return these pairs and more."""
        return Eigenpairs(
            np.concatenate((self.values, more.values)),
            np.vstack((self.left, more.left)),
            np.hstack((self.right, more.right)),
        )

    def first(self, k: int, order: Places) -> Eigenpairs:
        """Return the first k in an order, or one more, so that no conjugate pair is parted."""
        order = order[: k + int(k > 0 and self.values[order[k - 1]].imag > 0.0)]
        return Eigenpairs(self.values[order], self.left[order], self.right[:, order])

    def missed(self, M: NDArray[Any] | csc_array) -> float:
        """Return the largest entry of M R - R diag(values), L M - diag(values) L and L R - I."""
        above = self.values.imag.clip(0.0)[:-1]
        turn: Any = diags_array(self.values.real) + diags_array(above, offsets=1)
        turn = turn - diags_array(above, offsets=-1)
        return max(
            float(np.abs(M @ self.right - self.right @ turn).max()),
            float(np.abs(self.left @ M - turn @ self.left).max()),
            float(np.abs(self.left @ self.right - np.eye(len(self.values))).max()),
        )

    def in_complex(self) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
        """Return the values and the left and right vectors as they are; real if all are real."""
        upper = np.flatnonzero(self.values.imag > 0.0)
        if not len(upper):
            return self.values.real, self.left, self.right
        left, right = self.left.astype(complex), self.right.astype(complex)
        left[upper] = (self.left[upper] - 1j * self.left[upper + 1]) / 2.0
        right[:, upper] += 1j * self.right[:, upper + 1]
        left[upper + 1], right[:, upper + 1] = left[upper].conj(), right[:, upper].conj()
        return self.values, left, right


def _of_real_matrix(
    values: NDArray[Any], left: NDArray[Any], right: NDArray[Any], order: Places, k: int
) -> Eigenpairs:
    """Return the first k pairs in an order in which conjugate ones stand together."""
    ordered = values[order]
    whole = ordered.imag == 0.0
    upper = np.flatnonzero((ordered.imag[:-1] > 0.0) & (ordered[:-1].conj() == ordered[1:]))
    whole[upper] = whole[upper + 1] = True
    order = order[whole]
    if len(order) < k:
        raise no_basis(k)
    values, left, right = values[order], left[order], right[:, order]
    upper = np.flatnonzero(values.imag > 0.0)
    rows, columns = left.real.copy(), right.real.copy()
    rows[upper] *= 2.0
    rows[upper + 1] = -2.0 * left[upper].imag
    columns[:, upper + 1] = right[:, upper].imag
    return Eigenpairs(values, rows, columns).first(k, np.arange(len(order)))


def leading_pairs(chain: Chain, units: UnitPairs, k: int) -> tuple[Eigenpairs, float]:
    """Return the k leading pairs of a chain, or one more, and by how much they are missed.

    Those of eigenvalue 1 come first.

    Raises
    ------
    AccuracyError
        if there are no k independent vectors, or the iteration does not converge.
    """
    n, ones = units.right.shape
    M = evened(chain)
    known = Eigenpairs(np.ones(ones), units.left, units.right)
    known = known.and_then(roots_of_one(chain, units, k - ones))
    missing = k - (len(known.values) if n <= DENSE else ones)
    pairs, order = known, np.arange(len(known.values))
    if missing > 0:
        others = (_dense_others if n <= DENSE else _sparse_others)(M, known, missing)
        # The known vectors are exact; only the others are adjusted.
        left = others.left - (others.left @ known.right) @ known.left
        right = others.right - known.right @ (known.left @ others.right)
        try:
            left = np.asarray(np.linalg.solve(left @ right, left), dtype=np.float64)
        except np.linalg.LinAlgError:
            raise no_basis(k, ones) from None
        pairs = known.and_then(Eigenpairs(others.values, left, right))
        order = np.arange(len(pairs.values))
        if n > DENSE:
            order = np.argsort(np.abs(pairs.values - 1.0), kind="stable")
    pairs = pairs.first(k, order)
    missed = pairs.missed(M.toarray() if n <= DENSE else M)
    if not missed <= TOLERANCE:
        raise no_basis(k, ones, missed)
    return pairs, missed


def within_unit_disc(values: NDArray[Any]) -> NDArray[Any]:
    """Return eigenvalues of a stochastic matrix with those beyond the unit circle put on it.

    The true ones lie in the disc, so that this brings none further from its own.

    >>> within_unit_disc(np.array([1.0, -1.0000000000000007, 0.5]))
    array([ 1. , -1. ,  0.5])
    """
    turned = values / np.maximum(np.abs(values), 1.0)
    return np.asarray(np.where(np.abs(turned) > 1.0, turned * (1.0 - EPS), turned))


def roots_of_one(chain: Chain, units: UnitPairs, k: int) -> Eigenpairs:
    """Return k pairs of eigenvalues of modulus 1 other than 1, or one more, those next to 1 first.

    A closed class of period d has each d-th root w of 1 once. Its right vector is the
    stationary law and its left vector is 1 in the class, both turned by w once for each step
    of the period; on the transient states the left vector solves L (w I - M) = 0.
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
            "transient states go round for too long to tell the eigenvectors of modulus 1 "
            "apart; ask for the eigenvalues 1 alone, or use stochastic_limit"
        ) from None


def no_basis(k: int, ones: int | None = None, residual: float = np.inf) -> AccuracyError:
    """Return the error for a matrix without k independent eigenvectors."""
    fewer = "" if ones is None else f" (k={ones}: the limit alone)"
    return AccuracyError(
        f"no {k} independent eigenvectors were found (residual {residual:.1e}): the matrix is "
        "defective or nearly so, or k cuts through a repeated eigenvalue; ask for fewer"
        f"{fewer}, or use stochastic_limit and spectral_gap"
    )


def _dense_others(M: csc_array, known: Eigenpairs, k: int) -> Eigenpairs:
    values, left, right = scipy.linalg.eig(M.toarray(), left=True, right=True)
    # Moduli that differ only by rounding are ties; LAPACK has conjugate pairs together.
    order = np.lexsort((-np.abs(values.imag), -values.real, -np.abs(values).round(10)))
    for value in known.values:
        order = np.delete(order, np.argmin(np.abs(values[order] - value)))
    return _of_real_matrix(values, left.conj().T, right, order, k)


def _sparse_others(M: csc_array, known: Eigenpairs, k: int) -> Eigenpairs:
    n = M.shape[0]
    factors: Any = scipy.sparse.linalg.splu(_shifted(M, n))
    found = []
    for way, one, other in (("N", known.left, known.right), ("T", known.right.T, known.left.T)):

        def resolvent(x: NDArray[Any], way: str = way, one: Any = one, other: Any = other) -> Any:
            """Return (SHIFT I - M)^-1 x, or the transpose's, with the known pairs projected out."""
            x = factors.solve(x - other @ (one @ x), way)
            return x - other @ (one @ x)

        operator = scipy.sparse.linalg.LinearOperator((n, n), matvec=resolvent, dtype=float)
        start = np.random.default_rng(0).standard_normal(n)
        try:
            found.append(scipy.sparse.linalg.eigs(operator, k=min(k + 1, n - 2), v0=start))
        except scipy.sparse.linalg.ArpackNoConvergence as error:
            raise AccuracyError(
                f"the iteration for {k} eigenvalues of {n} did not converge; ask for fewer"
            ) from error
    (values, right), (turned, left) = found
    # The two runs may list the eigenvalues in different orders.
    partner = [int(np.argmin(np.abs(turned - value))) for value in values]
    values = SHIFT - 1.0 / values
    order = np.lexsort((-values.imag, np.abs(values.imag), -values.real))
    return _of_real_matrix(values, left.T[partner], right, order, k)
