"""The stochastic limit: where a chain ends, or what it does in the long run.

The limit is the projection of the start density on the eigenspace of M to the eigenvalue 1:
each closed class gets the probability of ending in it, spread by its stationary law. Where
all closed classes reached have period 1 it is lim M^n v; else M^n v goes round for ever and
it is the long-run average (Cesàro) limit.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csc_array

from evenbreak.chains.factorisation import Factorisation, path_order
from evenbreak.chains.line import line_law
from evenbreak.chains.transient import TransientPart
from evenbreak.chains.wide import wide_law

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Arcs
    from evenbreak.chains.chain import Chain

__all__ = [
    "Limit",
    "absorption",
    "expected_visits",
    "limit_matrix",
    "stationary_laws",
    "stochastic_limit",
]


@dataclass(frozen=True, eq=False)
class Limit:
    """A stochastic limit; `limit[state]` is the probability of a state.

    Parameters
    ----------
    chain
        the chain.
    probability
        shape (n,): the limit of each state, given the start.
    period
        the least common multiple of the periods of the closed classes reached.
    residual
        None where each entry is right to a few units in the last place times the number of
        states; otherwise the largest entry by which the answer misses what was solved.
    """

    chain: Chain
    probability: NDArray[np.float64]
    period: int = 1
    residual: float | None = None

    @property
    def states(self) -> Sequence[Hashable]:
        """The states of the chain."""
        return self.chain.states

    @property
    def is_cesaro(self) -> bool:
        """Whether this is a long-run average only, because M^n v itself has no limit."""
        return self.period > 1

    def __getitem__(self, state: Hashable) -> float:
        return float(self.probability[self.chain.index(state)])

    def to_dict(self) -> dict[Hashable, float]:
        """Return the probability of each state."""
        return dict(zip(self.states, self.probability.tolist(), strict=True))


def stationary_laws(chain: Chain, classes: NDArray[np.bool_] | None = None) -> NDArray[np.float64]:
    """Return the stationary law of each closed class, side by side; shape (n,).

    Each entry is conditional on being in the closed class of its state: the entries of a
    class sum to 1. Transient states have 0.

    Parameters
    ----------
    chain
        the chain.
    classes
        shape (classes,): which classes are wanted; the others have 0. All if not given.

    Raises
    ------
    AccuracyError
        if a law cannot be vouched for: it spans more decades than floats do, and its class
        is too large for wider numbers, or its class is too large and too slow to mix.
    """
    return _stationary(chain, chain.structure.closed if classes is None else classes)[0]


def _stationary(
    chain: Chain, classes: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], float | None]:
    """Return the laws of the closed ones of `classes`, and the residual of the solve if any.

    One state of each class is cut out; the visits to the others between two visits to it
    are proportional to the law.
    """
    structure = chain.structure
    wanted = classes & structure.closed
    law = np.zeros(len(chain))
    cut = structure.order[structure.offsets[:-1][wanted]]
    law[cut] = 1.0
    inside = wanted[structure.label]
    rest = inside.copy()
    rest[cut] = False
    residual = None
    if rest.any():
        states = np.flatnonzero(rest)
        part = TransientPart(chain.arcs, states)
        x, doubtful = part.attempt((chain.arcs.matrix() @ law)[states, None])
        law[states] = x[:, 0]
        residual = part.residual
        for label in np.unique(structure.label[states[doubtful[:, 0]]]):
            members = structure.members(label)
            law[members] = _law_of(chain.arcs.among(members)[0])
    # The largest of a class is 1 before the sum, which might overflow.
    top = np.zeros(structure.count)
    np.maximum.at(top, structure.label[inside], law[inside])
    law[inside] /= top[structure.label[inside]]
    total = np.bincount(structure.label[inside], law[inside], structure.count)
    law[inside] /= total[structure.label[inside]]
    return law, residual


def _law_of(arcs: Arcs) -> NDArray[np.float64]:
    """Return the law of a closed class that spans more decades than floats do."""
    T = arcs.matrix()
    order = path_order(T)
    if order is None:
        return wide_law(arcs)
    line = csc_array(T[:, order])[order]
    law = np.empty(arcs.size)
    law[order] = line_law(line.diagonal(-1), line.diagonal(1))
    return law


def _arrivals(chain: Chain, v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the probability to enter the recurrent states at each one; shape (n,)."""
    if chain.structure.is_acyclic:
        return _ends(chain, v)
    states = chain.transient.states
    arrivals = v.copy()
    arrivals[states] = 0.0
    if len(states) and v[states].any():
        visits = np.zeros(len(chain))
        visits[states] = chain.transient.visits(v[states])
        flow = chain.arcs.matrix() @ visits
        flow[states] = 0.0
        arrivals += flow
    return arrivals


