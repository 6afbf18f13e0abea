"""A chain given that it reaches a target: Doob's h-transform.

With h_j the chance of reaching the target from j, the chain given that it does has

    P(i | j, target reached) = M[i, j] h_i / h_j.

Reference: Kemeny and Snell 1960, Finite Markov Chains, section 3.1, for absorbing chains.
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains.chain import check_chain
from evenbreak.chains.explore import chain_from_arrays
from evenbreak.chains.passage_times import approach, target_of
from evenbreak.errors import AccuracyError, ChainError

if TYPE_CHECKING:
    from evenbreak.chains.chain import Chain


def conditioned(chain: Chain, target: Any) -> Chain:
    """Return the chain given that it reaches the target, where it stops.

    It holds the states from which the target can be reached, with the chances of each step
    conditional on reaching the target sooner or later.

    Parameters
    ----------
    chain
        the chain; its start is kept.
    target
        a state, or a list or set of states.

    Raises
    ------
    ChainError
        if a state is unknown, no target is given, or the start cannot reach the target.
    AccuracyError
        if a chance of reaching the target is smaller than any float, or cannot be guaranteed.

    >>> from evenbreak.chains import chain_of, steps_to_absorption
    >>> race = chain_of({"0:0": {"1:0": 0.75, "0:1": 0.25}, "1:0": {"won": 0.75, "1:1": 0.25},
    ...                  "0:1": {"1:1": 0.75, "lost": 0.25}, "1:1": {"won": 0.75, "lost": 0.25}},
    ...                 start="0:0")
    >>> comeback = conditioned(race, "lost")
    >>> comeback.states
    ['0:0', '1:0', '0:1', '1:1', 'lost']
    >>> steps_to_absorption(race).mean, steps_to_absorption(comeback).mean
    (2.375, 2.6)
    """
    check_chain(chain)
    ends = target_of(chain, target)
    states, part, leak = approach(chain, ends, np.ones(len(chain), dtype=bool))
    h = ends.astype(np.float64)
    h[states] = part.values(leak)
    if not (h[states] > 0.0).all():
        raise AccuracyError("a chance of reaching the target is smaller than any float")
    if chain.start is not None and not h[chain.index(chain.start)]:
        raise ChainError(f"the target {target!r} cannot be reached from {chain.start!r}")
    kept = np.flatnonzero(h)
    place = np.full(len(chain), -1)
    place[kept] = np.arange(len(kept))
    arcs = chain.arcs
    inside = (h[arcs.sources] > 0.0) & ~ends[arcs.sources] & (h[arcs.targets] > 0.0)
    j, i, p = arcs.sources[inside], arcs.targets[inside], arcs.chances[inside]
    looped = states[chain.matrix.diagonal()[states] > 0.0]
    sources, targets = np.concatenate((j, looped)), np.concatenate((i, looped))
    chances = np.concatenate((p * (h[i] / h[j]), chain.matrix.diagonal()[looped]))
    names: list[Hashable] = [chain.states[k] for k in kept.tolist()]
    return chain_from_arrays(
        names, place[sources], place[targets], np.minimum(chances, 1.0), chain.start
    )
