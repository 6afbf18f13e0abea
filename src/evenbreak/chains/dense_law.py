"""The stationary law of a small chain that is one closed class, by dense LU with a proof.

With T the arcs, d the outflows and one state c held at 1, the law is proportional to x in

    d_i x_i - sum_j T_ij x_j = 0 for i other than c,    x_c = 1.

Write A for this matrix. LU in floats gives x, which is refined once in the platform's extended
precision. A is an M-matrix, so if u > 0 has A u >= s > 0, and x misses its equations by no more
than t s, then no entry of x is off by more than its entry of t u. If that proves the law
right to 1e-15 in every entry it is accepted; anything else is left to elimination. The proof also shows that the
chain is one closed class: x > 0 says that c reaches every state, u that every state reaches c.

Where a long double is no wider than a double, elimination always decides.

References: as for `certified_lu`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.linalg.lapack import dgetrf, dgetrs

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse import csc_array

MOST_STATES = 128
"""Larger chains are left to elimination, which then costs little more."""
_WIDE_EPS = float(np.finfo(np.longdouble).eps)
_PROVED = 1e-15
"""The relative error that must be proved; what is seen is one rounding."""


def dense_law(matrix: csc_array) -> NDArray[np.float64] | None:
    """Return the stationary law of a chain, or None if no digit of it can be proved here.

    The relative error of each entry is proved to be below 1e-15. None does not mean that there
    is no law.

    Parameters
    ----------
    matrix
        column-stochastic, shape (n, n), of at most `MOST_STATES` states.

    >>> from scipy.sparse import csc_array
    >>> dense_law(csc_array([[0.0, 0.5, 0.5], [0.25, 0.0, 0.5], [0.75, 0.5, 0.0]]))
    array([0.33333333, 0.28571429, 0.38095238])
    """
    n = matrix.shape[0]
    T = matrix.toarray()
    np.fill_diagonal(T, 0.0)
    wide = T.astype(np.longdouble)
    d = wide.sum(axis=0)
    if not d.all():
        return None
    c = int(T.sum(axis=1).argmax())
    system = np.array(-T, order="F")
    np.fill_diagonal(system, d)
    system[c] = 0.0
    system[c, c] = 1.0
    factors, swaps, singular = dgetrf(system, overwrite_a=True)
    if singular:
        return None

    def missed(x: NDArray[np.longdouble]) -> NDArray[np.longdouble]:
        into = wide @ x - d * x
        into[c] = 1.0 - x[c]
        return into

    def solved(b: NDArray[Any]) -> NDArray[np.longdouble]:
        return dgetrs(factors, swaps, b.astype(np.float64))[0].astype(np.longdouble)

    with np.errstate(all="ignore"):
        start = np.zeros(n)
        start[c] = 1.0
        x = solved(start)
        x += solved(missed(x))
        scale = d * x
        scale[c] = 1.0
        u = solved(scale)
        # Rounding may move an entry of `missed` by this much.
        rounding = (n + 4) * _WIDE_EPS
        gain = -missed(u) - rounding * np.abs(d * u)
        gain[c] = u[c]
        share = ((np.abs(missed(x)) + rounding * scale) / gain).max()
        if not (x > 0.0).all() or not (u > 0.0).all() or not (gain > 0.0).all():
            return None
        if not (share * u / x).max() <= _PROVED:
            return None
        return np.asarray(x / x.sum(), dtype=np.float64)
