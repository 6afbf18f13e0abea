"""The forward pass: the joint distribution of open slots, from match to match.

With m(s) the probability of state s before a match and p(s) the chance that slot 1's player
wins it in that state, the probabilities after the match are

    m'(t) = sum of m(s) p(s) over the s that a win of slot 1 turns into t
          + sum of m(s) (1 - p(s)) over the s that a win of slot 2 turns into t.

The sum of m over the states in which two players meet is the chance that they do. All other
answers follow from these chances.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.tournaments.odds.chances import Chances
from evenbreak.tournaments.odds.group_odds import rank_orders, rank_states, result_chances
from evenbreak.tournaments.odds.plan import (
    Apart,
    Branch,
    GroupStep,
    Index,
    MatchStep,
    Plan,
    Players,
    adding_up,
)

_FEW = 4_000  # states, for which a sparse matrix takes longer to call than to multiply


@dataclass(frozen=True, eq=False)
class ForwardPass:
    """The result of a forward pass; arrays have a last axis for samples, if there are any.

    Parameters
    ----------
    meet
        for each match, the chance of each pair of its step.
    first_wins
        for each match, P(slot 1's player wins) in each pair.
    ranks
        for each group, ranks[i, k] = P(member i has rank k, from 0 on).
    total
        the probability of the what-if results; 1 if there are none.
    after
        the probabilities of the states after each step, by its number, if they were kept.
    """

    meet: Mapping[str, Floats]
    first_wins: Mapping[str, Floats]
    ranks: Mapping[str, Floats]
    total: Floats
    after: Mapping[int, Floats]


def forward_pass(plan: Plan, chances: Chances, *, keep: bool = False) -> ForwardPass:
    """Return the chance of every pair in every match of a plan.

    Parameters
    ----------
    plan
        the steps.
    chances
        the chances of the matches, for one sample or many.
    keep
        whether to keep the probabilities of all states.
    """
    masses: dict[int, Floats] = {}
    meet: dict[str, Floats] = {}
    first_wins: dict[str, Floats] = {}
    ranks: dict[str, Floats] = {}
    after: dict[int, Floats] = {}
    total = np.ones(())
    for number, step in enumerate(plan.steps):
        if isinstance(step, GroupStep):
            masses[number], ranks[step.name] = group_odds(step, chances)
        else:
            p = first_wins[step.name] = chances.of(step.name)[step.first, step.second]
            parts = [masses.pop(k) for k in step.joins]
            meet[step.name], masses[number] = played(step, parts, p)
        if keep:
            after[number] = masses[number]
        if not step.slots:
            total = total * masses.pop(number).sum(axis=0)
    return ForwardPass(meet, first_wins, ranks, total, after)


def played(step: MatchStep, parts: list[Floats], p: Floats) -> tuple[Floats, Floats]:
    """Return the chance of each pair of a match, and the probabilities of the states after it."""
    if p.ndim == 1 and step.apart and all(part.ndim == 1 for part in parts):
        first, second = (
            np.bincount(branch.winner, part) for branch, part in zip(step.apart, parts, strict=True)
        )
        table = p.reshape(len(first), len(second))
        one, other = step.apart
        won = parts[0][:, None] * _beaten(one, parts[1], table).T[one.winner]
        lost = _beaten(other, parts[0], 1.0 - table.T)[:, other.winner] * parts[1]
        return np.multiply.outer(first, second).ravel(), np.append(won, lost)
    mass = joined(parts)
    return pairs(step, mass), passed_on(step, mass, p)


def _beaten(branch: Apart, loser: Floats, win: Floats) -> Floats:
    """Return the chance of what is kept of the loser's part, for each player who can win.

    win[i, j] is the chance that the winner is i of his slot's players, if the other is j.
    """
    beaten: Floats = branch.kept @ (win[:, branch.loser] * loser).T
    return beaten


def joined(parts: list[Floats]) -> Floats:
    """Return the joint distribution of up to two independent parts."""
    if not parts:
        return np.ones(1)
    if len(parts) == 1:
        return parts[0]
    one, other = parts
    product = one[:, None] * other[None, :]
    return product.reshape(len(one) * len(other), *product.shape[2:])


def passed_on(step: MatchStep, mass: Floats, p: Floats) -> Floats:
    """Return the probabilities of the states after a match."""
    won, lost = split(step, mass, p)
    if step.distinct:
        return np.concatenate([won, lost])
    after = gathered(step, 0, won)
    after += gathered(step, 1, lost)
    return after


def split(step: MatchStep, mass: Floats, p: Floats) -> tuple[Floats, Floats]:
    """Return the probability of each state and a win of slot 1, and of slot 2.

    The second is a product too: the difference would lose the digits of a rare win.
    """
    whole = mass[..., None] if p.ndim > mass.ndim else mass
    won, lost = p, 1.0 - p
    if step.pair is not None:
        won, lost = won.take(step.pair, axis=0), lost.take(step.pair, axis=0)
    return whole * won, whole * lost


def gathered(step: MatchStep, side: int, mass: Floats) -> Floats:
    """Return what one branch adds to the probabilities of the states after a match."""
    branch: Branch = step.branches[side]
    moved = mass if branch.rows is None else mass[branch.rows]
    if mass.ndim == 1 and len(mass) < _FEW:
        return np.bincount(branch.to, moved, step.size).astype(float, copy=False)
    arrived: Floats = step.scatter[side] @ moved
    return arrived


def pairs(step: MatchStep, mass: Floats) -> Floats:
    """Return the chance of each pair of a match from the probabilities of its states."""
    if step.pair is None or step.meeting is None:
        return mass
    if mass.ndim == 1 and len(mass) < _FEW:
        return np.bincount(step.pair, mass, len(step.first)).astype(float, copy=False)
    met: Floats = step.meeting @ mass
    return met


def group_odds(step: GroupStep, chances: Chances) -> tuple[Floats, Floats]:
    """Return the probabilities of who qualifies from a group, and of who has which rank."""
    matches = zip(step.group.matches, step.group.pairs, strict=True)
    each = np.broadcast_arrays(*(chances.of(name)[pair] for name, pair in matches))
    results = result_chances(each)
    members = len(step.group.members)
    final = rank_orders(members, step.pairs)
    orders = summed(final.order_of, results, len(final.orders))
    _, shares = rank_states(members, step.pairs, step.ranks)
    ranks = np.zeros((members, members, *results.shape[1:]))
    for member in range(members):
        ahead = final.orders[:, member]
        level = (final.orders == ahead[:, None]).sum(axis=1)
        for lot in range(int(level.max())):
            there = level > lot
            share = orders[there] / level[there].reshape(-1, *[1] * (orders.ndim - 1))
            ranks[member] += summed(ahead[there] + lot, share, members)
    return shares @ orders, ranks


def summed(index: Index | Players, mass: Floats, size: int) -> Floats:
    """Return the sums of the values with the same index."""
    if mass.ndim == 1:
        return np.bincount(index, mass, size).astype(float, copy=False)
    sums: Floats = adding_up(index.astype(np.int32), size) @ mass
    return sums
