"""The stochastic limit: where a chain ends, or what it does in the long run.

The limit is the projection of the start density v on the eigenspace of M for eigenvalue 1,

    limit = sum over closed classes C of a_C pi_C,

with a_C the probability of ending in C from v and pi_C the stationary law of C. If every
closed class that can be reached has period 1, it is lim M^n v; otherwise M^n v goes round
for ever, and it is the long-run average (the Cesàro limit).

References: Kemeny and Snell 1960, Finite Markov Chains, chapters III to V; O'Cinneide 1993
for the accuracy, entry by entry.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar, overload

import numpy as np
from scipy.sparse import csc_array, csr_array

from evenbreak.chains.absorption import absorption, closed_classes_reached, ends_of
from evenbreak.chains.stationary import laws_of, stationary_laws
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Places
    from evenbreak.chains.chain import Chain

Default = TypeVar("Default")

_COLUMNS = 64
_SHOWN = 5


@dataclass(frozen=True, eq=False)
class Limit(Mapping[Hashable, float]):
    """A stochastic limit: a mapping from each state to its probability, given the start.

    Parameters
    ----------
    chain
        the chain.
    probability
        shape (n,): the limit of each state, given the start.
    period
        the least common multiple of the periods of the closed classes reached.
    residual
        None if each entry is right to about machine precision (see `stochastic_limit`);
        otherwise the most by which an equation of a large class is missed, in units of the
        largest entry of the right-hand side.

    >>> from evenbreak.chains import chain_of
    >>> limit = stochastic_limit(chain_of([("rack", "won", 0.6), ("rack", "lost", 0.4)]), "rack")
    >>> limit["won"]
    0.6
    >>> limit
    <Limit over 3 states, period=1: 'won': 0.6, 'lost': 0.4, 'rack': 0>
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
        """Whether this is only a long-run average, because M^n v itself has no limit."""
        return self.period > 1

    def __getitem__(self, state: Hashable) -> float:
        return float(self.probability[self.chain.index(state)])

    def __iter__(self) -> Iterator[Hashable]:
        return iter(self.states)

    def __len__(self) -> int:
        return len(self.chain)

    def __contains__(self, state: object) -> bool:
        return isinstance(state, Hashable) and state in self.chain.position

    @overload
    def get(self, state: Hashable, default: None = None) -> float | None: ...

    @overload
    def get(self, state: Hashable, default: Default) -> float | Default: ...

    def get(self, state: Hashable, default: Any = None) -> Any:
        """Return the probability of a state, or `default` if the chain has no such state."""
        try:
            return self[state]
        except ChainError:
            return default

    def __repr__(self) -> str:
        likeliest = np.argsort(-self.probability, kind="stable")[:_SHOWN].tolist()
        shown = [f"{self.states[i]!r}: {self.probability[i]:.6g}" for i in likeliest]
        more = ", ..." if len(self) > _SHOWN else ""
        missed = "" if self.residual is None else f", residual={self.residual:.3g}"
        return (
            f"<Limit over {len(self)} state{'s' * (len(self) != 1)}, period={self.period}{missed}: "
            f"{', '.join(shown)}{more}>"
        )

    def to_dict(self) -> dict[Hashable, float]:
        """Return the probability of each state."""
        return dict(zip(self.states, self.probability.tolist(), strict=True))


