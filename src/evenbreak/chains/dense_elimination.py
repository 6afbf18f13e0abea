"""Block elimination of states in a dense array: the kernel for fronts and dense classes.

The matrix A = I - T of some states has their arcs with a minus sign off the diagonal, and its
diagonal is fixed by them and the leak. Eliminating the first states splits it as

    A = | B  C | = | L      | | U  Y |,   L U = B,  X = D U^-1,  Y = L^-1 C,  rest = E - X Y,
        | D  E |   | X rest | |    I |

with the leak as the last row of D and E. The pivots on the diagonal of L are sums of arcs and
never 1 minus something: the flow that leaves B is the same no matter which later state it goes to,
so one row with the column sums of D is enough to factor B. B is halved in the same way until it is
small, and then eliminated state by state (Grassmann, Taksar and Heyman 1985).

All terms have the same sign, so the order of the additions does not matter: each entry is as
accurate as in elimination state by state, at the speed of BLAS.

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993; Alfa, Xue and Ye 2002.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg.blas import ddot, dgemm, dtrsm, dtrsv

from evenbreak.arrays import Floats

MOST_ENTRIES = 40_000_000
"""Memory limit for an array or its factors: enough for about 6,000 fully connected states."""
_ONE_BY_ONE = 64
"""Number of states up to which they are eliminated one by one."""
_TERMS = 128
_FEW, _SMALL, _LARGE = 1000, 2**18, 2**24
"""Sizes up to which BLAS solves and multiplies without waking threads.

Waking threads for small matrices can take a hundred times as long as the work itself when the cores
are busy. For `_LARGE` multiplications or more, threads are worth it.
"""
_LATER = -np.triu(np.ones((_ONE_BY_ONE + 1, _ONE_BY_ONE + 1)), 1)
"""Row k times the arcs out of state k is minus their contribution to later states."""


class Factors(NamedTuple):
    """Factors of a front: L and U (with ones on its diagonal) in one array, X^T and Y."""

    block: Floats
    onward: Floats
    back: Floats


def is_dense(states: int, arcs: int) -> bool:
    """Whether this many states have arcs between at least a quarter of their pairs."""
    return states * states <= 4 * arcs


def split(A: Floats, size: int) -> tuple[Factors, Floats]:
    """Eliminate the first `size` states of a front; return their factors and the rest.

    A has shape (n + 1, n): the arcs with a minus sign, the leak as the last row; the diagonal does
    not count.
    """
    B = np.empty((size + 1, size), order="F")
    B[:size] = A[:size, :size]
    B[size] = A[size:, :size].sum(axis=0)
    block = factored(B)
    onward = solved(block, A[size:, :size].T, "U", transposed=True)
    back = solved(block, A[:size, size:], "L")
    return Factors(block, onward, back), less(A[size:, size:], onward, back, transposed=True)


def factored(B: Floats) -> Floats:
    """Return L and U in one array, for a block whose last row is the sums of its outgoing arcs.

    B has shape (n + 1, n), in Fortran order; the diagonal is ignored. B is overwritten. Without the
    last row, nothing leaves the block.
    """
    size = B.shape[1]
    if size <= _ONE_BY_ONE:
        return _factored_one_by_one(B)
    half = size // 2
    (block, onward, back), rest = split(B, half)
    factors = np.empty((size, size), order="F")
    factors[:half, :half] = block
    factors[half:, :half] = onward[:, : size - half].T
    factors[:half, half:] = back
    factors[half:, half:] = factored(rest)
    return factors


def _factored_one_by_one(B: Floats) -> Floats:
    """Return L and U in one array, as `factored` does, state by state.

    The columns of L that are not known yet are those of the identity, so that one triangular
    solve with it moves the arcs out of a state through all states before it.
    """
    height, size = B.shape
    columns = np.zeros((height, height))
    columns.ravel()[:: height + 1] = 1.0
    factors = columns.T
    numbered = enumerate(zip(B.T, columns, _LATER[:size, :height], strict=False))
    for k, (arcs, column, later) in numbered:
        # Lower, overwriting; to pass these by name would take longer than the solve.
        moved_on = dtrsv(factors, arcs, 1, 0, 1, 0, 0, 1)
        moved_on[k] = ddot(moved_on, later)
        np.copyto(column, moved_on)
    return np.asfortranarray(factors[:size, :size])


def less(C: Floats, A: Floats, B: Floats, *, transposed: bool = False) -> Floats:
    """Return C - A B (A transposed on request); C may be overwritten.

    Only `_TERMS` products at a time are added up sequentially, which keeps rounding errors small.
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


def solved(block: Floats, B: Floats, part: str, *, transposed: bool = False) -> Floats:
    """Return L^-1 B or U^-1 B for a factored block (transposed on request); may overwrite B."""
    B = np.asfortranarray(B)
    lower, columns = part == "L", B.shape[1]
    few = _FEW // max(len(block), 1)
    step = few if few and block.size * columns < _LARGE else max(columns, 1)
    for k in range(0, columns, step):
        right = B[:, k : k + step]
        dtrsm(1.0, block, right, lower=lower, diag=not lower, trans_a=transposed, overwrite_b=1)
    return B
