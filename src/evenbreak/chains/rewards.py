"""Rewards of a chain: per step in the long run, and in total until absorption.

With r_j the expected reward of a step started in j (of the state itself and of the arc then
taken), pi the stochastic limit and x the expected visits to the transient states,

    per step in the long run: sum_j pi_j r_j,    until absorption: sum_j x_j r_j.

Neither pi nor x is computed by subtraction, so rewards with the same sign lose no digits.

Reference: Kemeny and Snell 1960, Finite Markov Chains, chapters III and IV.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats
from evenbreak.chains.chain import Chain, by_label, check_chain
from evenbreak.chains.limits import stochastic_limit
from evenbreak.errors import ChainError


def long_run_reward(
    chain: Chain,
    start: Any = None,
    *,
    per_state: Mapping[Any, float] | NDArray[Any] | None = None,
    per_arc: Mapping[tuple[Hashable, Hashable], float] | None = None,
) -> float:
    """Return the expected reward per step in the long run, given the start.

    For a periodic chain this is the average over a period; if several classes are closed, it is the
    mean over the classes in which play may end.

    Parameters
    ----------
    chain, start
        as in `stochastic_limit`.
    per_state
        the reward of each step started in a state: a mapping or a pandas Series (0 for states
        not named), or an array of shape (n,).
    per_arc
        the reward of each step from source to target, by (source, target); 0 for arcs
        not named. It is added to `per_state`.

    Raises
    ------
    ChainError
        if there is no reward, a state or arc is unknown, a reward is not a finite number, or the
        start is neither a state nor a probability vector.
    AccuracyError
        if the limit cannot be guaranteed.

    Notes
    -----
    Source: P5.25. The text multiplies rounded chances and prints 0.49 for this example.

    >>> from evenbreak.chains import chain_of
    >>> winner_breaks = chain_of([(1, 1, 0.9), (1, 2, 0.1), (2, 1, 0.5), (2, 2, 0.5)])
    >>> stakes = {(1, 1): 1, (1, 2): -2, (2, 1): 1, (2, 2): -2}
    >>> round(long_run_reward(winner_breaks, 1, per_arc=stakes), 12)
    0.5
    """
    check_chain(chain)
    reward = _expected_reward(chain, per_state, per_arc)
    return math.fsum(stochastic_limit(chain, start).probability * reward)


def total_reward(
    chain: Chain,
    start: Any = None,
    *,
    per_state: Mapping[Any, float] | NDArray[Any] | None = None,
    per_arc: Mapping[tuple[Hashable, Hashable], float] | None = None,
) -> float:
    """Return the expected total reward until absorption, given the start.

    All steps count, up to and including the step that enters a closed class. Rewards inside the
    class do not count (see `long_run_reward`), so the total is always finite.

    Parameters
    ----------
    chain, start, per_state, per_arc
        as in `long_run_reward`.

    Raises
    ------
    ChainError
        as `long_run_reward`.
    AccuracyError
        if the expected visits are larger than any float, or cannot be guaranteed.

    Notes
    -----
    Source: Kemeny & Snell, Finite Markov Chains, chapter III.

    >>> from evenbreak.chains import chain_of
    >>> toss = chain_of([("go", "go", 0.75), ("go", "end", 0.25)])
    >>> total_reward(toss, "go", per_state={"go": -1}, per_arc={("go", "end"): 10})
    6.0
    """
    check_chain(chain)
    reward = _expected_reward(chain, per_state, per_arc)
    v = chain.density(start)
    states = chain.transient.states
    return math.fsum(chain.transient.visits(v[states]) * reward[states])


def _expected_reward(
    chain: Chain,
    per_state: Mapping[Any, float] | NDArray[Any] | None,
    per_arc: Mapping[tuple[Hashable, Hashable], float] | None,
) -> Floats:
    """Return the expected reward of a step from each state; shape (n,)."""
    if per_state is None and per_arc is None:
        raise ChainError("no reward was given. Give per_state or per_arc.")
    per_state = {} if per_state is None else by_label(per_state, "per_state")
    if not isinstance(per_state, Mapping):
        per_state = np.asarray(per_state, dtype=float)
    reward = chain.vector(per_state, "per_state")
    for (source, target), amount in (per_arc or {}).items():
        j, i = chain.index(source), chain.index(target)
        chance = float(chain.matrix[i, j])
        if chance == 0.0:
            raise ChainError(f"there's no arc {source!r} -> {target!r} to earn a reward on")
        reward[j] += chance * amount
    if not np.isfinite(reward).all():
        raise ChainError("every reward must be finite; one arc's reward isn't")
    return reward
