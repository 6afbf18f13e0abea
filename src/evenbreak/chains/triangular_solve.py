"""One forward substitution through single states and small classes.

A state that is alone in its class is watched only when it moves: with P[i, j] the arc from
j to i over the sum of all arcs out of j, the flow f through the states from a density b
obeys

    f[i] = b[i] + sum over j of P[i, j] f[j],

upstream states first. This is a triangular system whose terms all have one sign, and the
expected visits are f[j] over the sum of the arcs out of j. A small class of several states
enters it with each state twice, as it is entered and as it is left, joined by the factors
of `blocks`. So the whole is triangular, its size at most twice the number of states, and
I - T and its transpose are each solved in one call.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array, csr_array
from scipy.sparse.linalg import spsolve_triangular

from evenbreak.chains.arcs import sums
from evenbreak.chains.blocks import eliminate_stack, stacks

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places

_FEW_TERMS = 256
"""More arcs into or out of a state are added up with a correction."""


class TriangularSolve:
    """(I - T) factored for consecutive classes, all of them small.

    Parameters
    ----------
    sources, targets, chances
        the arcs among the states, which are numbered class by class, upstream first.
    leak
        shape (m,): the chance of leaving all these states, given the state; only read for
        classes of several states.
    outflow
        shape (m,): the chance of leaving the state; only read for states alone in their
        class.
    offsets
        shape (classes + 1,): the first state of each class, and m.
    """

    def __init__(
        self,
        sources: Places,
        targets: Places,
        chances: NDArray[np.float64],
        leak: NDArray[np.float64],
        outflow: NDArray[np.float64],
        offsets: Places,
    ) -> None:
        m = int(offsets[-1])
        sizes = np.diff(offsets)
        self.pivots = outflow
        self._unit = outflow
        if len(sizes) == m:
            self._enter = self._leave = None
            self._system = _unit_lower(m, sources, targets, chances / outflow[sources])
            return
        label = np.repeat(np.arange(len(sizes)), sizes)
        twice = sizes > 1
        self.pivots = outflow.copy()
        self._unit = np.where(twice[label], 1.0, outflow)
        width = np.where(twice, 2 * sizes, 1)
        begin = np.cumsum(width) - width
        number = np.arange(m) - offsets[label]
        self._enter = begin[label] + number
        # Left in the opposite order: the last state to be eliminated is known first.
        self._leave = np.where(twice[label], begin[label] + width[label] - 1 - number, self._enter)
        inside = label[sources] == label[targets]
        across = ~inside
        columns = [self._leave[sources[across]]]
        rows = [self._enter[targets[across]]]
        entries = [chances[across] / self._unit[sources[across]]]
        leaks = leak + sums(sources[across], chances[across], m)
        inner = _Inner(sources[inside], targets[inside], chances[inside], label)
        for size, classes in stacks(sizes):
            first = offsets[classes]
            factors = eliminate_stack(inner.stack(classes, first, size, leaks), first)
            states = (first[:, None] + np.arange(size)).reshape(-1)
            self.pivots[states] = factors.pivot
            columns += [self._enter[states], self._enter[factors.onward[0]]]
            rows += [self._leave[states], self._enter[factors.onward[1]]]
            entries += [1.0 / factors.pivot, factors.onward[2]]
            columns.append(self._leave[factors.back[0]])
            rows.append(self._leave[factors.back[1]])
            entries.append(factors.back[2])
        self._system = _unit_lower(
            int(width.sum()), np.concatenate(columns), np.concatenate(rows), np.concatenate(entries)
        )

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        flow = self._solve(self._system, b, self._enter, self._leave, lower=True)
        return flow / self._unit[:, None]

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        given = r / self._unit[:, None]
        return self._solve(self._system.T, given, self._leave, self._enter, lower=False)

    @cached_property
    def _most_terms(self) -> int:
        """The largest number of arcs into or out of a state."""
        into = np.bincount(self._system.indices).max(initial=0)
        return max(int(into), int(np.diff(self._system.indptr).max(initial=0)))

    def _solve(
        self,
        system: csc_array | csr_array,
        given: NDArray[np.float64],
        put: Places | None,
        take: Places | None,
        *,
        lower: bool,
    ) -> NDArray[np.float64]:
        if put is not None:
            known = np.zeros((system.shape[0], given.shape[1]))
            known[put] = given
        else:
            known = given
        x: NDArray[np.float64] = spsolve_triangular(
            system, known, lower=lower, unit_diagonal=True, overwrite_A=True
        )
        if self._most_terms > _FEW_TERMS:
            # Terms added up one after the other lose digits that one correction brings back.
            missed = known - x + _flow(system, x)
            x += spsolve_triangular(
                system, missed, lower=lower, unit_diagonal=True, overwrite_A=True
            )
        return x if take is None else x[take]


class _Inner:
    """The arcs within classes, sorted by class, from which stacks are made."""

    def __init__(
        self,
        sources: Places,
        targets: Places,
        chances: NDArray[np.float64],
        label: Places,
    ) -> None:
        home = label[sources]
        by_class = np.argsort(home, kind="stable")
        self._sources, self._targets = sources[by_class], targets[by_class]
        self._chances = chances[by_class]
        self._begin = np.searchsorted(home[by_class], np.arange(label[-1] + 2))

    def stack(
        self,
        classes: Places,
        first: Places,
        size: int,
        leaks: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Return the classes (all of `size` states) as one array, their leaks last."""
        count = self._begin[classes + 1] - self._begin[classes]
        layer = np.repeat(np.arange(len(classes)), count)
        arcs = np.arange(count.sum()) + np.repeat(
            self._begin[classes] - (np.cumsum(count) - count), count
        )
        W = np.zeros((len(classes), size + 1, size))
        base = first[layer]
        W[layer, self._targets[arcs] - base, self._sources[arcs] - base] = self._chances[arcs]
        W[:, size] = leaks[first[:, None] + np.arange(size)]
        return W


def _flow(system: csc_array | csr_array, x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return E x for the system I - E, each entry right to about one rounding."""
    entries = system.tocoo()
    beside = entries.row != entries.col
    row, column, chances = entries.row[beside], entries.col[beside], -entries.data[beside]
    flows = [sums(row, chances * x[column, k], len(x)) for k in range(x.shape[1])]
    return np.stack(flows, axis=1)


def _unit_lower(
    size: int,
    columns: Places,
    rows: Places,
    entries: NDArray[np.float64],
) -> csc_array:
    """Return I - E for arcs E that all lead forward, sorted and with ones as SuperLU needs it."""
    places = np.arange(size, dtype=np.int32)
    return csc_array(
        (
            np.concatenate((np.ones(size), -entries)),
            tuple(
                np.concatenate((places, ends), dtype=np.int32, casting="same_kind")
                for ends in (rows, columns)
            ),
        ),
        shape=(size, size),
    )
