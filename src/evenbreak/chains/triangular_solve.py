"""One forward substitution through single states and small classes.

A state that is alone in its class is watched only when it moves: with P[i, j] the arc from
j to i over the sum of all arcs out of j, the flow f through the states from a density b
obeys

    f[i] = b[i] + sum over j of P[i, j] f[j],

upstream states first. This is a triangular system whose terms all have one sign, and the
expected visits are f[j] over the sum of the arcs out of j. A small class of several states
enters it with each state twice, as it is entered and as it is left, joined by the factors
of `blocks`: what enters a state moves on to states eliminated later, divided by the pivot it is
the visits to it, and visits to a state bring visits to states eliminated earlier. So the whole
is triangular, its size at most twice the number of states, and I - T and its transpose are each
solved in one call.
"""

from __future__ import annotations

from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import spsolve_triangular

from evenbreak.chains.arcs import sums

if TYPE_CHECKING:
    from evenbreak.arrays import Floats


if TYPE_CHECKING:
    from collections.abc import Iterator

    from evenbreak.arrays import Floats
    from evenbreak.chains.arcs import Places

    Triples = tuple[Places, Places, Floats]

_ENTRIES = 2_000_000
_FEW_TERMS = 256
"""More arcs into or out of a state are added up with a correction."""


class TriangularSolve:
    """(I - T) factored for consecutive classes, all of them small.

    Parameters
    ----------
    arcs
        sources, targets and chances of the arcs among the states, which are numbered class by
        class, upstream first.
    leak
        shape (m,): the chance of leaving all these states, given the state; only read for
        classes of several states.
    outflow
        shape (m,): the chance of leaving the state; only read for states alone in their
        class.
    offsets
        shape (classes + 1,): the first state of each class, and m.
    """

    def __init__(self, arcs: Triples, leak: Floats, outflow: Floats, offsets: Places) -> None:
        sources, targets, chances = arcs
        m, sizes = int(offsets[-1]), np.diff(offsets)
        self.pivots = self._unit = outflow
        self._enter: Places | slice = slice(None)
        self._leave: Places | slice = slice(None)
        if len(sizes) == m:
            self._system = _unit_lower(m, sources, targets, chances / outflow[sources])
            return
        label = np.repeat(np.arange(len(sizes)), sizes)
        width = np.where(sizes > 1, 2 * sizes, 1)
        begin = np.cumsum(width) - width
        number = np.arange(m) - offsets[label]
        self.pivots = outflow.copy()
        self._unit = np.where(sizes[label] > 1, 1.0, outflow)
        self._enter = entered = begin[label] + number
        # Left in the opposite order: the last state to be eliminated is known first.
        self._leave = left = (begin + width - 1)[label] - number
        inside = label[sources] == label[targets]
        across = ~inside
        columns = [left[sources[across]]]
        rows = [entered[targets[across]]]
        entries = [chances[across] / self._unit[sources[across]]]
        leaks = leak + sums(sources[across], chances[across], m)
        inner = sources[inside], targets[inside], chances[inside]
        for states, A in _stacks(offsets, label, inner, leaks):
            size = len(states)
            self.pivots[states] = pivot = eliminate_together(A, size)
            made, onward = A[:size] != 0.0, np.tri(size, k=-1, dtype=bool)[:, :, None]
            enter, leave = entered[states], left[states]
            columns += [enter.ravel(), np.where(onward, enter, leave)[made]]
            rows += [leave.ravel(), np.where(onward, enter[:, None], leave[:, None])[made]]
            entries += [1.0 / pivot.ravel(), (A[:size] / np.where(onward, pivot, 1.0))[made]]
        self._system = _unit_lower(
            int(width.sum()), np.concatenate(columns), np.concatenate(rows), np.concatenate(entries)
        )

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        return self._solved(b, transposed=False) / self._unit[:, None]

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        return self._solved(r / self._unit[:, None], transposed=True)

    @cached_property
    def _most_terms(self) -> int:
        """The largest number of arcs into or out of a state."""
        into = np.bincount(self._system.indices).max(initial=0)
        return max(int(into), int(np.diff(self._system.indptr).max(initial=0)))

    def _solved(self, given: Floats, *, transposed: bool) -> Floats:
        system = self._system.T if transposed else self._system
        put, take = (self._leave, self._enter) if transposed else (self._enter, self._leave)
        known = np.zeros((system.shape[0], given.shape[1]))
        known[put] = given
        solve = partial(
            spsolve_triangular, system, lower=not transposed, unit_diagonal=True, overwrite_A=True
        )
        x: Floats = solve(known)
        if self._most_terms > _FEW_TERMS:
            # Terms added up one after the other lose digits that one correction brings back.
            entries = system.tocoo()
            terms = (entries.data * column[entries.col] for column in x.T)
            found = np.stack([sums(entries.row, term, len(x)) for term in terms], axis=1)
            x += solve(known - found)
        return x[take]


def _stacks(
    offsets: Places, label: Places, arcs: Triples, leaks: Floats
) -> Iterator[tuple[Places, Floats]]:
    """Yield the classes of several states, those of one size together, as memory allows.

    Each stack is the states, shape (size, classes), and their arcs, shape (size + 1, size,
    classes): entry [i, j] is the arc from the j-th to the i-th state, and the last row the leaks.
    """
    sources, targets, chances = arcs
    sizes = np.diff(offsets)
    layers = np.empty(len(sizes), dtype=np.intp)
    for size in np.unique(sizes[sizes > 1]).tolist():
        classes = np.flatnonzero(sizes == size)
        for stack in np.array_split(classes, len(classes) * size * size // _ENTRIES + 1):
            layers[:] = -1
            layers[stack] = np.arange(len(stack))
            layer = layers[label[sources]]
            own, lowest = layer >= 0, offsets[stack]
            layer = layer[own]
            A = np.zeros((size + 1, size, len(stack)))
            A[targets[own] - lowest[layer], sources[own] - lowest[layer], layer] = chances[own]
            states = lowest + np.arange(size)[:, None]
            A[size] = leaks[states]
            yield states, A


def _unit_lower(size: int, columns: Places, rows: Places, entries: Floats) -> csc_array:
    """Return I - E for arcs E that all lead forward, sorted and with ones as SuperLU needs it."""
    diagonal = np.arange(size, dtype=np.int32)
    at = [
        np.concatenate((diagonal, ends), dtype=np.int32, casting="same_kind")
        for ends in (rows, columns)
    ]
    return csc_array((np.concatenate((np.ones(size), -entries)), tuple(at)), shape=(size, size))


# Elimination within many small classes, or of many chains with one graph, at once.
#
# Graphs of the same size are stacked into one array, the last axis of which counts them, and each
# step of the elimination of Grassmann, Taksar and Heyman (1985) is one vector operation over the
# whole stack, so that no Python loop runs per graph. The arcs out of state k and into it are
# finished in its turn, from those of the states before, which touches memory least:
#
#     A[i, k] += sum of A[i, l] A[l, k] over l < k,   i > k,   d[k] = sum of A[i, k] over i > k,
#     A[k, j] = (A[k, j] + sum of A[k, l] A[l, j] over l < k) / d[k],   j > k.


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
