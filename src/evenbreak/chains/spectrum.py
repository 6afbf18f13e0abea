"""Eigenvalues and eigenvectors of the transition matrix, and the resulting limit.

M R = R diag(lambda), L M = diag(lambda) L, L R = I. Eigenvalue 1 occurs once for each closed
class; its right vectors are scaled to be the stationary distributions of those classes and its left
vectors the chances of ending there, so that the stochastic limit is

    sum over the eigenvalues 1 of R_i (L_i v)

(the source text's derivation after P5.22). This is the second route to the limit. It shares
only the chain's arcs and structure with the eliminations of `stochastic_limit`. Every answer comes
with a proved bound on its error (see `eigenpairs`); if no bound can be proved, as in nearly
decomposable chains, an error is raised.

If the classes are reversible, as in rating ladders and n-ahead matches, the pairs come from
symmetric matrices instead: all of them are found, and all are real.

A class is reversible if some weights w > 0 balance every pair of its arcs, w_j M_ij = w_i M_ji;
in a closed class they are the stationary distribution. With D = diag(sqrt(w)) the matrix

    S = D^-1 M D,    S_ij = sqrt(M_ij M_ji),

is symmetric, so all eigenvalues are real and there are n orthonormal eigenvectors Q, no matter how
many decades the distribution spans. M has the right vectors D Q and the left vectors Q^T D^-1.
States in a line are always reversible, and S is then tridiagonal. The weights come from a tree of
arcs that reaches the whole class, as products of pairs of doubles with their exponents apart; the
arcs off the tree must agree with them (Kolmogorov's criterion).

All pairs of a chain are assembled from the pairs of its classes, if it has no transient states or
one transient class between absorbing states, as n-ahead matches have. With T = D S D^-1 the arcs
within the transient class, B the arcs into the absorbing states and S q = lambda q, the pairs of M
are

    R = (D q, B D q / (lambda - 1)),    L = (q^T D^-1, 0);

the pairs of eigenvalue 1 are the absorbing states and the chances of ending there.

References: Kelly 1979, Reversibility and Stochastic Networks, chapter 1; Cuppen 1981 for LAPACK's
divide and conquer (through scipy).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import scipy.linalg
import scipy.sparse.linalg
from numpy.typing import NDArray
from scipy.sparse import csc_array, csgraph, diags_array

from evenbreak.arrays import Floats, array_values
from evenbreak.chains.arcs import Places
from evenbreak.chains.birth_death import line_order
from evenbreak.chains.chain import Chain, check_chain
from evenbreak.chains.double_double import two_product, two_sum
from evenbreak.chains.eigenpairs import (
    DENSE,
    SHIFT,
    TOLERANCE,
    Eigenpairs,
    UnitPairs,
    leading_pairs,
    limit_by,
    no_basis,
    within_unit_disc,
)
from evenbreak.chains.mixing import mixing_time, spectral_gap
from evenbreak.checks import whole
from evenbreak.errors import AccuracyError, ChainError, InputError

MOST_ENTRIES = 20_000_000
"""Limit on the entries in the vectors (k times n): more would fill the memory."""
LEADING = 6
"""Beyond `DENSE` states, this many eigenvalues are found, or as many as are 1."""


@array_values
@dataclass(frozen=True, eq=False)
class Spectrum:
    """Eigenvalues of a chain with their right and left vectors.

    Parameters
    ----------
    values
        shape (k,): the eigenvalues 1 first, then the others by decreasing modulus (beyond 1000
        states: those nearest to 1 first); none has a modulus above 1.
    units
        how many eigenvalues are 1: the number of closed classes.
    residual
        the largest entry of `M R - R diag(values)`, `L M - diag(values) L` and `L R - I`, with real
        and imaginary parts taken separately; with `orthonormal` vectors Q, that of `S Q - Q
        diag(values)` and `Q^T Q - I`.
    limit_error
        a bound on the sum of the absolute errors of `limit`, from any start.
    orthonormal
        shape (n, k) for a chain of reversible classes, otherwise None:
        the eigenvectors Q of the symmetric matrices S = D^-1 M D of the classes. In a closed
        class D holds the square roots of the stationary distribution.
    right
        shape (n, k): column i is the right vector of eigenvalue i. Those of eigenvalue 1 are the
        stationary distributions of the closed classes.
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
                "a left vector has entries too large for a float: the stationary distribution "
                "spans too many orders of magnitude. Use the vectors in `orthonormal`"
            )
        return self._left

    def limit(self, start: Any = None) -> Floats:
        """Return the stochastic limit by eigenvectors: sum R_i (L_i v) over eigenvalue 1.

        It is conditional on `start` (see `Chain.density`). Entries have an absolute error of at
        most `limit_error`; `stochastic_limit` has full relative accuracy in every entry.

        Raises
        ------
        AccuracyError
            if `limit_error` is above 1e-8, because the chain is nearly decomposable or slow.
        """
        if not self.limit_error <= TOLERANCE:
            raise AccuracyError(
                f"the limit from eigenvectors may be wrong by {self.limit_error:.1e} (residual "
                f"{self.residual:.1e}): the chain mixes slowly or nearly falls apart. Use "
                "stochastic_limit."
            )
        v = self.chain.density(start)
        return limit_by(self.right[:, : self.units], self._left[: self.units], v)

    @property
    def gap(self) -> float:
        """1 minus the largest modulus of an eigenvalue off the unit circle; see `spectral_gap`."""
        return spectral_gap(self.chain)

    def mixing_time(self, eps: float = 0.25) -> int:
        """Return the number of steps after which every start is within `eps` of its limit."""
        return mixing_time(self.chain, eps)


