"""The eigenvectors of eigenvalue 1, and the limit that they give, with a proved bound.

The structure says how often eigenvalue 1 occurs and where its vectors live: once for each closed
class, whose right vector R is the stationary law and whose left vector L is the chance of ending
there. Both are solved for from the arcs, by LU factors that are applied again to what is still
missed, in pairs of doubles (see `certified`). With A = D - T, the arcs T among some states and D
the chances of leaving them:

- L v, for a start v, needs one solve for all classes: x = A^-1 v_T are the visits to the transient
  states, and L_C v = v_C + B_C x with the arcs B_C into class C. Every column of A and B together
  sums to 0, so that residuals r put the chances off by no more than sum |r|.
- R: a state where some steps from anywhere spend much time is cut out of each class; the others
  solve A x = the arcs out of it. A w >= 1, checked in pairs too, proves that no entry is off by
  more than its w times the largest residual (A is an M-matrix).

Other eigenvalues may therefore lie as close to 1 as they like without mixing in.

Reference: Varga 1962, Matrix Iterative Analysis, for bounds by M-matrices.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.arcs import reachable, sums
from evenbreak.chains.certified import CertifiedSolve, spread
from evenbreak.chains.dissection import dissect, neighbours
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.arrays import Bools, Floats
    from evenbreak.chains.arcs import Places
    from evenbreak.chains.chain import Chain

EPS = float(np.finfo(float).eps)
_FEW, _MUCH_WORK = 1000, 1e11
"""So few states are factored whatever their graph; others, with up to so many multiplications."""


class UnitPairs:
    """The vectors of eigenvalue 1 of a chain.

    Parameters
    ----------
    chain
        the chain, n states.

    Raises
    ------
    AccuracyError
        from all that is asked of it, if no bound on the errors is found.
    """

    def __init__(self, chain: Chain) -> None:
        self._chain = chain
        structure = chain.structure
        number = np.full(structure.count, -1)
        number[structure.closed] = np.arange(structure.closed.sum())
        self._class = number[structure.label]
        """The number of the closed class of each state, -1 if it is transient."""
        self.count = int(structure.closed.sum())

    @cached_property
    def right(self) -> Floats:
        """The stationary laws; shape (n, closed classes)."""
        right = np.zeros((len(self._chain), self.count))
        states = np.flatnonzero(self._class >= 0)
        right[states, self._class[states]] = self._all_laws[0][states]
        return right

    @property
    def left(self) -> Floats:
        """The chances of ending in each class; shape (closed classes, n)."""
        return self._chances[0]

    @property
    def error(self) -> float:
        """A bound on the sum of the errors of the limit R (L v), from any start v.

        The product L v is to be right to about one rounding; see `limit_by`.
        """
        return self._all_laws[1] + self._chances[1] + 2.0 * EPS

    def limit(self, v: Floats) -> tuple[Floats, float]:
        """Return the limit R (L v), and a bound on the sum of its errors.

        One solve gives L v; no more of L is calculated.
        """
        arcs = self._chain.arcs
        seen = reachable(arcs.size, arcs.sources, arcs.targets, v > 0.0)
        visits, lost = np.zeros(arcs.size), 0.0
        states = np.flatnonzero(seen & (self._class < 0))
        if len(states):
            visits[states], missed = self._equations(states).forward.near(v[states])
            lost = float(missed.sum())
        entering = (self._class[arcs.sources] < 0) & (self._class[arcs.targets] >= 0)
        flow = arcs.chances[entering] * visits[arcs.sources[entering]]
        own = np.flatnonzero(self._class >= 0)
        into = self._class[np.concatenate((own, arcs.targets[entering]))]
        chances = sums(into, np.concatenate((v[own], flow)), self.count)
        law, error = self._laws(chances > 0.0)
        return law * np.where(self._class < 0, 0.0, chances[self._class]), lost + error + 6.0 * EPS

    @cached_property
    def _all_laws(self) -> tuple[Floats, float]:
        return self._laws(np.ones(self.count, dtype=bool))

    def _laws(self, wanted: Bools) -> tuple[Floats, float]:
        """Return the laws of the wanted closed classes, by state, and a bound on the errors of one.

        With x = 1 at the state that is cut out of a class, the law is x over its sum. If x is off
        by e, the law is off by no more than 2 sum |e|.
        """
        law = np.zeros(len(self._chain))
        here = self._class >= 0
        here[here] = wanted[self._class[here]]
        alone = here & (np.diff(self._chain.arcs.indptr) == 0)
        law[alone] = 1.0
        states = np.flatnonzero(here & ~alone)
        if not len(states):
            return law, 0.0
        arcs = self._chain.arcs
        out = np.bincount(arcs.sources, arcs.chances, arcs.size)
        likely = spread(arcs.matrix(), np.where(out > 0.0, out, 1.0))
        order = np.lexsort((likely[states], self._class[states]))
        last = np.append(np.diff(self._class[states[order]]) > 0, True)
        law[states[order[last]]] = 1.0
        rest = states[law[states] == 0.0]
        equations = self._equations(rest).forward
        law[rest], missed = equations.near((arcs.matrix() @ law)[rest])
        total = sums(self._class[states], law[states], self.count)
        law[states] /= total[self._class[states]]
        return law, 2.0 * float(equations.error(missed).sum()) + 4.0 * EPS

    @cached_property
    def _chances(self) -> tuple[Floats, float]:
        """The left vectors, and a bound on the sum of the errors of a column."""
        arcs = self._chain.arcs
        left = np.zeros((self.count, arcs.size))
        own = np.flatnonzero(self._class >= 0)
        left[self._class[own], own] = 1.0
        states = np.flatnonzero(self._class < 0)
        if not len(states):
            return left, 0.0
        place = np.full(arcs.size, -1)
        place[states] = np.arange(len(states))
        entering = (place[arcs.sources] >= 0) & (place[arcs.targets] < 0)
        sources, targets = place[arcs.sources[entering]], self._class[arcs.targets[entering]]
        ways = targets * len(states) + sources
        into = sums(ways, arcs.chances[entering], self.count * len(states))
        equations = self._equations(states).backward
        missed = np.zeros(len(states))
        for row, column in zip(left, into.reshape(self.count, -1), strict=True):
            row[states], more = equations.near(column)
            missed += more
        return left, float(equations.error(missed).max()) + 4.0 * EPS

    def _equations(self, states: Places) -> CertifiedSolve:
        """Return the equations of some states, factored.

        Raises
        ------
        AccuracyError
            if that would take too long, or floats take the factors for singular.
        """
        arcs, leak = self._chain.arcs.among(states)
        T, m = arcs.matrix(), len(states)
        work = sum(front.work for front in dissect(neighbours(T))[1]) if m > _FEW else 0.0
        if work > _MUCH_WORK:
            raise AccuracyError(
                f"{m:,} states that nothing cuts in two take some {work:.0e} multiplications to "
                "factor, which is too much for eigenvectors; use elimination, as stochastic_limit "
                "does"
            )
        return CertifiedSolve(T, leak, factored=True)


def limit_by(right: NDArray[Any], left: NDArray[Any], v: Floats) -> Floats:
    """Return the limit R (L v) by the vectors of eigenvalue 1, L v being right to one rounding.

    >>> limit_by(np.eye(2), np.array([[1.0, 0.25], [0.0, 0.75]]), np.array([0.5, 0.5]))
    array([0.625, 0.375])
    """
    chances = [math.fsum(row) for row in left.real[:, v > 0.0] * v[v > 0.0]]
    return np.asarray(right.real @ np.array(chances))
