"""The diagonal of the inverse of a sparse symmetric positive definite matrix.

Selected inversion finds it exactly by eliminating block by block and then working back. With the
pivots of a block first, H = [F11 F21ᵀ; F21 F22], G = F21 F11⁻¹ and the Schur complement S = F22 - G
F21ᵀ,

    H⁻¹ = [F11⁻¹ + Gᵀ S⁻¹ G    -Gᵀ S⁻¹;   -S⁻¹ G    S⁻¹]

and of S⁻¹ only the entries that the block touches are needed (Takahashi, Fagan & Chen
1973; Erisman & Tinney 1975). The blocks are the dense fronts of the multifrontal method
(Duff & Reid 1983). A small matrix is inverted whole.

Where no elimination order keeps a league's Hessian sparse, the diagonal is approximated. All rows
of H sum to τ, so 1/τ is the eigenvalue of H⁻¹ for the constant vector and, with a weak prior, its
largest by far. This eigenvalue is separated exactly: with u the vector of ones,

    diag H⁻¹ = diag (H + αuuᵀ)⁻¹ + α / (τ² + ατn)

and, scaled to a unit diagonal by S, I - W remains, where W has a small spectral radius ρ in a
league where everyone may meet everyone. Eliminating all others but i,

    ((I - W)⁻¹)ᵢᵢ = 1 / (1 - Σⱼₖ Wᵢⱼ Cⱼₖ Wₖᵢ),

C being the inverse without row i, whose eigenvalues lie between 1/(1+ρ) and 1/(1-ρ). So
the sum is known within that factor of Σⱼ Wᵢⱼ², which is small where players have many
games. Within those bounds C is taken as its diagonal, and that as the answer sought: the
cavity approximation, exact but for cycles of opponents (Thouless, Anderson & Palmer 1977).

If neither method works, as in a federation of clubs, small matrices are inverted whole, and larger
ones by blocks and draws (see `evenbreak.ratings.sampled_diagonal`).
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.linalg import lapack
from scipy.sparse.linalg import LinearOperator, eigsh

from evenbreak.arrays import Floats, Places
from evenbreak.ratings.sampled_diagonal import InverseDiagonal, not_definite, sampled_diagonal

_TRACE = 1e-100
_NOTHING = np.zeros((0, 0))


def inverse_diagonal(matrix: sparse.csc_array, row_sum: float | None) -> InverseDiagonal:
    """Return the diagonal of the inverse of a diagonally dominant M-matrix, shape (n, n).

    It is symmetric, positive on the diagonal, nowhere positive off it; `row_sum` is the sum of
    every row, above zero; None if the sums differ. The n values have a relative error near
    rounding. For a matrix of 2,000 rows or more that fills in, they come from the cavity
    approximation (see the module) if its error is at most 0.2%; it is usually 1e-5. Failing that,
    for up to 5,000 rows they are computed in single precision if the condition number is below
    1000; the error is usually a few 1e-6, and 1e-4 at worst. For more than 5,000 rows they are
    sampled, with the error stated. Raises AccuracyError if the matrix is not positive definite in
    floating point.

    >>> path = sparse.csc_array([[2.0, -1.0, 0.0], [-1.0, 3.0, -1.0], [0.0, -1.0, 2.0]])
    >>> inverse_diagonal(path, 1.0).value
    array([0.625, 0.5  , 0.625])
    """
    size = matrix.shape[0]
    if size < _LARGE:
        return InverseDiagonal(_in_double_precision(matrix))
    league = None if row_sum is None else _Leveled.of(matrix, row_sum)
    if league is not None and (well_mixed := _by_cavities(league)) is not None:
        return InverseDiagonal(league.whole(well_mixed))
    fronts = fronts_of(matrix)
    if fronts:
        return InverseDiagonal(_come_back(fronts, *_eliminate(matrix, fronts)))
    if size > _DENSE_UP_TO:
        return sampled_diagonal(matrix, row_sum)
    if league is not None and (single := _in_single_precision(league)) is not None:
        return InverseDiagonal(league.whole(single))
    return InverseDiagonal(_in_double_precision(matrix))


def _eliminate(matrix: sparse.csc_array, fronts: list[Front]) -> tuple[list[Floats], list[Floats]]:
    """Return R with RᵀR = F11⁻¹, and G, of every front, children before parents."""
    size = matrix.shape[0]
    position = np.zeros(size, dtype=np.intp)
    done = np.zeros(size, dtype=bool)
    updates: dict[int, Floats] = {}
    roots, links = [], []
    for number, front in enumerate(fronts):
        index = np.concatenate((front.pivots, front.rows))
        position[index] = np.arange(len(index))
        block = np.zeros((len(index), len(index)))
        for k, pivot in enumerate(front.pivots):
            column = slice(matrix.indptr[pivot], matrix.indptr[pivot + 1])
            live = ~done[matrix.indices[column]]
            at = position[matrix.indices[column][live]]
            block[at, k] = block[k, at] = matrix.data[column][live]
        for child in front.children:
            at = position[fronts[child].rows]
            block[np.ix_(at, at)] += updates.pop(child)
        done[front.pivots] = True
        own = len(front.pivots)
        root = _without_traces(_inverse_root(block[:own, :own]))
        half = _without_traces(_without_traces(block[own:, :own]) @ root.T)
        updates[number] = block[own:, own:] - half @ half.T
        roots.append(root)
        links.append(_without_traces(half @ root))
    return roots, links


def _come_back(fronts: list[Front], roots: list[Floats], links: list[Floats]) -> Floats:
    """Return the diagonal of the inverse, working from parents to children."""
    diagonal = np.zeros(sum(len(front.pivots) for front in fronts))
    position = np.zeros(len(diagonal), dtype=np.intp)
    outer_parts: dict[int, Floats] = {}
    for number in range(len(fronts) - 1, -1, -1):
        front, root, link = fronts[number], roots[number], links[number]
        outer = outer_parts.pop(number, _NOTHING)
        cross = -outer @ link
        # Most fronts have no children: their inverse is not made for its diagonal alone.
        diagonal[front.pivots] = _sums(root, root) - _sums(link, cross)
        if not front.children:
            continue
        inverse = root.T @ root - link.T @ cross
        whole = np.block([[inverse, cross.T], [cross, outer]])
        position[front.pivots] = np.arange(len(front.pivots))
        position[front.rows] = len(front.pivots) + np.arange(len(front.rows))
        for child in front.children:
            at = position[fronts[child].rows]
            outer_parts[child] = whole[np.ix_(at, at)]
    return diagonal


def _without_traces(block: Floats) -> Floats:
    """Return the block, overwritten, with zeros for entries too small to matter.

    Entries shrink by a factor with each player along a chain, and arithmetic on subnormal floats is
    a hundred times slower.
    """
    block[np.abs(block) < _TRACE] = 0.0
    return block


def _inverse_root(block: Floats) -> Floats:
    """Return the lower triangle R with RᵀR = block⁻¹."""
    if len(block) == 1 and block[0, 0] > 0.0:
        return 1.0 / np.sqrt(block)
    factor, failed = lapack.dpotrf(block, lower=1)
    if failed:
        raise not_definite()
    root, _ = lapack.dtrtri(factor, lower=1, overwrite_c=1)
    return np.asarray(root)


def _sums(x: Floats, y: Floats) -> Floats:
    """Return the diagonal of xᵀy."""
    return np.asarray(np.einsum("ij,ij->j", x, y))


_LARGE = 2000
"""Rows needed to make looking for fronts, or an approximate answer, worthwhile."""

_DENSE_UP_TO = 5000
"""Rows up to which a matrix is inverted whole."""

_WELL_MIXED = 0.002
"""Largest error bound accepted for a cavity answer. As ρ² is at least the sum of any row of
squares, no such sum is then above .015, and every round reduces the error 60-fold."""
_ROUNDS = 6


@dataclass(frozen=True, eq=False)
class _Leveled:
    """S (H + αuuᵀ) S = I - W, where W is `pull` - r rᵀ off the diagonal and 0 on it."""

    pull: sparse.csc_array
    r: Floats
    scale: Floats
    level: float

    @classmethod
    def of(cls, matrix: sparse.csc_array, row_sum: float) -> _Leveled:
        size = matrix.shape[0]
        degree = matrix.diagonal()
        alpha = float(degree.mean()) / size
        scale = 1.0 / np.sqrt(degree + alpha)
        pull = sparse.diags_array(degree) - matrix
        pull = sparse.diags_array(scale) @ pull @ sparse.diags_array(scale)
        level = alpha / (row_sum * (row_sum + alpha * size))
        return cls(sparse.csc_array(pull), np.sqrt(alpha) * scale, scale, level)

    def whole(self, diagonal: Floats) -> Floats:
        """Return the diagonal of H⁻¹, from that of (I - W)⁻¹."""
        return diagonal * self.scale**2 + self.level


def _by_cavities(league: _Leveled) -> Floats | None:
    """Return the diagonal of (I - W)⁻¹, or None if it is not known to within 0.2%."""
    r, pull = league.r, league.pull
    rr, size = r * r, len(r)
    squares = pull.multiply(pull) - 2.0 * (sparse.diags_array(r) @ pull @ sparse.diags_array(r))

    def squared(v: Floats) -> Floats:
        return np.asarray(squares @ v + rr * (rr @ v) - rr * rr * v)

    total = float(squared(np.ones(size)).max())
    if 2.0 * total**1.5 > _WELL_MIXED:  # whatever ρ is: ρ² is at least that
        return None
    w = LinearOperator((size, size), lambda v: pull @ v - r * (r @ v) + rr * v, dtype=np.float64)
    start = np.cos(np.arange(size))
    largest = eigsh(w, 1, which="LM", tol=0.01, v0=start, return_eigenvectors=False)
    radius = 1.05 * abs(float(largest[0]))  # Lanczos comes from below
    unknown = 2.0 * radius * total / (1.0 - radius**2) if radius < 0.5 else 1.0
    if unknown > _WELL_MIXED * (1.0 - total / (1.0 - radius)):
        return None
    diagonal = np.ones(size)
    for _ in range(_ROUNDS):
        diagonal = 1.0 / (1.0 - squared(diagonal))
    return diagonal


def _in_single_precision(league: _Leveled) -> Floats | None:
    """Return the diagonal of (I - W)⁻¹, or None if single precision may not be enough."""
    r = league.r.astype(np.float32)
    block = np.multiply.outer(r, r).T
    column = np.repeat(np.arange(len(r)), np.diff(league.pull.indptr))
    block[league.pull.indices, column] -= league.pull.data.astype(np.float32)
    np.fill_diagonal(block, 1.0)
    norm = float(np.abs(block).sum(axis=0).max())
    factor, failed = lapack.spotrf(block, lower=1, overwrite_a=1)
    if failed:
        return None
    reciprocal_condition, _ = lapack.spocon(factor, norm, uplo="L")
    if reciprocal_condition < 1e-3:
        return None
    inverse, _ = lapack.strtri(factor, lower=1, overwrite_c=1)
    return _square_sums(inverse)


def _in_double_precision(matrix: sparse.csc_array) -> Floats:
    factor, failed = lapack.dpotrf(matrix.toarray(order="F"), lower=1, overwrite_a=1)
    if failed:
        raise not_definite()
    inverse, _ = lapack.dtrtri(factor, lower=1, overwrite_c=1)
    return _square_sums(inverse)


def _square_sums(lower: NDArray[Any]) -> Floats:
    """Return the sum of squares of each column of a lower triangle."""
    columns = (lower[k:, k] for k in range(len(lower)))
    return np.array([column @ column for column in columns], dtype=np.float64)


_PADDING, _PADDING_PER_ROW = 64, 20
"""Explicit zeros that a front accepts before its rows are split off into another front."""


@dataclass(eq=False)
class Front:
    """Columns eliminated together, and the later rows that they touch.

    `children` are the positions, in the list of fronts, of those whose Schur complement
    this front takes up; they come before it.
    """

    pivots: Places
    rows: Places
    children: list[int] = field(default_factory=list)


def fronts_of(matrix: sparse.csc_array) -> list[Front]:
    """Return the fronts of a symmetric matrix, children before parents, or none if it fills in.

    >>> path = sparse.csc_array([[2.0, -1.0, 0.0], [-1.0, 3.0, -1.0], [0.0, -1.0, 2.0]])
    >>> fronts_of(path)
    [Front(pivots=array([0, 1, 2]), rows=array([], dtype=int64), children=[])]
    """
    order = _minimum_degree(matrix)
    return [] if order is None else _gather(matrix, order)


_MOST_LINKS = 10_000_000
"""Links made or met again during elimination above which a matrix counts as filling in.