def _ends(chain: Chain, v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the probability of each end of a chain without cycles, in one substitution."""
    end = chain.structure.recurrent
    outflow = np.where(end, 1.0, chain.arcs.outflow)
    flow = Factorisation(chain.arcs, end.astype(float), outflow, chain.structure)
    # Visits to other states may overflow or underflow; the flow into the ends does not.
    with np.errstate(all="ignore"):
        return np.where(end, flow.visits(v[:, None])[:, 0], 0.0)


def absorption(chain: Chain, start: Any = None) -> NDArray[np.float64]:
    """Return the probability of ending in each class, given the start; shape (classes,).

    It is 0 for classes that are not closed.
    """
    structure = chain.structure
    v = chain.density(start)
    arrivals = _arrivals(chain, v)
    # Rounding adds up in one direction along a very long way; what is lost is known.
    arrivals *= v.sum() / arrivals.sum()
    return np.bincount(structure.label, arrivals, structure.count).astype(np.float64, copy=False)


def expected_visits(chain: Chain, start: Any = None) -> NDArray[np.float64]:
    """Return the expected number of steps begun in each state, given the start; shape (n,).

    Transient states have a finite number; recurrent ones have inf where they are ever
    reached, and 0 elsewhere.
    """
    v = chain.density(start)
    states = chain.transient.states
    visits = np.zeros(len(chain))
    visits[states] = chain.transient.visits(v[states])
    reached = absorption(chain, v) > 0.0
    visits[reached[chain.structure.label]] = np.inf
    return visits


def stochastic_limit(chain: Chain, start: Any = None) -> Limit:
    """Return the stochastic limit of the chain, given the start."""
    at = chain.start_index(start)
    if at is not None and chain.line is not None:
        probability, period = chain.line.limit(at)
        return Limit(chain, probability, period)
    structure = chain.structure
    if structure.is_acyclic:
        return Limit(chain, _ends(chain, chain.density(start)))
    mass = absorption(chain, start)
    law, residual = _stationary(chain, mass > 0.0)
    law *= mass[structure.label]
    period = math.lcm(*structure.periods[mass > 0.0].tolist())
    return Limit(chain, law, period, _largest(_residual(chain), residual))


def _residual(chain: Chain) -> float | None:
    return chain.transient.residual if "transient" in chain.__dict__ else None


def _largest(*residuals: float | None) -> float | None:
    return max((r for r in residuals if r is not None), default=None)


def limit_matrix(chain: Chain) -> csc_array:
    """Return the limits from all states; shape (n, n), column j is the limit from state j."""
    n = len(chain)
    structure = chain.structure
    recurrent = structure.recurrent
    law = stationary_laws(chain)
    # spread[i, c] is the stationary law of class c; ends[c, j] the chance to end there.
    inside = np.flatnonzero(recurrent)
    spread = csc_array((law[inside], (inside, structure.label[inside])), shape=(n, structure.count))
    ends = csc_array(
        (np.ones(len(inside)), (structure.label[inside], inside)), shape=(structure.count, n)
    )
    part = chain.transient
    if len(part.states):
        closed = np.flatnonzero(structure.closed)
        onward = (ends @ chain.arcs.matrix())[closed][:, part.states]
        chances = part.values(onward.T.toarray())
        row, column = np.nonzero(chances)
        ends = ends + csc_array(
            (chances[row, column], (closed[column], part.states[row])), shape=ends.shape
        )
    return csc_array(spread @ ends)
