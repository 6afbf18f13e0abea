"""Where a chain is absorbed, and how often it visits each state before.

With T the arcs among the transient states and v the start density, x = (I - T)^-1 v are the
expected visits to them, and the recurrent states are entered with the probabilities

    v + M x,

summed over each closed class. A chain without cycles needs one substitution only.

Reference: Kemeny and Snell 1960, Finite Markov Chains, chapter III.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from evenbreak.chains.arcs import reachable, sums
from evenbreak.chains.chain import check_chain
from evenbreak.chains.exact import exact_absorption
from evenbreak.chains.factorisation import Factorisation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.chain import Chain


@overload
def absorption(
    chain: Chain, start: Any = None, *, exact: Literal[False] = False
) -> NDArray[np.float64]: ...


@overload
def absorption(chain: Chain, start: Any = None, *, exact: bool) -> NDArray[Any]: ...


def absorption(chain: Chain, start: Any = None, *, exact: bool = False) -> NDArray[Any]:
    """Return the probability of ending in each class, given the start; shape (classes,).

    Classes are numbered as in `chain.structure`; those that are not closed have 0. Each
    entry is right to about machine precision, unless play passes through a transient class
    too large for elimination (see `factorisation`). Then it is certified to a relative
    error of 1e-6 at least, and if that is all that can be said, `chain.transient.residual`
    is not None but says by how much the equations are missed.

    With `exact` the entries are fractions (see `stochastic_limit`).

    Raises
    ------
    AccuracyError
        if an entry cannot be guaranteed.
    ChainError
        with `exact`, if the arcs of a state do not sum to exactly 1.

    >>> from evenbreak.chains import chain_of
    >>> chain = chain_of([("play", "won", 0.25), ("play", "lost", 0.5), ("play", "play", 0.25)])
    >>> absorption(chain, "play")[chain.structure.label].round(3).tolist()
    [0.0, 0.333, 0.667]
    >>> absorption(chain, "play", exact=True)[1:].tolist()
    [Fraction(1, 3), Fraction(2, 3)]
    """
    check_chain(chain)
    if exact:
        return exact_absorption(chain, start)
    structure = chain.structure
    v = chain.density(start)
    arrivals = _arrivals(chain, v)
    # Along a very long path rounding adds up in one direction; the sum shows how much.
    arrivals *= v.sum() / arrivals.sum()
    return sums(structure.label, arrivals, structure.count)


def expected_visits(chain: Chain, start: Any = None) -> NDArray[np.float64]:
    """Return the expected number of steps begun in each state, given the start; shape (n,).

    Transient states have a finite number. Recurrent states have inf if they can be reached,
    otherwise 0. The accuracy is that of `absorption`, with the residual in
    `chain.transient.residual`.

    Raises
    ------
    AccuracyError
        if a number is larger than any float, or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of
    >>> expected_visits(chain_of([("miss", "miss", 0.75), ("miss", "in", 0.25)]), "miss")
    array([ 4., inf])
    """
    check_chain(chain)
    v = chain.density(start)
    states = chain.transient.states
    visits = np.zeros(len(chain))
    visits[states] = chain.transient.visits(v[states])
    visits[closed_classes_reached(chain, v)[chain.structure.label]] = np.inf
    return visits


def ends_of(chain: Chain, v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the probability of each end of a chain without cycles, by one substitution."""
    end = chain.structure.recurrent
    outflow = np.where(end, 1.0, chain.arcs.outflow)
    flow = Factorisation(chain.arcs, end.astype(float), outflow, chain.structure)
    # Visits to other states may overflow or underflow; the flow into the ends does not.
    with np.errstate(all="ignore"):
        return np.where(end, flow.visits(v[:, None])[:, 0], 0.0)


def closed_classes_reached(chain: Chain, v: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which closed classes can be reached, even with a chance smaller than any float."""
    arcs, structure = chain.arcs, chain.structure
    seen = reachable(len(chain), arcs.sources, arcs.targets, v > 0.0)
    reached = np.zeros(structure.count, dtype=bool)
    reached[structure.label[seen]] = True
    return reached & structure.closed


def _arrivals(chain: Chain, v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the probability that each recurrent state is the first one entered; shape (n,)."""
    if chain.structure.is_acyclic:
        return ends_of(chain, v)
    states = chain.transient.states
    arrivals = v.copy()
    arrivals[states] = 0.0
    if len(states) and v[states].any():
        arrivals += chain.transient.arrivals(v[states])
    return arrivals
