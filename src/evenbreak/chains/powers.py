"""The probability vector after a number of steps: M^n v.

It takes n products with v, or about 2 log2(n) squares and products of a dense M, all free
of subtraction. Squaring is cubic in the number of states, so it pays off only for very many steps.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array

from evenbreak.arrays import Floats
from evenbreak.chains.arcs import sums
from evenbreak.chains.chain import Chain, check_chain
from evenbreak.checks import whole
from evenbreak.errors import InputError

MOST_APPLIED = 4_000_000_000
"""Limit on the number of steps: rounding errors of 2^-52 would add up to 1e-6."""
_SQUARED, _CALL = 500, 5000
"""Number of states up to which M may be squared; the overhead of a call, in arcs."""
_MOST_WORK, _MOST_ENTRIES = 5e10, 100_000_000
"""Limits: about a minute of steps, counted in arcs; and the entries in a path, 0.8 GB."""


def propagate(chain: Chain, start: Any = None, steps: int = 1, *, path: bool = False) -> Floats:
    """Return the probability vector after a number of steps, given the start.

    Parameters
    ----------
    chain
        the chain, n states.
    start
        as in `Chain.density`.
    steps
        how many steps, 0 or more.
    path
        whether to return the densities after 0, 1, ..., `steps` steps.

    Returns
    -------
    numpy.ndarray
        shape (n,), or (steps + 1, n) with `path`; each vector sums to 1.

    Raises
    ------
    InputError
        if `steps` is not a whole number from 0 to 4 billion, or taking them would last
        minutes, or a `path` would not fit in memory.
    ChainError
        if the start is neither a state nor a probability vector.

    Notes
    -----
    M is applied `steps` times or, for very many steps of at most 500 states, squared repeatedly.
    These are sums of products of nonnegative numbers, so the relative error of each entry is at
    most about steps * (arcs into a state) * 2^-52, with n instead of the arcs if M is squared. If
    rounding keeps a state's arcs from summing to 1, they are scaled, and so are the columns of the
    squares, so that no probability is lost on the way. Source: P5.23.

    >>> from evenbreak.chains import chain_of
    >>> duel = chain_of([("S1", "W", 0.5), ("S1", "S2", 0.5), ("S2", "L", 0.5), ("S2", "S1", 0.5)])
    >>> duel.states
    ['S1', 'W', 'S2', 'L']
    >>> propagate(duel, "S1", 2, path=True)
    array([[1.  , 0.  , 0.  , 0.  ],
           [0.  , 0.5 , 0.5 , 0.  ],
           [0.25, 0.5 , 0.  , 0.25]])
    """
    check_chain(chain)
    steps = whole(steps, "steps")
    if steps > MOST_APPLIED:
        raise InputError(
            f"steps is {steps}, and rounding errors would show after that many. Give "
            f"{MOST_APPLIED} or fewer, or ask for the stochastic limit."
        )
    v = chain.density(start)
    one_by_one = steps * (_CALL + chain.matrix.nnz)
    if not path and len(chain) <= _SQUARED and steps.bit_length() * len(chain) ** 3 < one_by_one:
        return _by_squares(evened(chain).toarray(), v, steps)
    if one_by_one > _MOST_WORK:
        most = int(_MOST_WORK // (_CALL + chain.matrix.nnz))
        raise InputError(
            f"steps is {steps}, too many to take one by one in a chain of {len(chain)} "
            f"states. Give {most} or fewer, or ask for the stochastic limit."
        )
    if path and (steps + 1) * len(chain) > _MOST_ENTRIES:
        most = max(_MOST_ENTRIES // len(chain) - 1, 0)
        raise InputError(
            f"steps is {steps}, and a path of that many vectors of {len(chain)} states doesn't "
            f"fit in memory. Give {most} or fewer, or leave out the path."
        )
    M = csr_array(evened(chain))
    densities = np.empty((steps + 1 if path else 1, len(chain)))
    densities[0] = v
    for t in range(1, steps + 1):
        v = M @ v
        if path:
            densities[t] = v
    return densities if path else v


def _by_squares(power: Floats, v: Floats, steps: int) -> Floats:
    """Return M^steps v by squaring `power`, which is initially M."""
    while steps:
        if steps & 1:
            v = power @ v
        steps >>= 1
        if steps:
            power = power @ power
            power /= power.sum(axis=0)
    return v


def evened(chain: Chain) -> csc_array:
    """Return the matrix of the chain with columns scaled to sum to 1."""
    M = chain.matrix
    columns = np.repeat(np.arange(len(chain)), np.diff(M.indptr))
    total = sums(columns, M.data, len(chain))
    if np.all(total == 1.0):
        return M
    data = M.data / total[columns]
    return csc_array((data, M.indices, M.indptr), shape=M.shape)
