"""The backward pass: the expected reward from each state on, from the last match to the first.

With r the reward of a result and v'(t) the value of state t after a match, the value of a
state before it is

    v(s) = p(s) (r_1(s) + v'(s_1)) + (1 - p(s)) (r_2(s) + v'(s_2)),

where wins of slot 1 and of slot 2 lead to s_1 and s_2. Where a match joins two independent
parts of the bracket, the value of a state of one part is the mean over the states of the
other. This is reverse-mode differentiation of the expected reward.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.tournaments.odds.chances import Chances
from evenbreak.tournaments.odds.forward import ForwardPass, joined
from evenbreak.tournaments.odds.group_odds import rank_orders, rank_states, result_chances
from evenbreak.tournaments.odds.plan import GroupStep, MatchStep, Plan


class Rewards(Protocol):
    """The rewards of results; several kinds of reward are followed at once."""

    def of_match(self, step: MatchStep) -> tuple[Floats, Floats]:
        """Return the rewards of a win of slot 1 and of slot 2, each of shape (pairs, kinds)."""

    def of_group(self, step: GroupStep) -> Floats:
        """Return the mean reward of each final order of a group, of shape (orders, kinds)."""


class ResultValues(NamedTuple):
    """The values of the two results of a match.

    Parameters
    ----------
    first, second
        for each pair, the chance that they meet times the expected reward from then on, given
        that slot 1's player wins (`first`) or slot 2's (`second`).
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
    """Return the values of the results of every match.

    Parameters
    ----------
    plan, chances, through
        the plan, the chances, and their forward pass with all states kept.
    at_end
        the value of the end, for each step that leaves no slot open, by its number.
    rewards
        the rewards of results; None: only the end has a value.
    kinds
        the number of kinds of reward.
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
    """Return the chances of all pairs given that the what-if results happen.

    Parameters
    ----------
    plan, chances, through
        a plan with what-if results, the chances, and their forward pass with all states kept.

    Raises
    ------
    InputError
        if the results cannot all happen, or a group is still being played.
    """
    if any(isinstance(step, GroupStep) for step in plan.steps):
        raise InputError("results has a match after the groups; give it when the groups are over")
    if not float(through.total) > 0.0:
        raise InputError("results cannot all happen; give results that agree with each other")
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
    """Return the value of each state before a match, given the slot that wins."""
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
    summed: Floats = step.meeting @ weighted
    return summed
