"""What each state is worth: the law of open slots, followed backwards.

With r the reward of a result and v' the value of the states after a match, the value of
a state before it is

    v(s) = p(s) (r_1(s) + v'(s_1)) + (1 - p(s)) (r_2(s) + v'(s_2)),

s_1 and s_2 the states that wins of slot 1 and of slot 2 lead to. Where a match joins two
independent parts, the value of a state of one is the mean over the states of the other.
In other words: the derivative of the expected reward, by going back through the steps.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np

from evenbreak.errors import InputError
from evenbreak.tournaments.odds.chances import Chances, Floats
from evenbreak.tournaments.odds.forward import Flow, joined
from evenbreak.tournaments.odds.group_law import rank_laws, rank_states, result_law
from evenbreak.tournaments.odds.plan import GroupStep, MatchStep, Plan


class Rewards(Protocol):
    """What results pay: several kinds of reward at once."""

    def of_match(self, step: MatchStep) -> tuple[Floats, Floats]:
        """Return what is paid if slot 1's player wins, and if slot 2's does; (pairs, kinds)."""

    def of_group(self, step: GroupStep) -> Floats:
        """Return what each order of a group pays on average over the lots; (orders, kinds)."""


class Worth(NamedTuple):
    """What the results of a match are worth, summed over the states by their chance.

    Parameters
    ----------
    first, second
        for each pair of the match: the chance that they meet times the expected reward from
        then on, given that slot 1's player, slot 2's player wins.
    """

    first: Floats
    second: Floats


def worth(
    plan: Plan,
    chances: Chances,
    through: Flow,
    at_end: Mapping[int, float],
    rewards: Rewards | None = None,
    kinds: int = 1,
) -> dict[str, Worth]:
    """Return what each result of each match is worth.

    Parameters
    ----------
    plan, chances, through
        the steps, the chances, and what flowed through, kept.
    at_end
        the value of the last state of each step that leaves no slot open.
    rewards
        what results pay.
    kinds
        how many kinds of reward are followed at once.
    """
    values: dict[int, Floats] = {}
    found: dict[str, Worth] = {}
    for number in range(len(plan.steps) - 1, -1, -1):
        step = plan.steps[number]
        if not step.slots:
            values[number] = np.full((step.size, kinds), at_end[number])
        after = values.pop(number)
        if isinstance(step, GroupStep):
            found |= _group_worth(step, chances, after, rewards)
            continue
        parts = [through.after[k] for k in step.joins]
        mass = joined(parts)
        p = chances.of(step.name)[step.first, step.second]
        pay = rewards.of_match(step) if rewards else None
        branch = [
            _followed(step, side, after, None if pay is None else pay[side], len(mass))
            for side in (0, 1)
        ]
        found[step.name] = Worth(*(_by_pair(step, mass, value) for value in branch))
        of_state = (p if step.pair is None else p[step.pair])[:, None]
        before = of_state * branch[0] + (1.0 - of_state) * branch[1]
        if len(parts) == 1:
            values[step.joins[0]] = before
        elif parts:
            table = before.reshape(len(parts[0]), len(parts[1]), kinds)
            values[step.joins[0]] = np.einsum("ijk,j->ik", table, parts[1])
            values[step.joins[1]] = np.einsum("ijk,i->jk", table, parts[0])
    return found


def conditional(plan: Plan, chances: Chances, through: Flow) -> Flow:
    """Return the flow given that the assumed results happen.

    Parameters
    ----------
    plan
        a plan with assumed results.
    through
        what flowed through it, kept: only what agrees with them.

    Raises
    ------
    InputError
        if they cannot happen, or there are groups to be played.
    """
    if any(isinstance(step, GroupStep) for step in plan.steps):
        raise InputError("results has a match after the groups; give it once the groups are played")
    if not float(through.total) > 0.0:
        raise InputError("results cannot all happen; give results that agree with each other")
    at_end = {
        number: 1.0 / float(through.after[number].sum())
        for number, step in enumerate(plan.steps)
        if not step.slots
    }
    meet: dict[str, Floats] = {}
    first_wins: dict[str, Floats] = {}
    for name, value in worth(plan, chances, through, at_end).items():
        p = through.first_wins[name]
        won, lost = p * value.first[:, 0], (1.0 - p) * value.second[:, 0]
        meet[name] = won + lost
        first_wins[name] = np.divide(won, meet[name], out=p.copy(), where=meet[name] > 0.0)
    return Flow(meet, first_wins, through.ranks, np.ones(()), {})


def _followed(step: MatchStep, side: int, after: Floats, pay: Floats | None, states: int) -> Floats:
    """Return the value of each state before, given that the player in a slot wins."""
    branch = step.branches[side]
    value = after[branch.to]
    if branch.rows is not None:
        all_states = np.zeros((states, after.shape[1]))
        all_states[branch.rows] = value
        value = all_states
    if pay is not None:
        value = value + (pay if step.pair is None else pay[step.pair])
    return value


def _group_worth(
    step: GroupStep, chances: Chances, after: Floats, rewards: Rewards | None
) -> dict[str, Worth]:
    """Return what the results of a group's matches are worth."""
    members = len(step.group.members)
    _, shares = rank_states(members, step.pairs, step.ranks)
    value: Floats = shares.T @ after
    if rewards:
        value = value + rewards.of_group(step)
    of_result = value[rank_laws(members, step.pairs).order_of]
    matches = list(zip(step.group.matches, step.group.pairs, strict=True))
    each = [np.asarray(chances.of(name)[pair]) for name, pair in matches]
    found = {}
    for k, (name, _) in enumerate(matches):
        sides = []
        for chance in (1.0, 0.0):
            law = result_law([*each[:k], np.array(chance), *each[k + 1 :]])
            sides.append((law @ of_result)[None, :])
        found[name] = Worth(*sides)
    return found


def _by_pair(step: MatchStep, mass: Floats, value: Floats) -> Floats:
    weighted = mass[:, None] * value
    if step.meeting is None:
        return weighted
    summed: Floats = step.meeting @ weighted
    return summed
