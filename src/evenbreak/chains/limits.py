"""The stochastic limit: where a chain ends, or its long-run average.

The limit is the projection of the starting vector v on the eigenspace of M for eigenvalue 1,

    limit = sum over closed classes C of a_C pi_C,

with a_C the probability of ending in C from v and pi_C the stationary distribution of C. If every
closed class that can be reached has period 1, it is lim M^n v; otherwise M^n v cycles forever, and
the limit is the long-run average (the Cesàro limit).

`limit_of` goes from a game to its limit in one call:

    kernel          game -> states in a line -> closed form
    elimination     game -> sparse matrix -> elimination without subtraction
    eigen           game -> networkx.DiGraph -> sparse matrix -> eigenvectors of eigenvalue 1

Every game function that has its own faster kernel is tested against this.

References: Kemeny and Snell 1960, Finite Markov Chains, chapters III to V; O'Cinneide 1993
for the accuracy, entry by entry.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import DTypeLike
from scipy.sparse import csc_array

from evenbreak.arrays import Floats, own_arrays
from evenbreak.chains.absorption import closed_classes_reached, ends_of, masses_of
from evenbreak.chains.arcs import Places, summed
from evenbreak.chains.chain import Chain, check_chain, labels
from evenbreak.chains.exact import exact_limit
from evenbreak.chains.explore import chain_of
from evenbreak.chains.stationary import laws_of, stationary_laws
from evenbreak.chains.ways import WAYS, Way, way_of_limit
from evenbreak.checks import one_of
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.game import Game, graph_of

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

_ERROR_BY_EIGENVECTORS = 1e-12

_SHOWN = 5
_COLUMNS = 64
"""Number of closed classes that are solved for at once."""
MOST_ENTRIES = 50_000_000
"""Limit on the entries in a matrix of limits; they take 12 bytes each, and more temporarily."""


@own_arrays
@dataclass(frozen=True, eq=False)
class Limit(Mapping[Hashable, float]):
    """Stochastic limit: a mapping from each state to its probability, given the start.

    Parameters
    ----------
    probability
        shape (n,): the limit of each state, given the start.
    period
        the least common multiple of the periods of the closed classes reached.
    bound
        a proved error bound. After solves whose residual was measured (see `stochastic_limit`), it
        bounds the relative error of each number of visits; sums and quotients of these add a few
        roundings. By eigenvectors, it bounds the sum of the absolute errors. None after elimination
        without subtraction.

    >>> from evenbreak.chains import chain_of
    >>> limit = stochastic_limit(chain_of([("rack", "won", 0.6), ("rack", "lost", 0.4)]), "rack")
    >>> limit["won"]
    0.6
    >>> limit
    <Limit over 3 states, period=1: 'won': 0.6, 'lost': 0.4, 'rack': 0>
    """

    chain: Chain
    probability: Floats
    period: int = 1
    bound: float | None = None

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
        proved = "" if self.bound is None else f", bound={self.bound:.3g}"
        return (
            f"<Limit over {len(self)} state{'s' * (len(self) != 1)}, period={self.period}{proved}: "
            f"{', '.join(shown)}{more}>"
        )

    def to_dict(self) -> dict[Hashable, float]:
        """Return the probability of each state."""
        return dict(zip(self.states, self.probability.tolist(), strict=True))

    def to_series(self) -> pd.Series[float]:
        """Return the probability of each state as a Series.

        >>> from evenbreak.chains import chain_of
        >>> stochastic_limit(chain_of({"rack": {"won": 0.75, "lost": 0.25}}), "rack").to_series()
        state
        rack    0.00
        won     0.75
        lost    0.25
        Name: probability, dtype: float64
        """
        import pandas as pd

        index = labels(self.states, "state")
        return pd.Series(self.probability, index=index, name="probability", copy=True)

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> Floats:
        """Return the probabilities in the order of the states, for use by numpy."""
        if copy is False:
            return np.asarray(self.probability, dtype)
        return np.array(self.probability, dtype)


def stochastic_limit(
    chain: Chain, start: Any = None, *, via: Way | None = None, exact: bool = False
) -> Limit | Any:
    """Return the stochastic limit of the chain: where it ends, or its long-run average.

    Each probability is conditional only on the start. The structure of the graph shows whether M^n
    v converges to this limit or cycles around it with a period (see `Limit.is_cesaro`).

    Parameters
    ----------
    start
        a state, a probability vector (see `Chain.density`), or None for the chain's own start.
    via
        'kernel': the closed form for states in a line, from a state. 'elimination': elimination of
        states without subtraction, for any chain. 'eigen': the eigenvectors of eigenvalue 1 (see
        `spectrum`). None: the kernel if there is one, otherwise elimination.
    exact
        whether to calculate in fractions and return a dict of them, by state. A chance that was
        given to `chain_of` as a `Fraction` or a string is used unchanged; a float is used as the
        decimal that it prints. Matches, series and one-ball games keep a `Fraction`; drills and
        ladders hold floats. Time and the length of the fractions grow with the number of states: a
        thousand states take a second or two, and so do some thousands of scores of a race.

    Raises
    ------
    AccuracyError
        if the limit cannot be guaranteed: it spans more decades than floats do in a class too
        large for decimal numbers, or a class is too large and mixes too slowly. By
        eigenvectors, if the sum of the absolute errors may be above 1e-12. With `exact`, if more
        than 1000 states have many arcs among them.
    ChainError
        if the start is neither a state nor a probability vector, or the chain has no kernel; with
        `exact`, if the arcs of a state do not sum to exactly 1.
    InputError
        if `via` is unknown, or given together with `exact`.

    Notes
    -----
    No matter how stiff the chain is, each entry is accurate to a few units in the last place times
    the length of the path to it (seen: 2e-14 over a line of 20,000 states, 4e-15 over 5,000 states
    with arcs at random). In classes of more than some hundreds of states the residual proves a
    bound on the relative error of every number of visits. This is the limit's `bound`, a few times
    1e-16. If it would be above 1e-14, states are eliminated instead.

    Time and memory are about linear in the number of arcs for any graph, except when a large class
    is left so rarely that nothing can be proved; see `factorization`. Reference: O'Cinneide 1993.

    >>> from evenbreak.chains import chain_of
    >>> miss_forever = chain_of([("S1", "S2", 1.0), ("S2", "S1", 1.0)])
    >>> limit = stochastic_limit(miss_forever, "S1")
    >>> limit.to_dict(), limit.period, limit.is_cesaro
    ({'S1': 0.5, 'S2': 0.5}, 2, True)
    >>> third = chain_of([("rack", "won", "1/3"), ("rack", "lost", "2/3")])
    >>> stochastic_limit(third, "rack", exact=True)["won"]
    Fraction(1, 3)
    """
    check_chain(chain)
    way_of_limit(via, exact=exact)  # refuses what is no way
    if exact:
        return exact_limit(chain, start)
    if via == "eigen":
        return _limit_by_eigenvectors(chain, start)
    at = chain.start_index(start) if via != "elimination" else None
    if at is not None and chain.birth_death is not None:
        probability, period = chain.birth_death.limit(at)
        return Limit(chain, probability, period)
    if via == "kernel":
        return _limit_in_line(chain, at)
    structure = chain.structure
    if structure.is_acyclic:
        return Limit(chain, ends_of(chain, chain.density(start)))
    if structure.count == 1:
        if at is None:
            chain.density(start)  # refuses what is no start
        law, bound = laws_of(chain, structure.closed)
        return Limit(chain, law, int(structure.periods[0]), bound)
    mass = masses_of(chain, start)
    law, bound = laws_of(chain, mass > 0.0)
    law *= mass[structure.label]
    period = _period_reached(chain, start)
    if "transient" in chain.__dict__:
        bounds = [part for part in (chain.transient.bound, bound) if part is not None]
        bound = sum(bounds) if bounds else None
    return Limit(chain, law, period, bound)


def limit_of(
    game: Game | nx.DiGraph[Any], *, start: Hashable | None = None, via: Way | None = None
) -> Limit:
    """Return the stochastic limit of a game: where it ends, or its long-run average.

    Parameters
    ----------
    game
        see `evenbreak.game`, or a `networkx.DiGraph` as `chain_of` takes it.
    start
        None: the game's own start.
    via
        as in `stochastic_limit`. With 'eigen' the game becomes a `networkx.DiGraph` first. None:
        the closed form if there is one, otherwise elimination.

    Raises
    ------
    AccuracyError, ChainError, InputError
        as `stochastic_limit` does; each message names a method that works.
    GameError
        as `chain_of` does.

    Notes
    -----
    The matrix of a race is defective: it has fewer independent eigenvectors than states. There are
    always enough for eigenvalue 1, and the limit needs only these.

    >>> from evenbreak.games import OneBall, Rack, Race
    >>> [round(limit_of(OneBall(0.4, 0.8), via=via)["W"], 12) for via in ("elimination", "eigen")]
    [0.454545454545, 0.454545454545]
    >>> limit_of(Race(2, 1, Rack(0.5)), via="eigen")[2, 0]
    0.25
    """
    if via is not None:
        one_of(via, "via", WAYS)
    if via == "eigen" and isinstance(game, Game):
        start = game.start if start is None else start
        game = graph_of(game, start=start)
    return stochastic_limit(chain_of(game, start=start), via=via)


def limit_matrix(chain: Chain) -> csc_array:
    """Return the limits from all states; shape (n, n), column j is the limit from state j.

    For states in a line, with absorbing states at its ends, there is a closed form. Otherwise, time
    and memory are those of one solve per closed class that is entered from outside, plus the
    nonzero entries. The accuracy is that of `stochastic_limit`.

    Raises
    ------
    AccuracyError
        if an entry cannot be guaranteed.
    InputError
        if more than 50 million entries are not 0, as in a closed class of 7,000 states.

    >>> from evenbreak.chains import chain_of
    >>> chain = chain_of([(1, 0, 0.5), (1, 2, 0.5), (2, 1, 0.25), (2, 3, 0.75)])
    >>> chain.states, limit_matrix(chain).toarray()[[1, 3]]
    ([1, 0, 2, 3], array([[0.57142857, 1.        , 0.14285714, 0.        ],
                          [0.42857143, 0.        , 0.85714286, 1.        ]]))
    """
    check_chain(chain)
    limits = None if chain.birth_death is None else chain.birth_death.limits()
    if limits is not None:
        return limits
    n, structure = len(chain), chain.structure
    law = stationary_laws(chain)
    inside = np.flatnonzero(structure.recurrent)
    home = structure.label[inside]
    spread = csc_array((law[inside], (inside, home)), shape=(n, structure.count))
    ends = _ends_from_all(chain, inside, home)
    sizes, starts = np.diff(spread.indptr), np.diff(ends.tocsr().indptr)
    entries = int(sizes.astype(np.int64) @ starts.astype(np.int64))
    if entries > MOST_ENTRIES:
        raise InputError(
            f"the limits from all {n:,} states have {entries:,} nonzero entries; at most "
            f"{MOST_ENTRIES:,} are allowed. Use stochastic_limit for the states you want to start "
            "from."
        )
    return csc_array(spread @ ends)


def _ends_from_all(chain: Chain, inside: Places, home: Places) -> csc_array:
    """Return the chance of ending in each class, from each state; shape (classes, n)."""
    arcs, structure, part = chain.arcs, chain.structure, chain.transient
    shape = structure.count, len(chain)
    ends = csc_array((np.ones(len(inside)), (home, inside)), shape=shape)
    entering = structure.recurrent[arcs.targets] & ~structure.recurrent[arcs.sources]
    into = structure.label[arcs.targets[entering]]
    entries = summed(into, arcs.sources[entering], arcs.chances[entering], shape)
    entered = np.unique(into)
    for first in range(0, len(entered), _COLUMNS):
        classes = entered[first : first + _COLUMNS]
        chances = part.values(entries[classes].toarray().T[part.states])
        row, column = np.nonzero(chances)
        values = chances[row, column]
        ends = ends + csc_array((values, (classes[column], part.states[row])), shape=shape)
    return ends


def _limit_in_line(chain: Chain, at: int | None) -> Limit:
    """Return the limit from the state `at`, regardless of the order in which the line is given."""
    if chain.line is None or at is None:
        raise ChainError(
            "there's no closed form for this chain and start: either the chain's states don't "
            "form a line, or the start is a probability vector. Use elimination."
        )
    order, walk = chain.line
    probability = np.empty(len(chain))
    probability[order], period = walk.limit(int(np.flatnonzero(order == at)[0]))
    return Limit(chain, probability, period)


def _limit_by_eigenvectors(chain: Chain, start: Any) -> Limit:
    """Return the limit as the sum of R_i (L_i v) over the eigenvalues 1."""
    from evenbreak.chains.eigenpairs import UnitPairs

    limit, error = UnitPairs(chain).limit(chain.density(start))
    if not error <= _ERROR_BY_EIGENVECTORS:
        raise AccuracyError(
            f"the limit from eigenvectors may be wrong by {error:.1e}, which is above "
            f"{_ERROR_BY_EIGENVECTORS:g}, because other eigenvalues are too close to 1. Use "
            "elimination, which loses no digits in that case."
        )
    return Limit(chain, limit, _period_reached(chain, start), error)


def _period_reached(chain: Chain, start: Any) -> int:
    """Return the least common multiple of the periods of the closed classes reached."""
    reached = closed_classes_reached(chain, chain.density(start))
    return math.lcm(*chain.structure.periods[reached].tolist())
