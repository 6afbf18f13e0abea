"""The structure of a chain's graph, before any number is computed: classes, kinds, periods.

Two states belong to the same (communicating) class if each can be reached from the other.
The classes form an acyclic graph and are numbered in a topological order of it, upstream
first. A class that is never left is closed. Its states are recurrent, or absorbing if the
class is a single state; all other states are transient. The period of a class is the
greatest common divisor of the lengths of its cycles,

    d = gcd over arcs j -> i in the class of (depth[j] + 1 - depth[i]),

for depths in any tree of arcs that reaches the whole class.

References: Tarjan 1972 and Pearce 2005 for the classes (through scipy); Denardo 1977,
"Periods of connected networks and powers of nonnegative matrices", for the periods.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csgraph, csr_array

from evenbreak.arrays import Bools, array_values
from evenbreak.chains.arcs import Arcs, Places, tree_from


@array_values
@dataclass(frozen=True, eq=False)
class Structure:
    """The communicating classes of a chain.

    Parameters
    ----------
    label
        shape (n,): the class of each state; no arc leads to a class with a smaller number.
    arcs
        the arcs between different states.
    loops
        shape (n,): whether the state has a self-loop.
    """

    label: Places
    count: int
    arcs: Arcs
    loops: Bools

    @cached_property
    def order(self) -> Places:
        """The positions of the states, grouped by class, upstream first; shape (n,)."""
        return np.argsort(self.label, kind="stable")

    @property
    def is_acyclic(self) -> bool:
        """Whether each state is alone in its class."""
        return self.count == len(self.label)

    @cached_property
    def in_order(self) -> bool:
        """Whether the states are already listed class by class, upstream first."""
        return bool((self.label[:-1] <= self.label[1:]).all())

    @cached_property
    def offsets(self) -> Places:
        """Class c holds the states `order[offsets[c]:offsets[c + 1]]`; shape (k + 1,)."""
        sizes = np.bincount(self.label, minlength=self.count)
        return np.concatenate(([0], np.cumsum(sizes)))

    @cached_property
    def closed(self) -> Bools:
        """Whether each class is closed (never left); shape (k,)."""
        if self.is_acyclic:
            closed: Bools = self.arcs.outflow[self.order] == 0.0
            return closed
        source, target = self.label[self.arcs.sources], self.label[self.arcs.targets]
        closed = np.ones(self.count, dtype=bool)
        closed[source[source != target]] = False
        return closed

    @cached_property
    def recurrent(self) -> Bools:
        """Whether each state is in a closed class; shape (n,)."""
        return self.closed[self.label]

    @cached_property
    def kinds(self) -> list[str]:
        """The kind of each state: 'transient', 'recurrent' or 'absorbing'.

        A state that is never left is 'absorbing'; the states of a larger closed class are
        'recurrent'.
        """
        alone = np.diff(self.offsets)[self.label] == 1
        code = self.recurrent * (1 + alone)
        kinds = ("transient", "recurrent", "absorbing")
        return [kinds[k] for k in code.tolist()]

    def members(self, label: int) -> Places:
        """Return the positions of the states of class `label`."""
        return self.order[self.offsets[label] : self.offsets[label + 1]]

    @cached_property
    def periods(self) -> Places:
        """The period of each closed class, 0 for the others; shape (k,).

        A state that is never left has period 1, even if its self-loop is not listed.
        """
        sizes = np.diff(self.offsets)
        periods = np.where(self.closed, 1, 0).astype(np.int64)
        looped = np.zeros(self.count, dtype=bool)
        looped[self.label[self.loops]] = True
        searched = self.closed & (sizes > 1) & ~looped
        if searched.any():
            depth = self._depths(searched)
            source, target = self.arcs.sources, self.arcs.targets
            home = self.label[source]
            inside = np.flatnonzero(searched[home])
            inside = inside[np.argsort(home[inside], kind="stable")]
            slack = np.abs(depth[source[inside]] + 1 - depth[target[inside]])
            first = np.flatnonzero(np.diff(home[inside], prepend=-1))
            periods[home[inside][first]] = np.gcd.reduceat(slack, first)
        return periods

    @cached_property
    def phases(self) -> Places:
        """The step of the period at which each state of a closed class is visited; shape (n,).

        It is counted from the first state of the class, and 0 outside the closed classes.

        >>> from evenbreak.chains import chain_of
        >>> chain_of([("A", "B", 1.0), ("B", "A", 1.0), ("S", "B", 1.0)]).structure.phases
        array([0, 1, 0])
        """
        periods = np.maximum(self.periods, 1)
        if (periods == 1).all():
            return np.zeros(len(self.label), dtype=np.int64)
        depth = self._depths(periods > 1) - 1
        return np.asarray(np.where(self.recurrent, depth % periods[self.label], 0))

    def _depths(self, classes: Bools) -> Places:
        """Return the depth of each state of the given classes in a tree of arcs."""
        n = self.arcs.size
        roots = self.order[self.offsets[:-1][classes]]
        _, parent = tree_from(n, self.arcs.sources, self.arcs.targets, roots)
        parent[parent < 0] = n
        # Pointer jumping: after k rounds `parent` is the ancestor 2^k steps above.
        depth = np.where(np.arange(n + 1) == n, 0, 1).astype(np.int64)
        while (parent != n).any():
            depth += depth[parent]
            parent = parent[parent]
        return depth[:n]


def structure_of(arcs: Arcs, loops: Bools | None = None) -> Structure:
    """Return the communicating classes of the graph with these `arcs` between different states.

    Time is linear in the number of arcs. If all arcs lead forward in the given order, or all lead
    backward, no search is needed. Self-loops (`loops`) matter only for the periods.
    """
    n = arcs.size
    if loops is None:
        loops = np.zeros(n, dtype=bool)
    forward = arcs.sources < arcs.targets
    if forward.all():
        return Structure(np.arange(n), n, arcs, loops)
    if not forward.any():
        return Structure(np.arange(n)[::-1].copy(), n, arcs, loops)
    # Read as rows, the columns of M are the arcs as csgraph needs them. Pearce's algorithm
    # numbers a class only after all classes downstream of it.
    graph: csr_array[np.float64] = csr_array((arcs.chances, arcs.targets, arcs.indptr), (n, n))
    count, component = csgraph.connected_components(graph, directed=True, connection="strong")
    return Structure(count - 1 - component, int(count), arcs, loops)
