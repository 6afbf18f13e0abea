"""Eigenvectors of a transition matrix: inverse iteration, LAPACK (small) and ARPACK (large).

The vectors of eigenvalue 1 come from inverse iteration with one sparse factorisation of
sigma I - M, sigma just above 1: begun from the uniform law of each closed class and from its
indicator, it stays with that class, however often the eigenvalue repeats. The others are
made biorthogonal to them: L = (Y R)^-1 Y for left vectors Y and right vectors R, which
exists where neither set is defective and both belong to the same eigenvalues.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg

from evenbreak.chains.steps import evened
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.chain import Chain

__all__ = ["DENSE", "TOLERANCE", "UnitPairs", "leading_pairs", "no_basis"]

DENSE = 1000
"""Up to this many states LAPACK finds all eigenvalues at once."""
TOLERANCE = 1e-8
"""Residuals and error estimates above this are refused."""
SHIFT = 1.0 + 1e-10
"""As near to eigenvalue 1 as a factorisation bears."""


class UnitPairs:
    """The vectors of eigenvalue 1, and the inverse of SHIFT I - M on all the rest.

    Attributes
    ----------
    right
        shape (n, closed classes): the stationary laws.
    left
        shape (closed classes, n): the chances to end in each class.
    """

    def __init__(self, chain: Chain) -> None:
        structure = chain.structure
        M = evened(chain)
        self.size = len(chain)
        self.factors = scipy.sparse.linalg.splu(
            (SHIFT * scipy.sparse.eye_array(self.size) - M).tocsc()
        )
        closed = [structure.members(int(c)) for c in np.flatnonzero(structure.closed)]
        right = np.zeros((self.size, len(closed)))
        for i, states in enumerate(closed):
            right[states, i] = 1.0 / len(states)
        left = (right > 0.0).T.astype(float)
        for _ in range(3):
            right = self.factors.solve(right)
            right /= right.sum(axis=0)
            left = self._solve_transposed(left.T).T * (SHIFT - 1.0)
        self.right, self.left = right, np.asarray(np.linalg.solve(left @ right, left))

    def _solve_transposed(self, y: NDArray[Any]) -> NDArray[Any]:
        return np.asarray(self.factors.solve(y, trans="T"))  # type: ignore[call-overload]

    def resolvent(self, x: NDArray[Any]) -> NDArray[Any]:
        """Return (SHIFT I - M)^-1 x with the eigenvalues 1 projected out."""
        x = self.factors.solve(x - self.right @ (self.left @ x))
        return np.asarray(x - self.right @ (self.left @ x))

    def resolvent_transposed(self, y: NDArray[Any]) -> NDArray[Any]:
        """Return (SHIFT I - M)^-T y with the eigenvalues 1 projected out."""
        y = self._solve_transposed(y - self.left.T @ (self.right.T @ y))
        return np.asarray(y - self.left.T @ (self.right.T @ y))

    def group_inverse_norm(self) -> float:
        """Return an estimate of the 1-norm of the group inverse of I - M (Higham 2000)."""
        operator = scipy.sparse.linalg.LinearOperator(
            (self.size, self.size),
            matvec=self.resolvent,
            rmatvec=self.resolvent_transposed,
            matmat=self.resolvent,
            rmatmat=self.resolvent_transposed,
            dtype=float,
        )
        # The estimator draws from numpy's global state: not where the answer is at hand.
        if self.size <= DENSE:
            return float(np.abs(self.resolvent(np.eye(self.size))).sum(axis=0).max())
        return float(scipy.sparse.linalg.onenormest(operator))


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
    pairs = _dense_others if len(chain) <= DENSE else _sparse_others
    if k == ones:
        return np.ones(ones), units.left, units.right
    values, left, right = pairs(chain, units, k - ones)
    left, right = np.vstack([units.left, left]), np.hstack([units.right, right])
    overlap = left @ right
    if not np.linalg.cond(overlap) <= 1.0 / TOLERANCE:
        raise no_basis(k, ones, np.inf)
    return np.concatenate([np.ones(ones), values]), np.linalg.solve(overlap, left), right


def no_basis(k: int, ones: int, residual: float) -> AccuracyError:
    """Return the error for a matrix without k independent eigenvectors."""
    return AccuracyError(
        f"no {k} independent eigenvectors were found (residual {residual:.1e}): the matrix is "
        "defective or nearly so, or k cuts through a repeated eigenvalue; ask for fewer "
        f"(k={ones}: the limit alone), or use stochastic_limit and spectral_gap"
    )


def _dense_others(
    chain: Chain, units: UnitPairs, k: int
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    values, left, right = scipy.linalg.eig(evened(chain).toarray(), left=True, right=True)
    # Moduli that differ by rounding are ties, so that conjugate pairs stay together.
    order = np.lexsort((-values.imag, -values.real, -np.abs(values).round(10)))
    ones = np.argsort(np.abs(values - 1.0), kind="stable")[: units.right.shape[1]]
    order = order[~np.isin(order, ones)][:k]
    return values[order], left[:, order].conj().T, right[:, order]


def _sparse_others(
    chain: Chain, units: UnitPairs, k: int
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
