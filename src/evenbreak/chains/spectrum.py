"""Eigenvalues and eigenvectors of the transition matrix, and the limit that they give.

M R = R diag(lambda), L M = diag(lambda) L, L R = I. Eigenvalue 1 repeats once for each
closed class; its right vectors are then taken as the stationary laws of those classes and
its left vectors as the chances of ending there, so that the stochastic limit is
sum R_i (L_i v) over the eigenvalues 1 (the source text's derivation after P5.22).

This is the second route to the limit: it shares nothing with the eliminations of
`stochastic_limit` but the chain's arcs and structure, and loses digits where they do not, in
chains that are slow or nearly fall apart. Every answer comes with a bound on its error that
is proved with the answer (see `certified_lu`), and is refused where it cannot be vouched for.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.eigenpairs import DENSE, TOLERANCE, UnitPairs, leading_pairs, no_basis
from evenbreak.chains.mixing import mixing_time, spectral_gap
from evenbreak.chains.powers import evened
from evenbreak.checks import whole
from evenbreak.errors import AccuracyError, ChainError, InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.chain import Chain

MOST_ENTRIES = 20_000_000
"""More entries of vectors than this (k times n) are refused: they fill the memory."""
LEADING = 6
"""Beyond `DENSE` this many eigenvalues are found unless more repeat at 1."""


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Eigenvalues of a chain with their right and left vectors.

    Parameters
    ----------
    chain
        the chain.
    values
        shape (k,): the eigenvalues 1 first, then by falling modulus (beyond 1000 states:
        those nearest to 1 come first).
    right
        shape (n, k): column i is the right vector of eigenvalue i. Those of eigenvalue 1
        are the stationary laws of the closed classes.
    left
        shape (k, n): row i is the left vector of eigenvalue i. Those of eigenvalue 1 are
        P(end in the closed class | start in the state).
    units
        how many eigenvalues are 1: the number of closed classes.
    residual
        the largest absolute entry of `M R - R diag(values)`, `L M - diag(values) L` and `L R - I`.
    limit_error
        bound on the sum of the absolute errors of `limit`, from any start: that of the laws
        in `right` and of the chances in `left` that belong to eigenvalue 1.
    """

    chain: Chain
    values: NDArray[Any]
    right: NDArray[Any]
    left: NDArray[Any]
    units: int
    residual: float
    limit_error: float

    def limit(self, start: Any = None) -> NDArray[np.float64]:
        """Return the stochastic limit by eigenvectors: sum R_i (L_i v) over eigenvalue 1.

        Conditional on `start` (see `Chain.density`). Entries are good to `limit_error`,
        absolutely; `stochastic_limit` is good to every digit of every entry.

        Raises
        ------
        AccuracyError
            if `limit_error` is above 1e-8: the chain is nearly decomposable, or slow.
        """
        self._vouch()
        v = self.chain.density(start)
        return np.asarray((self.right[:, : self.units] @ (self.left[: self.units] @ v)).real)

    @property
    def gap(self) -> float:
        """1 minus the largest modulus of an eigenvalue off the unit circle; see `spectral_gap`."""
        return spectral_gap(self.chain)

    def mixing_time(self, eps: float = 0.25) -> int:
        """Return the steps after which every start is within `eps`; see `mixing_time`."""
        return mixing_time(self.chain, eps)

    def _vouch(self) -> None:
        if not self.limit_error <= TOLERANCE:
            raise AccuracyError(
                f"the limit by eigenvectors may be wrong by {self.limit_error:.1e} "
                f"(residual {self.residual:.1e}): the chain is slow or nearly falls apart; "
                "use stochastic_limit"
            )


def spectrum(chain: Chain, k: int | None = None) -> Spectrum:
    """Return the leading eigenvalues of a chain and their biorthogonal vectors.

    Parameters
    ----------
    chain
        the chain, n states.
    k
        how many eigenvalues: at least the number of closed classes, at most n. By
        default all up to 1000 states, beyond that the 6 nearest to 1 (more if more
        classes are closed).

    Raises
    ------
    InputError
        if k is too small or too large.
    ChainError
        if the vectors would have more than 20 million entries, k times n; a race with many
        scores to end at has an eigenvalue 1 for each.
    AccuracyError
        if the vectors asked for do not exist, or only barely: the matrix is defective
        (every race is: its states empty after finitely many racks, so eigenvalue 0 has
        too few vectors), or k cuts through a repeated eigenvalue. The eigenvalues 1 alone
        (k = number of closed classes) are never defective. Or if other eigenvalues are so
        near to 1 that no bound on the errors of its vectors can be proved.

    Notes
    -----
    Eigenvalue 1 repeats as often as classes are closed, by the structure; its vectors solve
    equations class by class. The others come from LAPACK's geev up to 1000 states; beyond,
    those nearest to 1 from ARPACK in shift-invert mode.

    >>> from evenbreak.chains import Chain
    >>> from scipy.sparse import csc_array
    >>> winner_breaks = Chain((1, 2), csc_array([[0.75, 0.5], [0.25, 0.5]]), 1)
    >>> s = spectrum(winner_breaks)
    >>> s.values.round(12), s.limit().round(12), round(s.gap, 12)
    (array([1.  , 0.25]), array([0.66666667, 0.33333333]), 0.75)
    """
    n = len(chain)
    units = int(chain.structure.closed.sum())
    if k is None:
        k = n if n <= DENSE else min(max(LEADING, units), n)
    k = whole(k, "k", at_least=units)
    if k > n:
        raise InputError(f"k is {k}; the chain has {n} states, give {n} or fewer")
    if k * n > MOST_ENTRIES:
        raise ChainError(
            f"{k} pairs of vectors over {n} states do not fit in memory; ask for fewer, or use "
            "stochastic_limit"
        )
    pairs = UnitPairs(chain)
    if not np.isfinite(pairs.error):
        raise AccuracyError(
            "nothing can be said of the errors of the eigenvectors of eigenvalue 1: the chain "
            "is too slow or too nearly falls apart; use stochastic_limit"
        )
    values, left, right = leading_pairs(chain, pairs, k)
    M = evened(chain)
    residual = max(
        float(np.abs(M @ right - right * values).max()),
        float(np.abs((M.T @ left.T).T - values[:, None] * left).max()),
        float(np.abs(left @ right - np.eye(k)).max()),
    )
    if not residual <= TOLERANCE:
        raise no_basis(k, units, residual)
    return Spectrum(chain, _real(values), _real(right), _real(left), units, residual, pairs.error)


def _real(array: NDArray[Any]) -> NDArray[Any]:
    return array if np.any(array.imag) else np.ascontiguousarray(array.real)
