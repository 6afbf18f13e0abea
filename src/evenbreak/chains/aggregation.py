"""Approximate solver for balance equations, by aggregation and disaggregation on many levels.

States that exchange much flow are joined in pairs, and the pairs in pairs, until a few hundred
groups are left, which are solved for directly. On the way back, each group's correction is applied
equally to all its states, and a step of Jacobi iteration before and after smooths the differences
within groups. Each level visits the coarser one twice (a W cycle), which costs about as much as the
finest level alone.

The equations are in terms of flows: entry [i, j] of B off the diagonal is minus the flow from j to
i, about the chance of the arc times the expected visits to j, and the flows into and out of a state
nearly balance. Then a group of states is a state of a smaller chain, and a constant is nearly a
solution on every level, so a handful of cycles is enough for grids of any dimension, for graphs
without a small separator, and for parts that hardly communicate.

References: Takahashi 1975; Koury, McAllister and Stewart 1984, "Iterative methods for computing
stationary distributions of nearly completely decomposable Markov chains"; Horton and Leutenegger
1994; Notay 2010, "An aggregation-based algebraic multigrid method".
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array
from scipy.sparse.linalg import splu

from evenbreak.arrays import Floats
from evenbreak.chains.arcs import Places

_FEW = 400
"""Number of groups up to which they are solved for directly."""
_DAMPING = 0.7
_MATCHINGS = 6


class _Level(NamedTuple):
    matrix: csr_array
    step: Floats
    group: Places


class Aggregation:
    """Approximate inverse of B; calling it on b, of shape (m,), returns roughly B^-1 b.

    B is sparse, shape (m, m): positive on the diagonal, nowhere else. Raises RuntimeError if the
    equations of the last groups are singular in floating point.
    """

    def __init__(self, B: csr_array) -> None:
        self._levels: list[_Level] = []
        rng = np.random.default_rng(0)
        while B.shape[0] > _FEW:
            group = _pairs(B, rng)
            pairs = _joined(B, group)
            group = _pairs(pairs, rng)[group]
            self._levels.append(_Level(B, _DAMPING / B.diagonal(), group))
            B = _joined(B, group)
        self._last = splu(csc_array(B))

    def __call__(self, b: Floats, level: int = 0) -> Floats:
        """Return an approximation to B^-1 b, from the given level on."""
        if level == len(self._levels):
            return np.asarray(self._last.solve(b))
        B, step, group = self._levels[level]
        x = step * b
        missed = np.bincount(group, b - B @ x).astype(np.float64, copy=False)
        more = self(missed, level + 1)
        if level + 1 < len(self._levels) and 3 * len(more) <= len(b):
            more += self(missed - self._levels[level + 1].matrix @ more, level + 1)
        x += more[group]
        x += step * (b - B @ x)
        return x


def _pairs(B: csr_array, rng: np.random.Generator) -> Places:
    """Return a group for each state: pairs that exchange much; leftover states join a pair."""
    size = B.shape[0]
    flows = csr_array(abs(B) + abs(B.T))
    flows.setdiag(0.0)
    flows.eliminate_zeros()
    source, target = np.repeat(np.arange(size), np.diff(flows.indptr)), flows.indices
    # Chance decides between equal flows, and later pairs states that are nobody's largest flow.
    taste = rng.random(size)
    weight = flows.data * (1.0 + 0.01 * (taste[source] + taste[target]))
    group, states = np.full(size, -1), np.arange(size)
    for k in range(_MATCHINGS):
        free = group < 0
        wish = weight if k < _MATCHINGS // 2 else taste[source] + taste[target]
        wanted = _heaviest(flows.indptr, source, target, wish * (free[source] & free[target]))
        mutual = (wanted >= 0) & (wanted[wanted] == states)
        group[mutual] = np.minimum(states, wanted)[mutual]
        taste = rng.random(size)
    paired = group >= 0
    wanted = _heaviest(flows.indptr, source, target, weight * paired[target])
    group = np.where(paired, group, np.where(wanted >= 0, group[wanted], states))
    return np.unique(group, return_inverse=True)[1]


def _heaviest(indptr: Places, source: Places, target: Places, weight: Floats) -> Places:
    """Return the target of each state's heaviest arc, or -1 if all weigh nothing."""
    most = np.maximum.reduceat(np.append(weight, 0.0), indptr[:-1])
    most[np.diff(indptr) == 0] = 0.0
    heaviest = (weight > 0.0) & (weight == most[source])
    wanted = np.full(len(indptr) - 1, -1)
    wanted[source[heaviest]] = target[heaviest]
    return wanted


def _joined(B: csr_array, group: Places) -> csr_array:
    """Return the equations of the groups: sums of each group's equations and unknowns."""
    entries, size = B.tocoo(), int(group.max()) + 1
    at = group[entries.row], group[entries.col]
    return csr_array(coo_array((entries.data, at), shape=(size, size)))
