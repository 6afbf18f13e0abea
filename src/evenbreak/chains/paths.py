"""Random paths of a chain, many at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from scipy.sparse import csc_array

    from evenbreak.arrays import Floats, Ints


def random_paths(
    matrix: csc_array, begin: Floats, steps: int, paths: int, rng: np.random.Generator
) -> Ints:
    """Return positions of states, shape (paths, steps + 1); the first are drawn from `begin`.

    Each step compares one uniform number with the cumulative chances of the column, by
    bisection over all paths at once. An arc of chance 0 is never taken.

    >>> from scipy.sparse import csc_array
    >>> swap = csc_array([[0.0, 1.0], [1.0, 0.0]])
    >>> random_paths(swap, np.array([1.0, 0.0]), 3, 2, np.random.default_rng(1))
    array([[0, 1, 0, 1],
           [0, 1, 0, 1]])
    """
    found = np.empty((paths, steps + 1), dtype=np.int64)
    cumulative = np.cumsum(begin)
    found[:, 0] = np.searchsorted(cumulative, rng.random(paths) * cumulative[-1], side="right")
    first, last = matrix.indptr[:-1].astype(np.int64), matrix.indptr[1:].astype(np.int64) - 1
    total = np.cumsum(matrix.data)
    cumulative = total - np.repeat(total[first] - matrix.data[first], last - first + 1)
    for t in range(steps):
        low, high = first[found[:, t]], last[found[:, t]]
        u = rng.random(paths) * cumulative[high]
        while (low < high).any():
            middle = (low + high) // 2
            beyond = u >= cumulative[middle]
            low, high = np.where(beyond, middle + 1, low), np.where(beyond, high, middle)
        found[:, t + 1] = matrix.indices[low]
    return found
