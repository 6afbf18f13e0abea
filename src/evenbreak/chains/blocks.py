"""Elimination within many small classes at once.

Classes of the same size s are stacked into one array, and each step of the elimination of
Grassmann, Taksar and Heyman (1985) is one vector operation over the whole stack, so that no
Python loop runs per class:

    W[c, i, j] += W[c, i, k] W[c, k, j] / d[c, k],   i, j > k,   d[c, k] = sum of W[c, i, k], i > k.

The result is the arcs of a larger graph without cycles, in which each state of such a class
appears twice: as it is entered and as it is left. A flow through the classes is then found
by one forward substitution (see `triangular_solve`).
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
    count, _, size = W.shape
    pivot = np.empty((count, size))
    for k in range(size):
        pivot[:, k] = W[:, k + 1 :, k].sum(axis=1)
        W[:, k, k + 1 :] /= pivot[:, k, None]
        W[:, k + 1 :, k + 1 :] += W[:, k + 1 :, k, None] * W[:, k, None, k + 1 :]
    square = W[:, :size]
    lower = np.tril(np.ones((size, size), dtype=bool), -1)
    c, i, j = np.nonzero(square * lower)
    onward = (first[c] + j, first[c] + i, square[c, i, j] / pivot[c, j])
    c, i, j = np.nonzero(square * lower.T)
    return Factors(pivot.reshape(-1), onward, (first[c] + j, first[c] + i, square[c, i, j]))
