"""Where a chain is absorbed, and how often it visits each state before that.

If T holds the arcs among the transient states and v is the starting vector, then x = (I - T)^-1 v
are the expected visits to them, and the recurrent states are entered with the probabilities

    v + M x,

summed over each closed class. A chain without cycles needs only one substitution.

Reference: Kemeny and Snell 1960, Finite Markov Chains, chapter III.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.arrays import Bools, Floats
from evenbreak.chains.arcs import reachable, sums
from evenbreak.chains.chain import Chain, check_chain, labels
from evenbreak.chains.elimination import decimal_masses
from evenbreak.chains.exact import exact_absorption
from evenbreak.chains.factorization import Factorization

if TYPE_CHECKING:
    import pandas as pd


def absorption(chain: Chain, start: Any = None, *, exact: bool = False) -> pd.Series[Any]:
    """Return the probability of ending in each closed class, given the start, as a Series.

    The label of a class is its state if it has only one, otherwise the tuple of its states. Each
    entry is accurate to about machine precision (see `stochastic_limit`).

    With `exact`, the entries are fractions (see `stochastic_limit`).

    Raises
    ------
    AccuracyError
        if an entry cannot be guaranteed.
    ChainError
        with `exact`, if the arcs of a state do not sum to exactly 1.

    >>> from evenbreak.chains import chain_of
    >>> chain = chain_of([("play", "won", 0.25), ("play", "lost", 0.5), ("play", "play", 0.25)])
    >>> absorption(chain, "play").round(3)
    class
    won     0.333
    lost    0.667
    Name: probability, dtype: float64
    >>> absorption(chain, "play", exact=True)["won"]
    Fraction(1, 3)
    """
    import pandas as pd

    check_chain(chain)
    structure = chain.structure
    masses = exact_absorption(chain, start) if exact else masses_of(chain, start)
    closed = np.flatnonzero(structure.closed).tolist()
    names = []
    for label in closed:
        states = tuple(chain.states[i] for i in structure.members(label).tolist())
        names.append(states if len(states) > 1 else states[0])
    return pd.Series(masses[closed], index=labels(names, "class"), name="probability")


def expected_visits(chain: Chain, start: Any = None) -> pd.Series[float]:
    """Return the expected number of steps that start in each state, given the start, as a Series.

    For transient states, the number is finite. For recurrent states, it is inf if they can be
    reached, otherwise 0. The accuracy is that of `absorption`.

    Raises
    ------
    AccuracyError
        if a number is larger than any float, or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of
    >>> expected_visits(chain_of([("miss", "miss", 0.75), ("miss", "in", 0.25)]), "miss")
    state
    miss    4.0
    in      inf
    Name: visits, dtype: float64
    """
    import pandas as pd

    check_chain(chain)
    return pd.Series(visits_from(chain, start), index=labels(chain.states, "state"), name="visits")


def masses_of(chain: Chain, start: Any = None) -> Floats:
    """Return the probability of ending in each class, 0 for open classes; shape (classes,)."""
    v, arcs, structure = chain.density(start), chain.arcs, chain.structure
    if structure.is_acyclic:
        arrivals = ends_of(chain, v)
    elif v[~structure.recurrent].any():
        states = chain.transient.states
        x, doubtful = chain.transient.attempt(v[states, None])
        if doubtful.any():
            return decimal_masses(structure, v)
        visits = np.zeros(len(chain))
        visits[states] = x[:, 0]
        entered = structure.recurrent[arcs.targets]
        flow = arcs.chances[entered] * visits[arcs.sources[entered]]
        arrivals = np.where(structure.recurrent, v, 0.0)
        arrivals += sums(arcs.targets[entered], flow, len(chain))
    else:
        arrivals = v
    # Along a very long path rounding adds up in one direction; the sum shows how much.
    arrivals *= v.sum() / arrivals.sum()
    return sums(structure.label, arrivals, structure.count)


def visits_from(chain: Chain, start: Any = None) -> Floats:
    """Return the `expected_visits` to all states as an array."""
    v = chain.density(start)
    states = chain.transient.states
    visits = np.zeros(len(chain))
    visits[states] = chain.transient.visits(v[states])
    visits[closed_classes_reached(chain, v)[chain.structure.label]] = np.inf
    return visits


def ends_of(chain: Chain, v: Floats) -> Floats:
    """Return the probability of each end of a chain without cycles, by one substitution."""
    end = chain.structure.recurrent
    outflow = np.where(end, 1.0, chain.arcs.outflow)
    flow = Factorization(chain.arcs, end.astype(float), outflow, chain.structure)
    # Visits to other states may overflow or underflow; the flow into the ends does not.
    with np.errstate(all="ignore"):
        return np.where(end, flow.visits(v[:, None])[:, 0], 0.0)


def closed_classes_reached(chain: Chain, v: Floats) -> Bools:
    """Return which closed classes can be reached, even with a chance too small for a float."""
    arcs, structure = chain.arcs, chain.structure
    seen = reachable(len(chain), arcs.sources, arcs.targets, v > 0.0)
    reached = np.zeros(structure.count, dtype=bool)
    reached[structure.label[seen]] = True
    return reached & structure.closed
