"""Two passes over the matches: forward, the joint distribution of open slots; backward, rewards.

With m(s) the probability of state s before a match and p(s) the chance that slot 1's player
wins it in that state, the probabilities after the match are

    m'(t) = sum of m(s) p(s) over the s that a win of slot 1 turns into t
          + sum of m(s) (1 - p(s)) over the s that a win of slot 2 turns into t.

The sum of m over the states in which two players meet is the chance that they do. All other
answers follow from these chances.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
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
    """The result of a forward pass; arrays have a last axis for samples, if any.

    `meet` has the chance of each possible pairing in a match, `first_wins` P(slot 1's player wins)
    given the pair, ranks[i, k] = P(member i has rank k, from 0 on). `total` is the probability of
    the what-if results; `after` has the state probabilities after each step, if they were kept.
    """

    meet: Mapping[str, Floats]
    first_wins: Mapping[str, Floats]
    ranks: Mapping[str, Floats]
    total: Floats
    after: Mapping[int, Floats]


def forward_pass(plan: Plan, chances: Chances, *, keep: bool = False) -> ForwardPass:
    """Return the chance of every pairing in every match of a plan.

    With `keep`, the probabilities of all states are kept.
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
    """Return the chance of each pairing in a match, and the state probabilities after it."""
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
    """Return what is kept of the loser's part, as a chance for each player who can win.

    win[i, j] is the chance that the winner is player i of their slot, if the other is j.
    """
    return np.asarray(branch.kept @ (win[:, branch.loser] * loser).T)


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
    sides = split(step, mass, p)
    if step.distinct:
        return np.concatenate([*sides])
    after = gathered(step, 0, next(sides))
    after += gathered(step, 1, next(sides))
    return after


def split(step: MatchStep, mass: Floats, p: Floats) -> Iterator[Floats]:
    """Yield the probability of each state with a win for slot 1, and for slot 2.

    The second is a product too, because a difference would lose digits if a win is rare.
    """
    whole = mass[..., None] if p.ndim > mass.ndim else mass
    for side in (0, 1):  # one after the other: of many samples each is megabytes
        won = 1.0 - p if side else p
        yield whole * (won if step.pair is None else won.take(step.pair, axis=0))


def gathered(step: MatchStep, side: int, mass: Floats) -> Floats:
    """Return what one branch adds to the probabilities of the states after a match."""
    branch: Branch = step.branches[side]
    moved = mass if branch.rows is None else mass[branch.rows]
    if mass.ndim == 1 and len(mass) < _FEW:
        return np.bincount(branch.to, moved, step.size).astype(float, copy=False)
    return np.asarray(step.scatter[side] @ moved)


def pairs(step: MatchStep, mass: Floats) -> Floats:
    """Return the chance of each pairing in a match, given its states' probabilities."""
    if step.pair is None or step.meeting is None:
        return mass
    if mass.ndim == 1 and len(mass) < _FEW:
        return np.bincount(step.pair, mass, len(step.first)).astype(float, copy=False)
    return np.asarray(step.meeting @ mass)


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
    return np.asarray(adding_up(index.astype(np.int32), size) @ mass)


# The backward pass: the expected reward from each state on, from the last match to the first.
#
# With r the reward of a result and v'(t) the value of state t after a match, the value of a
# state before it is
#
#     v(s) = p(s) (r_1(s) + v'(s_1)) + (1 - p(s)) (r_2(s) + v'(s_2)),
#
# where wins of slot 1 and of slot 2 lead to s_1 and s_2. Where a match joins two independent
# parts of the bracket, the value of a state of one part is the mean over the states of the
# other. This is reverse-mode differentiation of the expected reward.


class Rewards(Protocol):
    """Rewards for results; several rewards are tracked at once."""

    def of_match(self, step: MatchStep) -> tuple[Floats, Floats]:
        """Return the rewards for a win by slot 1 and by slot 2, each of shape (pairs, kinds)."""

    def of_group(self, step: GroupStep) -> Floats:
        """Return the mean reward for each of a group's final orders, of shape (orders, kinds)."""


class ResultValues(NamedTuple):
    """The values of a match's two results.

    For each pair, the chance that they meet times the expected reward from then on, given that slot
    1's player wins (`first`) or slot 2's (`second`).
    """

    first: Floats
    second: Floats


def backward_pass(
    plan: Plan,
    chances: Chances,
    through: ForwardPass,
    at_end: Mapping[int, float],
    rewards: Rewards | None = None,
    kinds: int = 1,
) -> dict[str, ResultValues]:
    """Return the values of every match's results; the forward pass has kept all states.

    `at_end` is the final value for each step that leaves no slot open; without rewards, only the
    end has a value.
    """
    values: dict[int, Floats] = {}
    found: dict[str, ResultValues] = {}
    for number in range(len(plan.steps) - 1, -1, -1):
        step = plan.steps[number]
        if not step.slots:
            values[number] = np.full((step.size, kinds), at_end[number])
        after = values.pop(number)
        if isinstance(step, GroupStep):
            found |= _group_values(step, chances, after, rewards)
            continue
        parts = [through.after[k] for k in step.joins]
        mass = joined(parts)
        p = chances.of(step.name)[step.first, step.second]
        pay = rewards.of_match(step) if rewards else None
        branch = [
            _followed(step, side, after, None if pay is None else pay[side], len(mass))
            for side in (0, 1)
        ]
        found[step.name] = ResultValues(*(_by_pair(step, mass, value) for value in branch))
        of_state = (p if step.pair is None else p[step.pair])[:, None]
        before = of_state * branch[0] + (1.0 - of_state) * branch[1]
        if len(parts) == 1:
            values[step.joins[0]] = before
        elif parts:
            table = before.reshape(len(parts[0]), len(parts[1]), kinds)
            values[step.joins[0]] = np.einsum("ijk,j->ik", table, parts[1])
            values[step.joins[1]] = np.einsum("ijk,i->jk", table, parts[0])
    return found


def conditional(plan: Plan, chances: Chances, through: ForwardPass) -> ForwardPass:
    """Return the chances of all pairings, conditional on the what-if results.

    The forward pass has kept all states. Raises InputError if the results can't all happen, or a
    group is still being played.
    """
    if any(isinstance(step, GroupStep) for step in plan.steps):
        raise InputError(
            "results has a match from after the groups. Leave it out until the groups are over."
        )
    if not float(through.total) > 0.0:
        raise InputError("results can't all happen. Give results that agree with each other.")
    at_end = {
        number: 1.0 / float(through.after[number].sum())
        for number, step in enumerate(plan.steps)
        if not step.slots
    }
    meet: dict[str, Floats] = {}
    first_wins: dict[str, Floats] = {}
    for name, value in backward_pass(plan, chances, through, at_end).items():
        p = through.first_wins[name]
        won, lost = p * value.first[:, 0], (1.0 - p) * value.second[:, 0]
        meet[name] = won + lost
        first_wins[name] = np.divide(won, meet[name], out=p.copy(), where=meet[name] > 0.0)
    return ForwardPass(meet, first_wins, through.ranks, np.ones(()), {})


def _followed(step: MatchStep, side: int, after: Floats, pay: Floats | None, states: int) -> Floats:
    """Return each state's value before a match, given the slot that wins."""
    branch = step.branches[side]
    value = after[branch.to]
    if branch.rows is not None:
        all_states = np.zeros((states, after.shape[1]))
        all_states[branch.rows] = value
        value = all_states
    if pay is not None:
        value = value + (pay if step.pair is None else pay[step.pair])
    return value


def _group_values(
    step: GroupStep, chances: Chances, after: Floats, rewards: Rewards | None
) -> dict[str, ResultValues]:
    """Return the values of the results of a group's matches."""
    members = len(step.group.members)
    _, shares = rank_states(members, step.pairs, step.ranks)
    value: Floats = shares.T @ after
    if rewards:
        value = value + rewards.of_group(step)
    of_result = value[rank_orders(members, step.pairs).order_of]
    matches = list(zip(step.group.matches, step.group.pairs, strict=True))
    each = [np.asarray(chances.of(name)[pair]) for name, pair in matches]
    found = {}
    for k, (name, _) in enumerate(matches):
        sides = []
        for chance in (1.0, 0.0):
            results = result_chances([*each[:k], np.array(chance), *each[k + 1 :]])
            sides.append((results @ of_result)[None, :])
        found[name] = ResultValues(*sides)
    return found


def _by_pair(step: MatchStep, mass: Floats, value: Floats) -> Floats:
    weighted = mass[:, None] * value
    if step.meeting is None:
        return weighted
    return np.asarray(step.meeting @ weighted)
