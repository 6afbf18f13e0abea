"""The stationary law of one small class, by elimination of states in a dense array.

States are cut off from the last one on. With s the sum of the arcs from k to the states before
it, the array A of arcs and the column l = A[:k, k] / s,

    A[:k, :k] += l A[k, :k]^T,   law[k] = law[:k] . l.

Two calls of BLAS a state do this, so that the calls cost little even for thirty states. Both add
up positive numbers only; the signs in the code are those that the triangular solve expects.

References: Grassmann, Taksar and Heyman 1985; O'Cinneide 1993.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg.blas import dger, dtrsv

from evenbreak.chains.transient import where_doubtful

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Arcs

_ALWAYS, _IF_DENSE = 64, 256
"""Up to so many states of any class, or of one with a quarter of all arcs, this is fastest."""


def is_small(arcs: Arcs) -> bool:
    """Whether the states are so few, or the arcs so many, that a dense array is best."""
    return arcs.size <= _ALWAYS or (
        arcs.size <= _IF_DENSE and 4 * len(arcs.chances) >= arcs.size**2
    )


def dense_law(arcs: Arcs) -> NDArray[np.float64] | None:
    """Return the law of the one class that the arcs make, or None if floats may be too short.

    >>> from scipy.sparse import csc_array
    >>> from evenbreak.chains.arcs import arcs_of
    >>> dense_law(arcs_of(csc_array([[0.5, 0.25], [0.5, 0.75]])))
    array([0.33333333, 0.66666667])
    """
    n = arcs.size
    A = np.zeros((n, n), order="F")
    A[arcs.sources, arcs.targets] = arcs.chances
    minus_l = np.zeros((n, n), order="F")
    ones, pivots = np.ones(n), np.ones(n)
    with np.errstate(all="ignore"):
        for k in range(n - 1, 0, -1):
            row = A[k, :k]
            pivots[k] = pivot = row.dot(ones[:k])
            np.divide(A[:k, k], -pivot, out=minus_l[:k, k])
            dger(-1.0, minus_l[:, k], row, a=A[:, :k], overwrite_a=1)
        law: NDArray[np.float64] = np.zeros(n)
        law[0] = 1.0
        law = dtrsv(minus_l, law, trans=1, diag=1)
        if where_doubtful(law[:, None], 1.0 / pivots).any():
            return None
        law /= law.max()
    law /= law.sum()
    return law
