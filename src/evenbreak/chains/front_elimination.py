"""Elimination for one large class, in the dense fronts of a nested dissection.

The matrix A = I - T of a class has arcs with a minus sign off the diagonal, and its diagonal is
fixed by them and the leak. Eliminating the first states of a front splits it as

    A = | B  C | = | L      | | U  Y |,   L U = B,  X = D U^-1,  Y = L^-1 C,  rest = E - X Y,
        | D  E |   | X rest | |    I |

with the leak as the last row of D and E. The pivots on the diagonal of U are sums of arcs and
never 1 minus something: what leaves B is the same whichever later state it goes to, so one row
with the column sums of D is all that B needs to be factored. B is halved in the same way until
it is small, and then eliminated state by state (Grassmann, Taksar and Heyman 1985).

All that is added has one sign, so the order of the additions does not matter: each entry is as
accurate as in elimination state by state, at the speed of BLAS.

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993; Alfa, Xue and Ye 2002; Liu 1992,
"The multifrontal method for sparse matrix solution".
"""

from __future__ import annotations

from bisect import bisect_right
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.linalg.blas import dgemm, dger, dtrsm

from evenbreak.chains.arcs import put_back

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray
    from scipy.sparse import csc_array

    from evenbreak.chains.arcs import Places
    from evenbreak.chains.dissection import Front

    Matrix = NDArray[np.float64]

_ONE_BY_ONE = 64
"""So few states are eliminated one by one."""
_TERMS = 128
_FEW, _SMALL, _LARGE = 7, 2**18, 2**24
"""BLAS solves for so few columns, and multiplies so many numbers, without threads.

Waking threads for small matrices can take a hundred times as long as the work itself when the
cores are busy. From `_LARGE` multiplications on, threads are worth it.
"""
_UPPER = np.triu(np.ones((_ONE_BY_ONE, _ONE_BY_ONE), dtype=bool))


class _Factors(NamedTuple):
    """The factors of a front: L (with ones on its diagonal) and U in one array, X^T and Y."""

    block: Matrix
    onward: Matrix
    back: Matrix


class FrontElimination:
    """(I - T) factored, for one class of states.

    Parameters
    ----------
    T
        sparse, shape (m, m): T[i, j] is the arc from j to i; no diagonal.
    leak
        shape (m,): the probability of leaving the class, given the state; not all zero.
    order, fronts
        the order of elimination, and its fronts (see `dissection`).
    """

    def __init__(
        self, T: csc_array, leak: NDArray[np.float64], order: Places, fronts: list[Front]
    ) -> None:
        self._order = order
        self._steps: list[tuple[Front, _Factors]] = []
        arcs = _arcs_by_front(T, order, fronts)
        leak = leak[order]
        ends = [front.last for front in fronts]
        place = np.empty(len(order), dtype=np.intp)  # in the front at hand
        rests: list[list[tuple[Places, Matrix]]] = [[] for _ in fronts]
        for number, (front, (sources, targets, chances)) in enumerate(
            zip(fronts, arcs, strict=True)
        ):
            first, last, later = front
            size = last - first
            place[first:last] = np.arange(size)
            place[later] = np.arange(size, size + len(later))
            A = np.zeros((size + len(later) + 1, size + len(later)), order="F")
            A[place[targets], place[sources]] = -chances
            A[-1, :size] = -leak[first:last]
            for states, rest in rests[number]:
                at = place[states]
                A.T[at[:, None], np.append(at, len(A) - 1)] += rest.T
            rests[number].clear()
            factors, rest = _split(A, size)
            self._steps.append((front, factors))
            if len(later):
                rests[bisect_right(ends, later[0])].append((later, rest))
        pivots = np.concatenate([factors.block.diagonal() for _, factors in self._steps])
        self.pivots = put_back(pivots, order)

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        x = b[self._order]
        for (first, last, later), (block, onward, _) in self._steps:
            x[first:last] = _solved(block, x[first:last], "L")
            x[later] = _less(x[later], onward[:, :-1], x[first:last], transposed=True)
        for (first, last, later), (block, _, back) in reversed(self._steps):
            x[first:last] = _solved(block, _less(x[first:last], back, x[later]), "U")
        return put_back(x, self._order)

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        y = r[self._order]
        for (first, last, later), (block, _, back) in self._steps:
            y[first:last] = _solved(block, y[first:last], "U", transposed=True)
            y[later] = _less(y[later], back, y[first:last], transposed=True)
        for (first, last, later), (block, onward, _) in reversed(self._steps):
            right = _less(y[first:last], onward[:, :-1], y[later])
            y[first:last] = _solved(block, right, "L", transposed=True)
        return put_back(y, self._order)


