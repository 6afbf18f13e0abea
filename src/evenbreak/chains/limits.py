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

from evenbreak.chains.transient import TransientPart

if TYPE_CHECKING:
    from numpy.typing import NDArray

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


def stationary_laws(chain: Chain) -> NDArray[np.float64]:
    """Return the stationary law of each closed class, side by side; shape (n,).

    Each entry is conditional on being in the closed class of its state: the entries of a
    class sum to 1. Transient states have 0.
    """
    structure = chain.structure
    law = np.zeros(len(chain))
    cut = structure.order[structure.offsets[:-1][structure.closed]]
    law[cut] = 1.0
    rest = structure.recurrent.copy()
    rest[cut] = False
    others = np.flatnonzero(rest)
    if len(others):
        inflow = chain.arcs.matrix() @ law
        part = TransientPart(chain.arcs, others)
        law[others] = part.visits(inflow[others])
    total = np.bincount(structure.label, law, structure.count)
    return np.divide(law, total[structure.label], out=law, where=structure.recurrent)


def _arrivals(chain: Chain, v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the probability to enter the recurrent states at each one; shape (n,)."""
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


def absorption(chain: Chain, start: Any = None) -> NDArray[np.float64]:
    """Return the probability of ending in each class, given the start; shape (classes,).

    It is 0 for classes that are not closed.
    """
    structure = chain.structure
    arrivals = _arrivals(chain, chain.density(start))
    return np.bincount(structure.label, arrivals, structure.count)


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
    mass = absorption(chain, start)
    law = stationary_laws(chain) * mass[structure.label]
    period = math.lcm(*structure.periods[mass > 0.0].tolist())
    return Limit(chain, law, period)


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
