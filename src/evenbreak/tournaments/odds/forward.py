"""The joint law of open slots, carried from match to match.

With m the chance of each state before a match and p the chance that slot 1's player wins
it in that state, the states after it have

    m'(s') = sum over s that lead to s' by a win of slot 1 of m(s) p(s)
           + sum over s that lead to s' by a win of slot 2 of m(s) (1 - p(s)).

Adding up m over the states in which two players meet gives the chance that they do; every
other answer follows from these chances.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from evenbreak.tournaments.odds.chances import Chances, Floats
from evenbreak.tournaments.odds.group_law import rank_laws, rank_states, result_law
from evenbreak.tournaments.odds.plan import (
    Branch,
    GroupStep,
    Index,
    MatchStep,
    Plan,
    adding_up,
)


@dataclass(frozen=True, eq=False)
class Flow:
    """What flowed through the steps of a plan; arrays have a last axis for draws, if any.

    Parameters
    ----------
    meet
        for each match of the plan, the chance of each pair of its step.
    first_wins
        for each match, slot 1's chance in each pair.
    ranks
        for each group, ranks[i, k] = P(member i has rank k, from 0 on).
    total
        the chance of the assumed results; 1 where there are none.
    after
        the chance of each state after each step, by its number, if it was asked for.
    """

    meet: Mapping[str, Floats]
    first_wins: Mapping[str, Floats]
    ranks: Mapping[str, Floats]
    total: Floats
    after: Mapping[int, Floats]


def flow(plan: Plan, chances: Chances, *, keep: bool = False) -> Flow:
    """Return the chances of all pairs in all matches of a plan.

    Parameters
    ----------
    plan
        the steps.
    chances
        the chances of the matches, for one draw or many.
    keep
        whether to keep the chance of each state after each step.
    """
    masses: dict[int, Floats] = {}
    meet: dict[str, Floats] = {}
    first_wins: dict[str, Floats] = {}
    ranks: dict[str, Floats] = {}
    after: dict[int, Floats] = {}
    total = np.ones(())
    for number, step in enumerate(plan.steps):
        if isinstance(step, GroupStep):
            masses[number], ranks[step.name] = group_law(step, chances)
        else:
            mass = joined([masses.pop(k) for k in step.joins])
            p = chances.of(step.name)[step.first, step.second]
            meet[step.name], first_wins[step.name] = _pairs(step, mass), p
            masses[number] = passed_on(step, mass, p)
        if keep:
            after[number] = masses[number]
        if not step.slots:
            total = total * masses.pop(number).sum(axis=0)
    return Flow(meet, first_wins, ranks, total, after)


def joined(parts: list[Floats]) -> Floats:
    """Return the joint law of independent parts, one or two of them."""
    if not parts:
        return np.ones(1)
    if len(parts) == 1:
        return parts[0]
    one, other = parts
    product = one[:, None] * other[None, :]
    return product.reshape(len(one) * len(other), *product.shape[2:])


def passed_on(step: MatchStep, mass: Floats, p: Floats) -> Floats:
    """Return the law of the states after a match."""
    won, lost = split(step, mass, p)
    return gathered(step, 0, won) + gathered(step, 1, lost)


def split(step: MatchStep, mass: Floats, p: Floats) -> tuple[Floats, Floats]:
    """Return the mass of each state in which slot 1's player wins, and in which slot 2's does."""
    of_state = p if step.pair is None else p[step.pair]
    won = mass[..., None] * of_state if of_state.ndim > mass.ndim else mass * of_state
    whole = mass[..., None] if of_state.ndim > mass.ndim else mass
    return won, whole - won


def gathered(step: MatchStep, side: int, mass: Floats) -> Floats:
    """Return the mass that arrives in each state after, from the branch of one side."""
    branch: Branch = step.branches[side]
    moved = mass if branch.rows is None else mass[branch.rows]
    if mass.ndim == 1:
        return np.bincount(branch.to, moved, step.size).astype(float, copy=False)
    arrived: Floats = step.scatter[side] @ moved
    return arrived


def _pairs(step: MatchStep, mass: Floats) -> Floats:
    if step.pair is None or step.meeting is None:
        return mass
    if mass.ndim == 1:
        return np.bincount(step.pair, mass, len(step.first)).astype(float, copy=False)
    met: Floats = step.meeting @ mass
    return met


def group_law(step: GroupStep, chances: Chances) -> tuple[Floats, Floats]:
    """Return the law of who goes on from a group, and who has which rank."""
    matches = zip(step.group.matches, step.group.pairs, strict=True)
    each = np.broadcast_arrays(*(chances.of(name)[pair] for name, pair in matches))
    results = result_law(each)
    members = len(step.group.members)
    laws = rank_laws(members, step.pairs)
    orders = summed(laws.order_of, results, len(laws.orders))
    _, shares = rank_states(members, step.pairs, step.ranks)
    ranks = np.zeros((members, members, *results.shape[1:]))
    for member in range(members):
        ahead = laws.orders[:, member]
        level = (laws.orders == ahead[:, None]).sum(axis=1)
        for lot in range(int(level.max())):
            there = level > lot
            share = orders[there] / level[there].reshape(-1, *[1] * (orders.ndim - 1))
            ranks[member] += summed(ahead[there] + lot, share, members)
    return shares @ orders, ranks


def summed(index: Index, mass: Floats, size: int) -> Floats:
    """Return the sums of the masses with the same index."""
    if mass.ndim == 1:
        return np.bincount(index, mass, size).astype(float, copy=False)
    sums: Floats = adding_up(index.astype(np.int32), size) @ mass
    return sums
