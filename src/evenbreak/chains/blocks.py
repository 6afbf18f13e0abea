"""Elimination within many small classes, or of many chains with one graph, at once.

Graphs of the same size are stacked into one array, the last axis of which counts them, and each
step of the elimination of Grassmann, Taksar and Heyman (1985) is one vector operation over the
whole stack, so that no Python loop runs per graph. The arcs out of state k and into it are
finished in its turn, from those of the states before, which touches memory least:

    A[i, k] += sum of A[i, l] A[l, k] over l < k,   i > k,   d[k] = sum of A[i, k] over i > k,
    A[k, j] = (A[k, j] + sum of A[k, l] A[l, j] over l < k) / d[k],   j > k.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from evenbreak.arrays import Floats


def eliminate_together(A: Floats, size: int) -> Floats:
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
