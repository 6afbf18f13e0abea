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

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg
from scipy.sparse import csc_array

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

    @cached_property
    def _factors(self) -> Any:
        n = len(self._chain)
        return scipy.sparse.linalg.splu(_shifted(evened(self._chain), n))

    def resolvent(self, x: NDArray[Any]) -> NDArray[Any]:
        """Return (SHIFT I - M)^-1 x with the eigenvalues 1 projected out."""
        x = self._factors.solve(x - self.right @ (self.left @ x))
        return np.asarray(x - self.right @ (self.left @ x))

    def resolvent_transposed(self, y: NDArray[Any]) -> NDArray[Any]:
        """Return (SHIFT I - M)^-T y with the eigenvalues 1 projected out."""
        y = self._factors.solve(y - self.left.T @ (self.right.T @ y), trans="T")
        return np.asarray(y - self.left.T @ (self.right.T @ y))


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


def leading_pairs(
    chain: Chain, units: UnitPairs, k: int
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Return k leading eigenvalues, the left vectors as rows and the right ones as columns.

    Those of eigenvalue 1 come first.

    Raises
    ------
    AccuracyError
        if there are no k independent vectors, or the iteration does not converge.
    """
    ones = units.right.shape[1]
    known: tuple[NDArray[Any], NDArray[Any], NDArray[Any]]
    known = np.ones(ones), units.left, units.right
    if k == ones:
        return known
    if len(chain) <= DENSE:
        known = _joined(known, roots_of_one(chain, units))
        known = known[0][:k], known[1][:k], known[2][:, :k]
    if k == len(known[0]):
        return known
    find = _dense_others if len(chain) <= DENSE else _sparse_others
    values, left, right = find(chain, units, known[0], k - len(known[0]))
    # The known vectors are exact; only the others are adjusted.
    left = _normed((left - (left @ known[2]) @ known[1]).T).T
    right = _normed(right - known[2] @ (known[1] @ right))
    overlap = left @ right
    if not (np.isfinite(overlap).all() and np.linalg.cond(overlap) <= 1.0 / TOLERANCE):
        raise no_basis(k, ones, np.inf)
    return _joined(known, (values, np.linalg.solve(overlap, left), right))


def within_unit_disc(values: NDArray[Any]) -> NDArray[Any]:
    """Return eigenvalues of a stochastic matrix with those beyond the unit circle put on it.

    The true ones lie in the disc, so that this brings none further from its own.

    >>> within_unit_disc(np.array([1.0, -1.0000000000000007, 0.5]))
    array([ 1. , -1. ,  0.5])
    """
    turned = values / np.maximum(np.abs(values), 1.0)
    return np.asarray(np.where(np.abs(turned) > 1.0, turned * (1.0 - EPS), turned))


def roots_of_one(chain: Chain, units: UnitPairs) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Return the eigenvalues of modulus 1 other than 1, with left and right vectors.

    A closed class of period d has each d-th root w of 1 once. Its right vector is the
    stationary law and its left vector is 1 in the class, both turned by w once for each step
    of the period; on the transient states the left vector solves L (w I - M) = 0.
    """
    structure, M = chain.structure, evened(chain)
    outside = np.flatnonzero(~structure.recurrent)
    T = csc_array(M[:, outside][outside])
    n = len(chain)
    values: list[complex] = []
    left, right = [np.zeros((0, n))], [np.zeros((n, 0))]
    for i, label in enumerate(np.flatnonzero(structure.closed).tolist()):
        period = int(structure.periods[label])
        roots = np.exp(2j * np.pi * np.arange(period) / period)
        roots[np.arange(period) * 2 == period] = -1.0
        inside = structure.label == label
        # From 1 both ways round, so that conjugate pairs stay together.
        for turn in sorted(range(1, period), key=lambda t: (min(t, period - t), t)):
            turned = roots[turn * structure.phases % period]
            row = np.where(inside, turned, 0.0)
            if len(outside):
                row[outside] = _turned_chances(T, roots[turn], M[:, outside].T @ row)
            values.append(complex(roots[turn]))
            left.append(row[None, :])
            right.append((units.right[:, i] * turned.conj())[:, None])
    return np.array(values, dtype=complex), np.vstack(left), np.hstack(right)


def _turned_chances(T: csc_array, root: complex, entered: NDArray[Any]) -> NDArray[Any]:
    """Return x with x (root I - T) = entered, for transient states T."""
    A = csc_array((scipy.sparse.diags_array(np.full(len(entered), root)) - T).T)
    try:
        return np.asarray(scipy.sparse.linalg.splu(A).solve(entered.astype(complex)))
    except RuntimeError:
        raise AccuracyError(
            "transient states go round for too long to tell the eigenvectors of modulus 1 "
            "apart; ask for the eigenvalues 1 alone, or use stochastic_limit"
        ) from None


def _joined(
    some: tuple[NDArray[Any], NDArray[Any], NDArray[Any]],
    more: tuple[NDArray[Any], NDArray[Any], NDArray[Any]],
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    values, left, right = zip(some, more, strict=True)
    return np.concatenate(values), np.vstack(left), np.hstack(right)


def _normed(columns: NDArray[Any]) -> NDArray[Any]:
    lengths = np.linalg.norm(columns, axis=0)
    return np.asarray(columns / np.where(lengths > 0.0, lengths, 1.0))


def no_basis(k: int, ones: int, residual: float) -> AccuracyError:
    """Return the error for a matrix without k independent eigenvectors."""
    return AccuracyError(
        f"no {k} independent eigenvectors were found (residual {residual:.1e}): the matrix is "
        "defective or nearly so, or k cuts through a repeated eigenvalue; ask for fewer "
        f"(k={ones}: the limit alone), or use stochastic_limit and spectral_gap"
    )


def _dense_others(
    chain: Chain, _: UnitPairs, known: NDArray[Any], k: int
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    values, left, right = scipy.linalg.eig(evened(chain).toarray(), left=True, right=True)
    # Moduli that differ only by rounding are ties, so that conjugate pairs stay together.
    order = np.lexsort((-values.imag, -values.real, -np.abs(values).round(10)))
    for value in known:
        order = np.delete(order, np.argmin(np.abs(values[order] - value)))
    order = order[:k]
    return values[order], left[:, order].conj().T, right[:, order]


def _sparse_others(
    chain: Chain, units: UnitPairs, _: NDArray[Any], k: int
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    n = len(chain)
    found = []
    for matvec in (units.resolvent, units.resolvent_transposed):
        operator = scipy.sparse.linalg.LinearOperator((n, n), matvec=matvec, dtype=float)
        start = np.random.default_rng(0).standard_normal(n)
        try:
            found.append(scipy.sparse.linalg.eigs(operator, k=k, v0=start))
        except scipy.sparse.linalg.ArpackNoConvergence as error:
            raise AccuracyError(
                f"the iteration for {k} eigenvalues of {n} did not converge; ask for fewer"
            ) from error
    (values, right), (turned, left) = found
    # The two runs may list the eigenvalues in different orders.
    partner = [int(np.argmin(np.abs(turned - value))) for value in values]
    values = SHIFT - 1.0 / values
    order = np.lexsort((-values.imag, -values.real))
    return values[order], left.T[partner][order], right[:, order]
