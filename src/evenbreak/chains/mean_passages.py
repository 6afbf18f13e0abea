"""Mean first-passage times between all states, and Kemeny's constant.

The mean number of steps m_j from j to a target solves, over the states that are certain to
reach it,

    m_j = 1 + sum_i T[i, j] m_i,

one solve without subtraction for each target. In a chain with one closed class the mean to a
state drawn from the stationary law, sum_i law_i m_ij, is the same from every recurrent j:
Kemeny's constant.

Reference: Kemeny and Snell 1960, Finite Markov Chains, sections 4.4 and 4.5.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from evenbreak.chains.arcs import reachable
from evenbreak.chains.chain import check_chain
from evenbreak.chains.stationary import stationary_laws
from evenbreak.chains.transient import TransientPart
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.chain import Chain

MOST_STATES = 2000
"""Larger chains are refused: there is one solve for each state."""


def mean_first_passages(chain: Chain) -> NDArray[np.float64]:
    """Return the mean number of steps until each state is first visited, from each state.

    Entry [i, j] is the mean to state i from state j; shape (n, n). It is 0 for i = j, and inf
    where i may never be reached. For one target or the distribution see `first_passage`.

    Raises
    ------
    ChainError
        if the chain has more than 2000 states.
    AccuracyError
        if a mean is larger than any float, or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of
    >>> mean_first_passages(chain_of([(1, 0, 0.25), (1, 2, 0.75), (2, 1, 1.0)]))
    array([[ 0., inf,  1.],
           [ 7.,  0.,  8.],
           [inf, inf,  0.]])
    """
    check_chain(chain)
    n = len(chain)
    if n > MOST_STATES:
        raise ChainError(
            f"the chain has {n} states; give at most {MOST_STATES}, or use first_passage for each "
            "target that matters"
        )
    return np.stack([_means_to(chain, target) for target in range(n)])


def kemeny_constant(chain: Chain) -> float:
    """Return the mean number of steps to a state drawn from the stationary law.

    It does not depend on the recurrent state in which the chain begins, and counts 0 steps if
    that state itself is drawn. It is small where the chain soon visits all that matters.

    Raises
    ------
    ChainError
        if the chain has more than one closed class, or a closed class of more than 2000 states.
    AccuracyError
        if a mean is larger than any float, or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of
    >>> kemeny_constant(chain_of([(1, 2, 0.5), (1, 1, 0.5), (2, 1, 0.25), (2, 2, 0.75)]))
    1.3333333333333333
    """
    check_chain(chain)
    recurrent = np.flatnonzero(chain.structure.recurrent)
    if chain.structure.closed.sum() > 1:
        raise ChainError(
            f"the chain has {chain.structure.closed.sum()} closed classes; Kemeny's constant needs "
            "one, from which every stationary state can be reached"
        )
    if len(recurrent) > MOST_STATES:
        raise ChainError(
            f"the closed class has {len(recurrent)} states; give at most {MOST_STATES}"
        )
    law = stationary_laws(chain)
    start = recurrent[law[recurrent].argmax()]
    means = [_means_to(chain, target)[start] for target in recurrent.tolist()]
    return float((law[recurrent] * means).sum())


def _means_to(chain: Chain, target: int) -> NDArray[np.float64]:
    """Return the mean number of steps to one target from each state; shape (n,)."""
    n, arcs = len(chain), chain.arcs
    ends = np.arange(n) == target
    before = ~ends[arcs.sources]
    j, i = arcs.sources[before], arcs.targets[before]
    hopeless = ~reachable(n, i, j, ends)
    certain = ~reachable(n, i, j, hopeless)
    states = np.flatnonzero(certain & ~ends)
    means = np.where(ends, 0.0, np.inf)
    means[states] = TransientPart(arcs, states).values(np.ones(len(states)))
    return means