Finding that many takes about a second, and eliminating fronts of that many takes at most a few
seconds.
"""


def _minimum_degree(matrix: sparse.csc_array) -> Places | None:
    """Return the columns in elimination order, or None if no good order is found in time.

    The column with the fewest remaining neighbors is next, along with all columns that have exactly
    the same neighbors. Eliminating them links all these neighbors to each other.
    """
    size = matrix.shape[0]
    indices, starts = matrix.indices, matrix.indptr.tolist()
    near: dict[int, set[int]] = {}

    def neighbors(column: int) -> set[int]:
        if column not in near:
            near[column] = {*indices[starts[column] : starts[column + 1]].tolist()} - {column}
        return near[column]

    degree = (np.diff(matrix.indptr) - (matrix.diagonal() != 0)).tolist()
    waiting = [many * size + column for column, many in enumerate(degree)]
    heapq.heapify(waiting)
    order: list[int] = []
    links = 0
    while waiting:
        many, column = divmod(heapq.heappop(waiting), size)
        if degree[column] != many:  # out of date, or eliminated
            continue
        links += many * many
        if links > _MOST_LINKS:
            return None
        around = near.pop(column) if column in near else neighbors(column)
        for other in around:
            others = neighbors(other)
            others |= around
            others -= {other, column}
        same = [other for other in around if len(near[other]) == many - 1]
        order += [column, *sorted(same)]
        degree[column] = -1
        for other in same:
            del near[other]
            degree[other] = -1
        gone = {*same}
        for other in around - gone:
            near[other] -= gone
            degree[other] = len(near[other])
            heapq.heappush(waiting, degree[other] * size + other)
    return np.array(order, dtype=np.intp)


def _gather(matrix: sparse.csc_array, order: Places) -> list[Front]:
    """Return the fronts for an order, in the matrix's own numbering."""
    size = len(order)
    rank = np.empty(size, dtype=np.intp)
    rank[order] = np.arange(size)
    pivots: list[list[int]] = []
    rows: list[Places] = []
    children: list[list[int]] = []
    waiting: list[list[int]] = [[] for _ in range(size)]  # fronts, by the first of their rows
    for k in range(size):
        column = order[k]
        near = rank[matrix.indices[matrix.indptr[column] : matrix.indptr[column + 1]]]
        below = [near[near > k], *(rows[front][1:] for front in waiting[k])]
        touched = np.unique(np.concatenate(below))
        host = max(waiting[k], key=lambda front: len(rows[front]), default=None)
        if host is not None:
            padding = (len(touched) + 1 - len(rows[host])) * len(pivots[host])
        if host is None or padding > _PADDING + _PADDING_PER_ROW * len(touched):
            host = len(pivots)
            pivots.append([])
            rows.append(touched)
            children.append([])
        pivots[host].append(k)
        rows[host] = touched
        children[host].extend(front for front in waiting[k] if front != host)
        waiting[k].clear()
        if len(touched):
            waiting[touched[0]].append(host)
    last = sorted(range(len(pivots)), key=lambda front: pivots[front][-1])
    place = {front: number for number, front in enumerate(last)}
    return [
        Front(order[pivots[front]], order[rows[front]], [place[c] for c in children[front]])
        for front in last
    ]
