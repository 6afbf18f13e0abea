"""Eigenvectors of reversible chains, from a symmetric matrix that is similar to M.

A class is reversible if some weights w > 0 balance every pair of its arcs, w_j M_ij = w_i M_ji;
in a closed class they are the stationary law. With D = diag(sqrt(w)) the matrix

    S = D^-1 M D,    S_ij = sqrt(M_ij M_ji),

is symmetric, so all eigenvalues are real and there are n orthonormal eigenvectors Q, however
many decades the law spans. M has the right vectors D Q and the left vectors Q^T D^-1. States in
a line are always reversible, and S is then tridiagonal.

The weights come from a tree of arcs that reaches the whole class, as sums of logarithms in
extended precision; the arcs off the tree must agree with them (Kolmogorov's criterion).

References: Kelly 1979, Reversibility and Stochastic Networks, chapter 1; Cuppen 1981 for
LAPACK's divide and conquer (through scipy).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg
import scipy.sparse.linalg
from scipy.sparse import csc_array, csgraph, diags_array

from evenbreak.chains.line_elimination import line_order
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places
    from evenbreak.chains.chain import Chain

    Wide = NDArray[np.longdouble]

DENSE = 2000
"""Up to this many states LAPACK finds all eigenvalues of a class that is not a line."""
_BALANCED = 1e-12
_WIDE_EPS = float(np.finfo(np.longdouble).eps)
_SHIFT = 1.0 + 1e-10


@dataclass(frozen=True, eq=False)
class SymmetricForm:
    """One reversible class: S and the logarithms of D.

    Parameters
    ----------
    states
        positions of the m states in the chain, increasing.
    matrix
        S, sparse, shape (m, m), in the order of `states`.
    height
        shape (m,): log2 of the weight of each state, the largest being 0.
    height_error
        a bound on the errors of `height`; None if arcs off the tree might disagree with them.
    line
        the order in which the states stand in a line, or None.
    """

    states: Places
    matrix: csc_array
    height: Wide
    height_error: float | None
    line: Places | None

    @cached_property
    def law(self) -> NDArray[np.float64]:
        """The weights scaled to sum to 1: the stationary law if the class is closed."""
        weights = np.exp2(self.height)
        return np.asarray(weights / weights.sum(), dtype=np.float64)

    @cached_property
    def roots(self) -> Wide:
        """The diagonal of D, the square root of the law; it may span what floats cannot hold."""
        total = np.log2(np.exp2(self.height).sum())
        return np.asarray(np.exp2((self.height - total) / 2))

    def pairs(self, k: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return k eigenvalues of S, ascending, and their orthonormal vectors as columns.

        All m of them up to `DENSE` states; beyond that those nearest to 1.

        Raises
        ------
        AccuracyError
            if the iteration for a large class does not converge.
        """
        m = len(self.states)
        if self.line is not None:
            S = csc_array(self.matrix[:, self.line])[self.line]
            some: dict[str, Any] = {}
            if k < m and m > DENSE:
                some = {"select": "i", "select_range": (m - k, m - 1)}
            values, along = scipy.linalg.eigh_tridiagonal(S.diagonal(), S.diagonal(1), **some)
            vectors = np.empty_like(along)
            vectors[self.line] = along
            return np.asarray(values), vectors
        if m <= DENSE or k >= m - 1:
            values, vectors = scipy.linalg.eigh(self.matrix.toarray(), driver="evd")
            return np.asarray(values), np.asarray(vectors)
        start = np.random.default_rng(0).standard_normal(m)
        try:
            found = scipy.sparse.linalg.eigsh(self.matrix, k=k, sigma=_SHIFT, v0=start)
        except scipy.sparse.linalg.ArpackNoConvergence as error:
            raise AccuracyError(
                f"the iteration for {k} eigenvalues of {m} did not converge; ask for fewer"
            ) from error
        return np.asarray(found[0]), np.asarray(found[1])

    def missed(self, values: NDArray[Any], vectors: NDArray[Any]) -> float:
        """Return the largest entry of S Q - Q diag(values) and of Q^T Q - I."""
        balance = np.abs(self.matrix @ vectors - vectors * values).max(initial=0.0)
        overlap = np.abs(vectors.T @ vectors - np.eye(len(values))).max(initial=0.0)
        return float(max(balance, overlap))


def symmetric_form(chain: Chain, states: Places) -> SymmetricForm | None:
    """Return the symmetric form of one class, or None if the class is not reversible.

    Parameters
    ----------
    chain
        the chain.
    states
        positions of the states of the class, increasing.

    >>> from evenbreak.chains import chain_of
    >>> walk = chain_of([(0, 1, 1.0), (1, 0, 0.2), (1, 2, 0.8), (2, 1, 1.0)])
    >>> form = symmetric_form(walk, np.arange(3))
    >>> form.law, abs(form.pairs(3)[0].round(12))
    (array([0.1, 0.5, 0.4]), array([1., 0., 1.]))
    """
    inner, _ = chain.arcs.among(states)
    there = csc_array(inner.matrix())
    there.sort_indices()
    back = csc_array(there.T)
    back.sort_indices()
    if there.nnz != back.nnz or (there.indices != back.indices).any():
        return None
    logs = np.log2(there.data.astype(np.longdouble)), np.log2(back.data.astype(np.longdouble))
    rise = logs[0] - logs[1]
    height = _heights(there, rise)
    sources = np.repeat(np.arange(len(states)), np.diff(there.indptr))
    if (np.abs(height[there.indices] - height[sources] - rise) > _BALANCED).any():
        return None
    beside = csc_array(
        (np.sqrt(there.data) * np.sqrt(back.data), there.indices, there.indptr), shape=there.shape
    )
    loops = chain.matrix.diagonal()[states]
    error = None
    if there.nnz == 2 * (len(states) - 1):
        largest = float(max((np.abs(part).max() for part in logs if len(part)), default=0.0))
        error = 4.0 * _WIDE_EPS * len(states) * (largest + 1.0)
    return SymmetricForm(
        states, csc_array(beside + diags_array(loops)), height, error, line_order(there)
    )


def _heights(T: csc_array, rise: Wide) -> Wide:
    """Return log2 of the weights along a tree; entry k of T leads up by `rise[k]`."""
    size = T.shape[0]
    _, parent = csgraph.breadth_first_order(T, 0)
    height = np.zeros(size, dtype=np.longdouble)
    number = csc_array((np.arange(1, T.nnz + 1), T.indices, T.indptr), shape=T.shape)
    below = np.arange(1, size)
    if size > 1:
        height[1:] = rise[np.asarray(number[below, parent[1:]]).reshape(-1) - 1]
        parent[0] = 0
        # Pointer jumping: after k rounds `parent` is the ancestor 2^k steps above.
        while parent.any():
            height += height[parent]
            parent = parent[parent]
    return np.asarray(height - height.max())
