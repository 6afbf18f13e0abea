"""Eigenvalues and eigenvectors of the transition matrix, and the limit that they give.

M R = R diag(lambda), L M = diag(lambda) L, L R = I. Eigenvalue 1 occurs once for each closed
class; its right vectors are scaled to be the stationary laws of those classes and its left
vectors the chances of ending there, so that the stochastic limit is

    sum over the eigenvalues 1 of R_i (L_i v)

(the source text's derivation after P5.22). This is the second route to the limit. It shares
only the chain's arcs and structure with the eliminations of `stochastic_limit`. Every answer comes
with a proved bound on its error (see `unit_pairs`); what cannot be proved, in chains that nearly
fall apart, is refused.

Where the classes are reversible, as in rating ladders and n-ahead matches, the pairs come from
symmetric matrices instead (see `reversible`): all of them, and all real.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.arrays import Floats, array_values
from evenbreak.chains.chain import check_chain
from evenbreak.chains.eigenpairs import (
    DENSE,
    TOLERANCE,
    UnitPairs,
    leading_pairs,
    limit_by,
    no_basis,
    within_unit_disc,
)
from evenbreak.chains.mixing import mixing_time, spectral_gap
from evenbreak.chains.reversible import DENSE as ALL_REVERSIBLE
from evenbreak.chains.reversible import reversible_classes, reversible_pairs
from evenbreak.checks import whole
from evenbreak.errors import AccuracyError, ChainError, InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.arrays import Floats
    from evenbreak.chains.chain import Chain

MOST_ENTRIES = 20_000_000
"""More entries of vectors than this (k times n) are refused: they would fill the memory."""
LEADING = 6
"""Beyond `DENSE` states, this many eigenvalues are found, or as many as are 1."""


@array_values
@dataclass(frozen=True, eq=False)
class Spectrum:
    """Eigenvalues of a chain with their right and left vectors.

    Parameters
    ----------
    chain
        the chain.
    values
        shape (k,): the eigenvalues 1 first, the others by falling modulus (beyond 1000
        states: those nearest to 1 first); none has a modulus above 1.
    units
        how many eigenvalues are 1: the number of closed classes.
    residual
        the largest entry of `M R - R diag(values)`, `L M - diag(values) L` and `L R - I`, real
        and imaginary parts apart;
        with `orthonormal` vectors Q, that of `S Q - Q diag(values)` and `Q^T Q - I`.
    limit_error
        a bound on the sum of the absolute errors of `limit`, from any start.
    orthonormal
        shape (n, k) for a chain of reversible classes (see `reversible`), otherwise None:
        the eigenvectors Q of the symmetric matrices S = D^-1 M D of the classes. In a closed
        class D holds the square roots of the stationary law.
    right
        shape (n, k): column i is the right vector of eigenvalue i. Those of eigenvalue 1 are the
        stationary laws of the closed classes.
    """

    chain: Chain
    values: NDArray[Any]
    units: int
    residual: float
    limit_error: float
    orthonormal: Floats | None
    right: NDArray[Any] = field(repr=False)
    _left: NDArray[Any] = field(repr=False)

    @property
    def left(self) -> NDArray[Any]:
        """Row i is the left vector of eigenvalue i; shape (k, n).

        Those of eigenvalue 1 are P(end in the closed class | start in the state).

        Raises
        ------
        AccuracyError
            if an entry is larger than any float, because the weights of a reversible class span
            too many decades; the vectors are then in `orthonormal`.
        """
        if not np.isfinite(self._left).all():
            raise AccuracyError(
                "a left vector has entries larger than any float: the stationary law spans too "
                "many decades; use the vectors in `orthonormal`"
            )
        return self._left

    def limit(self, start: Any = None) -> Floats:
        """Return the stochastic limit by eigenvectors: sum R_i (L_i v) over eigenvalue 1.

        It is conditional on `start` (see `Chain.density`). Entries are right to an absolute
        error of `limit_error`; `stochastic_limit` is right in every digit of every entry.

        Raises
        ------
        AccuracyError
            if `limit_error` is above 1e-8: the chain is nearly decomposable, or slow.
        """
        if not self.limit_error <= TOLERANCE:
            raise AccuracyError(
                f"the limit by eigenvectors may be wrong by {self.limit_error:.1e} "
                f"(residual {self.residual:.1e}): the chain is slow or nearly falls apart; "
                "use stochastic_limit"
            )
        v = self.chain.density(start)
        return limit_by(self.right[:, : self.units], self._left[: self.units], v)

    @property
    def gap(self) -> float:
        """1 minus the largest modulus of an eigenvalue off the unit circle; see `spectral_gap`."""
        return spectral_gap(self.chain)

    def mixing_time(self, eps: float = 0.25) -> int:
        """Return the steps after which every start is within `eps` of its limit."""
        return mixing_time(self.chain, eps)


def spectrum(chain: Chain, k: int | None = None) -> Spectrum:
    """Return the leading eigenvalues of a chain and their biorthogonal vectors.

    Parameters
    ----------
    chain
        the chain, n states.
    k
        how many eigenvalues: at least the number of closed classes, at most n. By
        default all of them up to 1000 states (2000 where the classes are reversible),
        beyond that the 6 nearest to 1 (more if more classes are closed).

    Raises
    ------
    InputError
        if k is too small or too large.
    ChainError
        if the vectors would have more than 20 million entries, k times n; a race has an
        eigenvalue 1 for every final score.
    AccuracyError
        if the vectors asked for do not exist, or only barely: the matrix is defective
        (every race is: its states empty after finitely many racks, so eigenvalue 0 has too
        few vectors), or k cuts through a repeated eigenvalue. The eigenvalues 1 alone (k =
        the number of closed classes) are never defective. Also if other eigenvalues are so
        close to 1 that no bound on the errors of its vectors can be proved.

    Notes
    -----
    The structure says how often eigenvalue 1 occurs: once for each closed class; its vectors
    are solved for class by class. The others come from LAPACK's geev up to 1000 states;
    beyond that, those nearest to 1 come from ARPACK in shift-invert mode. For chains of
    reversible classes all of them come from similar symmetric matrices, of which LAPACK finds
    every eigenvector to the last digits, whatever the stationary law.

    >>> from evenbreak.chains import Chain
    >>> from scipy.sparse import csc_array
    >>> winner_breaks = Chain((1, 2), csc_array([[0.75, 0.5], [0.25, 0.5]]), 1)
    >>> s = spectrum(winner_breaks)
    >>> s.values.round(12), s.limit().round(12), round(s.gap, 12)
    (array([1.  , 0.25]), array([0.66666667, 0.33333333]), 0.75)
    """
    check_chain(chain)
    n = len(chain)
    units = int(chain.structure.closed.sum())
    forms = reversible_classes(chain)
    if k is None:
        all_found = n <= (DENSE if forms is None else ALL_REVERSIBLE)
        k = n if all_found else min(max(LEADING, units), n)
    k = whole(k, "k", at_least=units)
    if k > n:
        raise InputError(f"k is {k}; the chain has {n} states, give {n} or fewer")
    if k * n > MOST_ENTRIES:
        raise ChainError(
            f"{k} pairs of vectors over {n} states do not fit in memory; ask for fewer, or find "
            "the limit by elimination (stochastic_limit)"
        )
    ones = UnitPairs(chain)
    if forms is None:
        pairs, residual = leading_pairs(chain, ones, k)
        vectors = None
    else:
        pairs, vectors, residual = reversible_pairs(chain, ones, forms, k)
    if not residual <= TOLERANCE:
        raise no_basis(k, units, residual)
    values, left, right = pairs.in_complex()
    values, left, right = within_unit_disc(values[:k]), left[:k], right[:, :k]
    return Spectrum(chain, values, units, residual, ones.error, vectors, right, left)
