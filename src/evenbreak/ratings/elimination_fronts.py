"""The dense blocks in which a sparse symmetric matrix is eliminated.

A minimum degree order, its elimination tree, and pivots that share their rows gathered
in one front (Liu 1992, "The multifrontal method for sparse matrix solution").
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import spilu

from evenbreak.arrays import Places

_ONE_FRONT_UP_TO = 300
_PADDING, _PADDING_PER_ROW = 64, 20
"""Explicit zeros that a front accepts before its rows get a front of their own."""


@dataclass(eq=False)
class Front:
    """Columns that are eliminated together, and the later rows that they touch.

    `children` are the positions, in the list of fronts, of those whose Schur complement
    this front takes up; they come before it.
    """

    pivots: Places
    rows: Places
    children: list[int] = field(default_factory=list)


def fronts_of(matrix: sparse.csc_array) -> list[Front]:
    """Return the fronts of a symmetric matrix, children before parents.

    >>> path = sparse.csc_array([[2.0, -1.0, 0.0], [-1.0, 3.0, -1.0], [0.0, -1.0, 2.0]])
    >>> fronts_of(path)
    [Front(pivots=array([0, 1, 2]), rows=array([], dtype=int64), children=[])]
    """
    size = matrix.shape[0]
    if size <= _ONE_FRONT_UP_TO or _fills_in(matrix):
        return [Front(np.arange(size), np.zeros(0, dtype=np.intp))]
    return _gather(matrix, _minimum_degree(matrix))


def _fills_in(matrix: sparse.csc_array) -> bool:
    """Return whether nearly everybody is reached in two steps, through many at once.

    No order helps such a matrix, and finding that out by minimum degree takes longer than
    the elimination. A sample of the rows is enough.
    """
    size = matrix.shape[0]
    if matrix.nnz < 32 * size:
        return False
    reached = []
    for row in range(0, size, max(size // 16, 1)):
        near = matrix.indices[matrix.indptr[row] : matrix.indptr[row + 1]]
        seen = np.zeros(size, dtype=bool)
        for other in near:
            seen[matrix.indices[matrix.indptr[other] : matrix.indptr[other + 1]]] = True
        reached.append(int(seen.sum()))
    return bool(np.median(reached) > size / 6)


def _minimum_degree(matrix: sparse.csc_array) -> Places:
    """Return the columns in the order of elimination.

    SuperLU orders before it factorises, and an incomplete factor that drops all it may
    costs nothing: what is left is the order.
    """
    factor = spilu(
        matrix,
        drop_tol=1.0,
        fill_factor=1.0,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    return np.argsort(factor.perm_c)


def _gather(matrix: sparse.csc_array, order: Places) -> list[Front]:
    """Return the fronts for an order, in the names of the matrix."""
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