def stochastic_limit(chain: Chain, start: Any = None) -> Limit:
    """Return the stochastic limit of the chain: where it ends, or its long-run average.

    Each probability is conditional on the start alone. The structure of the graph says
    whether M^n v has this limit or goes round it with a period (see `Limit.is_cesaro`).

    Parameters
    ----------
    chain
        the chain.
    start
        a state, a density (see `Chain.density`), or None for the chain's own start.

    Raises
    ------
    AccuracyError
        if the limit cannot be guaranteed: it spans more decades than floats do in a class too
        large for decimal numbers, or a class is too large and mixes too slowly.
    ChainError
        if the start is neither a state nor a density.

    Notes
    -----
    However stiff the chain, each entry is right to a few units in the last place times the
    length of the path to it (seen: 2e-14 over a line of 20,000 states, 3e-13 over 5,000
    states with equal arcs in a wider band). The exceptions are classes of more than some
    6,000 states without a narrow band: there a sparse factorisation is certified, and if
    the certificate is worse than 1e-12 the limit carries its `residual`.

    Time and memory are linear in the number of arcs if the classes are single states, lines
    or at most 64 states; see `factorisation` for the others. Reference: O'Cinneide 1993.

    >>> from evenbreak.chains import chain_of
    >>> miss_forever = chain_of([("S1", "S2", 1.0), ("S2", "S1", 1.0)])
    >>> limit = stochastic_limit(miss_forever, "S1")
    >>> limit.to_dict(), limit.period, limit.is_cesaro
    ({'S1': 0.5, 'S2': 0.5}, 2, True)
    """
    at = chain.start_index(start)
    if at is not None and chain.birth_death is not None:
        probability, period = chain.birth_death.limit(at)
        return Limit(chain, probability, period)
    structure = chain.structure
    if structure.is_acyclic:
        return Limit(chain, ends_of(chain, chain.density(start)))
    mass = absorption(chain, start)
    law, residual = laws_of(chain, mass > 0.0)
    law *= mass[structure.label]
    reached = closed_classes_reached(chain, chain.density(start))
    period = math.lcm(*structure.periods[reached].tolist())
    if "transient" in chain.__dict__:
        residual = largest(chain.transient.residual, residual)
    return Limit(chain, law, period, residual)


def largest(*residuals: float | None) -> float | None:
    """Return the largest of the residuals that are not None, or None."""
    return max((r for r in residuals if r is not None), default=None)


def limit_matrix(chain: Chain) -> csc_array:
    """Return the limits from all states; shape (n, n), column j is the limit from state j.

    Time and memory are those of one solve for each closed class that is entered from
    outside, and of the entries that are not 0. The accuracy is that of `stochastic_limit`.
    Where only a sparse factorisation helps, the residual of the chances of ending in a class
    is in `chain.transient.residual` afterwards; that of the law of a closed class is in
    `stochastic_limit(chain, state).residual` for a state of the class.

    Raises
    ------
    AccuracyError
        if an entry cannot be guaranteed.

    >>> from evenbreak.chains import chain_of
    >>> chain = chain_of([(1, 0, 0.5), (1, 2, 0.5), (2, 1, 0.25), (2, 3, 0.75)])
    >>> chain.states, limit_matrix(chain).toarray()[[1, 3]]
    ([1, 0, 2, 3], array([[0.57142857, 1.        , 0.14285714, 0.        ],
                          [0.42857143, 0.        , 0.85714286, 1.        ]]))
    """
    n, structure = len(chain), chain.structure
    law = stationary_laws(chain)
    inside = np.flatnonzero(structure.recurrent)
    home = structure.label[inside]
    spread = csc_array((law[inside], (inside, home)), shape=(n, structure.count))
    return csc_array(spread @ _ends_from_all(chain, inside, home))


def _ends_from_all(chain: Chain, inside: Places, home: Places) -> csc_array:
    """Return the chance of ending in each class, from each state; shape (classes, n)."""
    shape = chain.structure.count, len(chain)
    ends = csc_array((np.ones(len(inside)), (home, inside)), shape=shape)
    part = chain.transient
    entries = csr_array((ends @ chain.arcs.matrix())[:, part.states])
    entered = np.flatnonzero(chain.structure.closed & (np.diff(entries.indptr) > 0))
    for first in range(0, len(entered), _COLUMNS):
        classes = entered[first : first + _COLUMNS]
        chances = part.values(entries[classes].toarray().T)
        row, column = np.nonzero(chances)
        values = chances[row, column]
        ends = ends + csc_array((values, (classes[column], part.states[row])), shape=shape)
    return ends
