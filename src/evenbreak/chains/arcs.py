"""The arcs of a chain between different states: all that a solver needs to know.

A self-loop carries no information of its own: its probability is the remainder of the state's other
arcs. So every solver starts from the off-diagonal entries of M and their column sums, the outflows,
and never computes 1 - M[j, j].
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csgraph, csr_array

from evenbreak.arrays import Bools, Floats, array_values

Places: TypeAlias = NDArray[np.integer[Any]]
"""Positions of states, or numbers of classes."""

_FEW_TERMS = 4
"""Number of values up to which they are added one after the other."""


@array_values
@dataclass(frozen=True, eq=False)
class Arcs:
    """Arcs between different states, in the order of their sources.

    The arcs out of state j are those from indptr[j] to indptr[j + 1]; states are positions; a
    chance, always positive, is the probability of the target, given the source.

    >>> arcs = arcs_of(csc_array([[0.25, 0.0], [0.75, 1.0]]))
    >>> arcs.sources, arcs.targets, arcs.chances, arcs.outflow
    (array([0], dtype=int32), array([1], dtype=int32), array([0.75]), array([0.75, 0.  ]))
    """

    size: int
    indptr: Places
    sources: Places
    targets: Places
    chances: Floats

    @cached_property
    def outflow(self) -> Floats:
        """The probability of leaving each state in a step: the sum of its arcs, shape (n,)."""
        return sums(self.sources, self.chances, self.size)

    def among(self, states: Places) -> tuple[Arcs, Floats]:
        """Return the arcs among some states, renumbered, and each state's chance of leaving them.

        States are increasing positions, shape (m,).
        """
        place = np.full(self.size, -1, dtype=np.int32)
        place[states] = np.arange(len(states), dtype=np.int32)
        sources, targets = place[self.sources], place[self.targets]
        own = sources >= 0
        inner = own & (targets >= 0)
        leaving = own & ~inner
        leak = sums(sources[leaving], self.chances[leaving], len(states))
        return _arcs(len(states), sources[inner], targets[inner], self.chances[inner]), leak

    def matrix(self) -> csc_array:
        """Return the arcs as a sparse matrix: entry [i, j] is the arc from j to i."""
        return csc_array((self.chances, self.targets, self.indptr), shape=(self.size, self.size))


def arcs_of(matrix: csc_array) -> Arcs:
    """Return the arcs between different states of a column-stochastic matrix.

    >>> arcs_of(csc_array([[1.0, 0.5], [0.0, 0.5]])).matrix().toarray()
    array([[0. , 0.5],
           [0. , 0. ]])
    """
    if not matrix.has_canonical_format:
        matrix = matrix.copy()
        matrix.sum_duplicates()
    size = matrix.shape[0]
    columns = np.arange(size, dtype=np.int32)
    sources = np.repeat(columns, np.diff(matrix.indptr))
    targets = matrix.indices.astype(np.int32, copy=False)
    chances = matrix.data.astype(np.float64, copy=False)
    keep = (sources != targets) & (chances > 0.0)
    if not keep.all():
        sources, targets, chances = sources[keep], targets[keep], chances[keep]
    return _arcs(size, sources, targets, chances)


def sums(place: Places, values: Floats, size: int) -> Floats:
    """Return the sum of the `values` at each place; shape (size,).

    If no value is negative, each sum is accurate to about one rounding, no matter how many values
    it adds up; if some are, it is accurate to one rounding of the sum of their absolute values. The
    values are split at the same bit for each place. The upper parts are added without rounding;
    the rounding errors of the lower parts are negligible (Rump, Ogita and Oishi 2008, "Accurate
    floating-point summation").

    >>> float(sums(np.zeros(10**6, dtype=int), np.full(10**6, 1e-6), 1)[0])
    1.0
    """
    if len(values) <= _FEW_TERMS or np.bincount(place).max() <= _FEW_TERMS:
        return np.bincount(place, values, size).astype(np.float64, copy=False)
    with np.errstate(over="ignore"):
        cut = np.ldexp(2.0, np.frexp(np.bincount(place, np.abs(values), size))[1])
    if not np.isfinite(cut).all():
        return np.asarray(np.bincount(place, values, size))
    cut = cut[place]
    upper = (cut + values) - cut
    rest = np.bincount(place, values - upper, size)
    return np.asarray(np.bincount(place, upper, size) + rest)


def summed(rows: Places, columns: Places, values: Floats, shape: tuple[int, int]) -> csr_array:
    """Return the sparse matrix whose entries are the `sums` of the values at each place.

    >>> summed(np.array([0, 0]), np.array([1, 1]), np.array([0.25, 0.5]), (1, 2)).toarray()
    array([[0.  , 0.75]])
    """
    keys = rows.astype(np.int64) * shape[1] + columns
    pairs, place = np.unique(keys, return_inverse=True)
    return csr_array((sums(place, values, len(pairs)), np.divmod(pairs, shape[1])), shape=shape)


def reachable(size: int, sources: Places, targets: Places, seeds: Bools) -> Bools:
    """Return which states can be reached from the `seeds`, including these; shape (size,).

    >>> reachable(3, np.array([0, 1]), np.array([1, 0]), np.array([True, False, False]))
    array([ True,  True, False])
    """
    reached = np.zeros(size, dtype=bool)
    reached[tree_from(size, sources, targets, np.flatnonzero(seeds))[0]] = True
    return reached


def tree_from(size: int, sources: Places, targets: Places, roots: Places) -> tuple[Places, Places]:
    """Return the states that can be reached from the `roots`, by distance, and a tree of arcs.

    The tree has the parent of each state, shape (size + 1,): `size` for the roots, and negative
    where there is none.
    """
    # One search, from a state `size` with an arc to every root.
    near = np.concatenate((sources, np.full(len(roots), size)))
    far = np.concatenate((targets, roots))
    graph = csr_array((np.ones(len(near)), (near, far)), shape=(size + 1, size + 1))
    order, parent = csgraph.breadth_first_order(graph, size)
    return order[1:], parent


def put_back(x: Floats, order: Places) -> Floats:
    """Return the rows of `x`, given in an order of states, sorted by state.

    >>> put_back(np.array([0.25, 0.5]), np.array([1, 0]))
    array([0.5 , 0.25])
    """
    y = np.empty_like(x)
    y[order] = x
    return y


def _arcs(size: int, sources: Places, targets: Places, chances: Floats) -> Arcs:
    indptr = np.zeros(size + 1, dtype=np.int32)
    np.cumsum(np.bincount(sources, minlength=size), out=indptr[1:])
    return Arcs(size, indptr, sources, targets, chances)
