"""Elimination within many small classes, or of many chains with one graph, at once.

Graphs of the same size are stacked into one array, the last axis of which counts them, and each
step of the elimination of Grassmann, Taksar and Heyman (1985) is one vector operation over the
whole stack, so that no Python loop runs per graph. The arcs out of state k and into it are
finished in its turn, from those of the states before, which touches memory least:

    A[i, k] += sum of A[i, l] A[l, k] over l < k,   i > k,   d[k] = sum of A[i, k] over i > k,
    A[k, j] = (A[k, j] + sum of A[k, l] A[l, j] over l < k) / d[k],   j > k.

For classes, the result is the arcs of a larger graph without cycles, in which each state of such
a class appears twice: as it is entered and as it is left. A flow through the classes is then
found by one forward substitution (see `triangular_solve`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places

_ENTRIES = 2_000_000


class Factors(NamedTuple):
    """The factors of a stack of classes: pivots, and arcs as (sources, targets, chances).

    The flow that enters a state moves on along `onward` to states eliminated later; divided
    by `pivot` it gives visits, and visits to a state bring visits along `back` to states
    eliminated earlier.
    """

    pivot: NDArray[np.float64]
    onward: tuple[Places, Places, NDArray[np.float64]]
    back: tuple[Places, Places, NDArray[np.float64]]


def stacks(sizes: Places) -> Iterator[tuple[int, Places]]:
    """Yield (size, classes) for sizes above 1, as many classes at once as memory allows."""
    for size in np.unique(sizes[sizes > 1]).tolist():
        members = np.flatnonzero(sizes == size)
        step = max(1, _ENTRIES // (size * size))
        for first in range(0, len(members), step):
            yield size, members[first : first + step]


def eliminate_stack(W: NDArray[np.float64], first: Places) -> Factors:
    """Return the factors of a stack of classes; `W` is used up.

    Parameters
    ----------
    W
        shape (classes, s + 1, s): W[c, i, j] is the arc from the j-th to the i-th state of
        class c; row s is the leak.
    first
        shape (classes,): the number of the first state of each class.
    """
    size = W.shape[2]
    A = np.ascontiguousarray(np.moveaxis(W, 0, 2))
    pivot = eliminate_together(A, size)
    square = np.moveaxis(A[:size], 2, 0)
    lower = np.tril(np.ones((size, size), dtype=bool), -1)
    c, i, j = np.nonzero(square * lower)
    onward = (first[c] + j, first[c] + i, square[c, i, j] / pivot[j, c])
    c, i, j = np.nonzero(square * lower.T)
    back = (first[c] + j, first[c] + i, square[c, i, j])
    return Factors(pivot.T.reshape(-1), onward, back)


def eliminate_together(A: NDArray[np.float64], size: int) -> NDArray[np.float64]:
    """Eliminate the first states of all graphs of a stack in place; return the pivots.

    Parameters
    ----------
    A
        shape (m, n, graphs), m >= n >= size: A[i, j] is the arc from the j-th to the i-th state; a
        leak may be the last row. It becomes the arcs onward below the diagonal, and above it those
        back divided by the pivot of their target.
    size
        the number of states to eliminate.

    Returns
    -------
    numpy.ndarray
        shape (size, graphs).
    """
    pivot = np.empty((size, A.shape[2]))
    for k in range(size):
        onward, back, done = A[k + 1 :, k], A[k, k + 1 :], slice(k)
        onward += np.einsum("ilc,lc->ic", A[k + 1 :, done], A[done, k])
        back += np.einsum("lc,ljc->jc", A[k, done], A[done, k + 1 :])
        pivot[k] = onward.sum(axis=0)
        back /= pivot[k]
    return pivot