def spectrum(chain: Chain, k: int | None = None) -> Spectrum:
    """Return the leading eigenvalues of a chain and their biorthogonal vectors.

    Parameters
    ----------
    k
        how many eigenvalues: at least the number of closed classes, at most n. By default, all of
        them up to 1000 states (2000 if the classes are reversible); beyond that, the 6 nearest to 1
        (more if more classes are closed).

    Raises
    ------
    InputError
        if k is too small or too large.
    ChainError
        if the vectors would have more than 20 million entries, k times n; a race has an
        eigenvalue 1 for every final score.
    AccuracyError
        if the requested vectors do not exist, or barely exist: the matrix is defective (every race
        is: its states empty after finitely many racks, so eigenvalue 0 has too few vectors), or k
        splits a repeated eigenvalue. The eigenvalues 1 alone (k = the number of closed classes) are
        never defective. Also if other eigenvalues are so close to 1 that no bound on the errors of
        its vectors can be proved.

    Notes
    -----
    The structure tells how often eigenvalue 1 occurs: once for each closed class; its vectors are
    solved for class by class. The others come from LAPACK's geev up to 1000 states; beyond that,
    those nearest to 1 come from ARPACK in shift-invert mode. For chains of reversible classes all
    of them come from similar symmetric matrices, for which LAPACK finds every eigenvector to full
    precision, for any stationary distribution.

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
        raise InputError(f"k must be at most {n}, the number of states in the chain; you gave {k}")
    if k * n > MOST_ENTRIES:
        raise ChainError(
            f"{k} pairs of vectors over {n} states don't fit in memory. Ask for fewer, or "
            "find the limit by elimination (stochastic_limit)."
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


ALL_REVERSIBLE = 2000
"""Number of states up to which LAPACK finds all eigenvalues of a class that is not a line."""
_BALANCED = 1e-12
_SAMPLE = 1000


@dataclass(frozen=True, eq=False)
class SymmetricForm:
    """A reversible class, as S and D.

    `states` are m increasing positions; `matrix` is S, sparse, in their order. `roots` is the
    diagonal of D, the square roots of weights that sum to 1 (the stationary distribution, if the
    class is closed); 0 where it is smaller than any float. `line` is the order in which the states
    are in a line, or None.
    """

    states: Places
    matrix: csc_array
    roots: Floats
    line: Places | None

    def pairs(self, k: int) -> tuple[Floats, Floats]:
        """Return k eigenvalues of S, ascending, and their orthonormal vectors as columns.

        All m of them up to `ALL_REVERSIBLE` states; beyond that those nearest to 1. Raises
        AccuracyError if the iteration for a large class does not converge.
        """
        m = len(self.states)
        if self.line is not None:
            S = csc_array(self.matrix[:, self.line])[self.line]
            some: dict[str, Any] = {}
            if k < m and m > ALL_REVERSIBLE:
                some = {"select": "i", "select_range": (m - k, m - 1)}
            values, along = scipy.linalg.eigh_tridiagonal(S.diagonal(), S.diagonal(1), **some)
            vectors = np.empty_like(along)
            vectors[self.line] = along
            return np.asarray(values), vectors
        if m <= ALL_REVERSIBLE or k >= m - 1:
            values, vectors = np.linalg.eigh(self.matrix.toarray())  # lets Ctrl-C through
            return np.asarray(values), np.asarray(vectors)
        start = np.random.default_rng(0).standard_normal(m)
        try:
            near_one = scipy.sparse.linalg.eigsh(self.matrix, k=k, sigma=SHIFT, v0=start)
        except scipy.sparse.linalg.ArpackNoConvergence as error:
            raise AccuracyError(
                f"the iteration for {k} of {m} eigenvalues didn't converge. Ask for fewer."
            ) from error
        return np.asarray(near_one[0]), np.asarray(near_one[1])

    def missed(self, values: NDArray[Any], vectors: NDArray[Any]) -> float:
        """Return the largest entry of S Q - Q diag(values) and of Q^T Q - I."""
        balance = np.abs(self.matrix @ vectors - vectors * values).max(initial=0.0)
        overlap = np.abs(vectors.T @ vectors - np.eye(len(values))).max(initial=0.0)
        return float(max(balance, overlap))


def symmetric_form(chain: Chain, states: Places) -> SymmetricForm | None:
    """Return the symmetric form of one class, or None if the class is not reversible.

    States are increasing positions.
    """
    there = chain.arcs.matrix()
    if len(states) < len(chain):
        there = csc_array(there[:, states][states])
    there.sort_indices()
    back = csc_array(there.T)
    back.sort_indices()
    if there.nnz != back.nnz or (there.indices != back.indices).any():
        return None
    weight, power = _weights(there)
    sources = np.repeat(np.arange(len(states)), np.diff(there.indptr))
    for some in (slice(_SAMPLE), slice(_SAMPLE, None)):  # most chains are not reversible
        source, target = sources[some], there.indices[some]
        (out, up), (home, down) = np.frexp(there.data[some]), np.frexp(back.data[some])
        there_and_back = np.ldexp(
            (weight[target] * home) / (weight[source] * out),
            (power[target] + down - power[source] - up).clip(-99, 99),
        )
        if (np.abs(there_and_back - 1.0) > _BALANCED).any():
            return None
    beside = csc_array(
        (np.sqrt(there.data) * np.sqrt(back.data), there.indices, there.indptr), shape=there.shape
    )
    loops = chain.matrix.diagonal()[states]
    power -= power.max()
    total = np.ldexp(weight, power).sum()
    roots = np.ldexp(np.sqrt(np.ldexp(weight, power % 2) / total), power // 2)
    return SymmetricForm(states, csc_array(beside + diags_array(loops)), roots, line_order(there))


def _weights(T: csc_array) -> tuple[Floats, Places]:
    """Return the weights along a tree of arcs, as numbers near 1 and integer exponents of 2."""
    size = T.shape[0]
    high, low, power = np.ones(size), np.zeros(size), np.zeros(size, dtype=np.int64)
    if size == 1:
        return high, power
    _, parent = csgraph.breadth_first_order(T, 0)
    child, parent[0] = np.arange(1, size), 0
    (above, more), (below, less) = (
        np.frexp(np.asarray(T[ends]).reshape(-1))
        for ends in ((child, parent[1:]), (parent[1:], child))
    )
    high[1:], power[1:] = above / below, more - less
    exact = two_product(high[1:], below)
    low[1:] = ((above - exact.high) - exact.low) / below
    # Pointer jumping: after k rounds `parent` is the ancestor 2^k steps above.
    while parent.any():
        exact = two_product(high, high[parent])
        cross = high * low[parent] + low * high[parent]
        high, low = two_sum(exact.high, exact.low + cross)
        high, shift = np.frexp(high)
        low, power = np.ldexp(low, -shift), power + power[parent] + shift
        parent = parent[parent]
    return high, power


def reversible_classes(chain: Chain) -> list[SymmetricForm] | None:
    """Return the symmetric forms of the classes, or None if the chain is not of the kind required.

    >>> from evenbreak.chains import chain_of
    >>> reversible_classes(chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)])) is None
    True
    """
    structure = chain.structure
    sizes = np.diff(structure.offsets)
    open_classes = structure.count - int(structure.closed.sum())
    if open_classes > 1 or (open_classes and (sizes[structure.closed] > 1).any()):
        return None
    forms = []
    for label in range(structure.count):
        form = symmetric_form(chain, np.sort(structure.members(label)))
        if form is None:
            return None
        forms.append(form)
    return sorted(forms, key=lambda form: not structure.recurrent[form.states[0]])


def reversible_pairs(
    chain: Chain, units: UnitPairs, forms: list[SymmetricForm], k: int
) -> tuple[Eigenpairs, Floats, float]:
    """Return k eigenpairs of a chain from the symmetric forms of its classes, closed ones first.

    In the pairs, an entry of a left vector that no float can hold is infinite. The vectors Q of the
    symmetric forms, shape (n, k), follow, and the largest entry of S Q - Q diag(values) and of Q^T
    Q - I. Raises AccuracyError if the iteration for a large class does not converge.
    """
    n = len(chain)
    recurrent, periods = chain.structure.recurrent, chain.structure.periods
    values, vectors, is_one, missed = [], [], [], 0.0
    scale = np.ones(n)
    for form in forms:
        states = form.states
        scale[states] = form.roots
        period = int(periods[chain.structure.label[states[0]]])
        eigenvalues, Q = form.pairs(min(k, len(states)))
        if recurrent[states[0]]:
            eigenvalues, Q = _with_known(
                form, eigenvalues, Q, period, chain.structure.phases[states]
            )
        missed = max(missed, form.missed(eigenvalues, Q))
        spread = np.zeros((n, len(eigenvalues)))
        spread[states] = Q
        values.append(eigenvalues)
        vectors.append(spread)
        is_one.append(np.arange(len(eigenvalues)) == (0 if recurrent[states[0]] else -1))
    value, Q, ones = np.concatenate(values), np.hstack(vectors), np.concatenate(is_one)
    size = np.abs(value).round(10) if k == n or n <= DENSE else value
    order = np.lexsort((-value, -size, ~ones))[:k]
    value, Q, ones = value[order], Q[:, order], ones[order]
    right = scale[:, None] * Q
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        left = np.where(Q == 0.0, 0.0, Q / scale[:, None]).T
    turning = ~ones & (np.abs(Q[~recurrent]).max(axis=0, initial=0.0) > 0.0)
    # What a vector holds of each absorbing state makes its product with the left ones zero.
    ending = units.left[:, ~recurrent] @ right[~recurrent][:, turning]
    right[np.ix_(recurrent, turning)] = -(units.right[recurrent] @ ending)
    right[:, ones], left[ones] = units.right, units.left
    return Eigenpairs(value, left, right), Q, missed


def _with_known(
    form: SymmetricForm, values: Floats, Q: Floats, period: int, phases: Places
) -> tuple[Floats, Floats]:
    """Insert the known pairs of a closed class, with the pair of eigenvalue 1 first.

    Its vector is D itself; in a class of period 2, the vector of eigenvalue -1 is D with the signs
    of the phases. The others are made orthogonal to these, which matters only where an eigenvalue
    is very close.
    """
    exact, places = [form.roots], [len(values) - 1]
    if period == 2 and len(values) == len(form.roots) > 1:
        exact.append(np.where(phases % 2, -form.roots, form.roots))
        places.append(0)
    others = np.delete(np.arange(len(values)), places)
    K, rest = np.stack(exact, axis=1), Q[:, others]
    rest = rest - K @ (K.T @ rest)
    rest /= np.linalg.norm(rest, axis=0)
    ends = np.array([1.0, -1.0])[: len(exact)]
    return np.concatenate((ends, values[others])), np.hstack((K, rest))