def _arcs_by_front(
    T: csc_array, order: Places, fronts: list[Front]
) -> Iterator[tuple[Places, Places, NDArray[np.float64]]]:
    """Yield, for each front, its arcs that no earlier front has: sources, targets, chances."""
    arcs = T.tocoo()
    rank = np.empty(len(order), dtype=np.intp)
    rank[order] = np.arange(len(order))
    sources, targets = rank[arcs.col], rank[arcs.row]
    ends = [front.last for front in fronts]
    home = np.searchsorted(ends, np.minimum(sources, targets), side="right")
    by_front = np.argsort(home, kind="stable")
    sources, targets, chances = sources[by_front], targets[by_front], arcs.data[by_front]
    marks = np.append(0, np.cumsum(np.bincount(home, minlength=len(fronts)))).tolist()
    for begin, end in pairwise(marks):
        yield sources[begin:end], targets[begin:end], chances[begin:end]


def _split(A: Matrix, size: int) -> tuple[_Factors, Matrix]:
    """Eliminate the first states of a front; return their factors and the rest.

    Parameters
    ----------
    A
        shape (n + 1, n): the arcs with a minus sign, the leak as the last row; the diagonal does
        not count.
    size
        the number of states to eliminate.
    """
    B = np.empty((size + 1, size), order="F")
    B[:size] = A[:size, :size]
    B[size] = A[size:, :size].sum(axis=0)
    block = _factored(B)
    onward = _solved(block, A[size:, :size].T, "U", transposed=True)
    back = _solved(block, A[:size, size:], "L")
    return _Factors(block, onward, back), _less(A[size:, size:], onward, back, transposed=True)


def _factored(B: Matrix) -> Matrix:
    """Return L and U in one array, of a block with the sums of what leaves it as the last row."""
    size = B.shape[1]
    if size <= _ONE_BY_ONE:
        return _factored_one_by_one(B)
    half = size // 2
    (block, onward, back), rest = _split(B, half)
    factors = np.empty((size, size), order="F")
    factors[:half, :half] = block
    factors[half:, :half] = onward[:, :-1].T
    factors[:half, half:] = back
    factors[half:, half:] = _factored(rest)
    return factors


def _factored_one_by_one(B: Matrix) -> Matrix:
    """Return L and U in one array, as `_factored` does, state by state; B is used up."""
    size = B.shape[1]
    shares = np.zeros((size + 1, size), order="F")
    minus_ones, pivots = np.full(size + 1, -1.0), np.empty(size)
    for k in range(size):
        leaving = B[k + 1 :, k]
        pivots[k] = pivot = leaving.dot(minus_ones[k:size])
        np.divide(leaving, pivot, out=shares[k + 1 :, k])
        if k + 1 < size:
            # The shares are 0 above, so that whole columns, contiguous in memory, can be updated.
            dger(-1.0, shares[:, k], B[k, k + 1 :], a=B[:, k + 1 :], overwrite_a=1)
    factors = np.asfortranarray(shares[:size])
    np.copyto(factors, B[:size], where=_UPPER[:size, :size])
    np.fill_diagonal(factors, pivots)
    return factors


def _less(C: Matrix, A: Matrix, B: Matrix, *, transposed: bool = False) -> Matrix:
    """Return C - A B (A transposed on request); C may be used up.

    Only `_TERMS` products at a time are added up one after the other, which keeps rounding
    errors small.
    """
    C = np.asfortranarray(C)
    rows, columns = C.shape
    for j in range(0, len(B) if rows else 0, _TERMS):
        some = slice(j, j + _TERMS)
        left = A[some] if transposed else A[:, some]
        step = columns if left.size * columns >= _LARGE else max(_SMALL // left.size, 1)
        for k in range(0, columns, step):
            part = slice(k, k + step)
            dgemm(-1.0, left, B[some, part], 1.0, C[:, part], trans_a=transposed, overwrite_c=1)
    return C


def _solved(block: Matrix, B: Matrix, part: str, *, transposed: bool = False) -> Matrix:
    """Return L^-1 B or U^-1 B for a factored block (transposed on request); B may be used up."""
    B = np.asfortranarray(B)
    lower, columns = part == "L", B.shape[1]
    step = columns if block.size * columns >= _LARGE else _FEW
    for k in range(0, columns, step):
        right = B[:, k : k + step]
        dtrsm(1.0, block, right, lower=lower, diag=lower, trans_a=transposed, overwrite_b=1)
    return B
