"""What a result would change: the leverage of each upcoming match.

A player's title odds are linear in one match's chances. So the difference between the odds after
slot 1's player wins and after they lose is a derivative, and one backward pass through the joint
distributions gives it for all matches at once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from evenbreak.arrays import Floats, own_arrays
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Place
from evenbreak.tournaments.brackets.standing import NOBODY, Results, Standing, standing
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of
from evenbreak.tournaments.odds.group_odds import rank_orders
from evenbreak.tournaments.odds.passes import ForwardPass, ResultValues, backward_pass, forward_pass
from evenbreak.tournaments.odds.plan import GroupStep, MatchStep, Plan
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.rematches import (
    group_meetings,
    meetings_so_far,
    place_odds,
    plan_meetings,
    settled_ranks,
)
from evenbreak.tournaments.odds.title import prizes

MOST_STATES = 2e7
"""The most joint states times players that one match may have for leverages to be calculated."""


@own_arrays
@dataclass(frozen=True, eq=False)
class Leverage:
    """How a match's result affects each player.

    Parameters
    ----------
    players
        by position, if they are known.
    p_first
        P(the player in slot 1 wins).
    now
        each player's current title odds, or expected prize.
    if_first, if_second
        the same if the player in slot 1, or in slot 2, wins; None if the two aren't known yet.
    swing
        the expected change from the result, up or down.
    """

    match: str
    players: tuple[int, int] | None
    p_first: float
    now: Floats
    if_first: Floats | None
    if_second: Floats | None
    swing: Floats


def leverages(
    bracket: Bracket,
    win: Wins,
    *,
    payouts: Sequence[float] | None = None,
    results: Results | None = None,
    live: Mapping[str, float] | None = None,
    walkovers: float | Mapping[str, float] = 0.0,
) -> list[Leverage]:
    """Return how each upcoming match's result affects each player.

    Parameters
    ----------
    bracket, win, results, live, walkovers
        as in `title_odds`; results only of matches whose players are known.
    payouts
        the money for first place, second, ..., to see how prizes change; None: how title odds
        change.

    Raises
    ------
    InputError
        if there is a result for a match whose players aren't known, or the bracket is too large.

    >>> from evenbreak.tournaments import single_elimination
    >>> coin = np.full((4, 4), 0.5)
    >>> for lever in leverages(single_elimination(["Ann", "Bo", "Cy", "Di"]), coin):
    ...     print(lever.match, lever.players, lever.if_first, lever.swing)
    W1.1 (0, 3) [0.5  0.25 0.25 0.  ] [0.25 0.   0.   0.25]
    W1.2 (1, 2) [0.25 0.5  0.   0.25] [0.   0.25 0.25 0.  ]
    F None None [0.25 0.25 0.25 0.25]
    """
    now = standing(bracket, results)
    plan = _plan(now)
    chances = chances_of(now, win, live=live, walkovers=walkovers)
    through = forward_pass(plan, chances, keep=True)
    title = [float(place == Place(1, 1)) for place in bracket.places]
    value = np.array(title) if payouts is None else prizes(bracket, payouts)
    at_end = {k: 0.0 for k, step in enumerate(plan.steps) if not step.slots}
    rewards = _Prizes(bracket, value)
    found = backward_pass(plan, chances, through, at_end, rewards, len(bracket.players))
    expected = _expected(now, plan, chances, through, value)
    return [
        _lever(now, chances, name, found[name], through, expected)
        for name in (match.name for match in plan.bracket.matches)
        if name not in now.winners
    ]


def _plan(now: Standing) -> Plan:
    if now.assumed:
        name = next(iter(now.assumed))
        raise InputError(
            "results has {name!r}. Give results of matches whose players are known.", name=name
        )
    plan = exact_plan(now.remaining, (), MOST_STATES / len(now.bracket.players))
    if plan is None:
        raise InputError(
            "bracket is too large for leverages at this point. Try again after a few results, "
            "or compare title_odds with and without a result."
        )
    return plan


def _expected(
    now: Standing, plan: Plan, chances: Chances, through: ForwardPass, value: Floats
) -> Floats:
    meetings = meetings_so_far(now) | group_meetings(plan.bracket, chances)
    meetings |= plan_meetings(plan, through)
    law = place_odds(now.bracket, meetings, {**settled_ranks(now), **through.ranks})
    return np.asarray(law @ value)


def _lever(
    now: Standing,
    chances: Chances,
    name: str,
    found: ResultValues,
    through: ForwardPass,
    expected: Floats,
) -> Leverage:
    seats = now.seats[name]
    if name in through.meet:
        p, meet = through.first_wins[name], through.meet[name]
    else:  # in a group
        p, meet = np.array([chances.of(name)[seats]]), np.ones(1)
    gain = found.first - found.second  # times the chance that the pair meets
    swing = 2.0 * (p * (1.0 - p)) @ np.abs(gain)
    p_first = float(p @ meet / meet.sum()) if meet.sum() else 0.5
    one, other = seats
    if one is None or other is None or NOBODY in seats:
        return Leverage(name, None, p_first, expected, None, None, swing)
    up = expected + (1.0 - p_first) * gain[0]
    down = expected - p_first * gain[0]
    return Leverage(name, (one, other), p_first, expected, up, down, swing)


class _Prizes:
    """Each player's pay at the end: a separate reward for each."""

    def __init__(self, bracket: Bracket, value: Floats) -> None:
        self.bracket = bracket
        self.value = dict(zip(bracket.places, value.tolist(), strict=True))
        self.going = bracket.going
        self.players = len(bracket.players)

    def of_match(self, step: MatchStep) -> tuple[Floats, Floats]:
        """Return what each pair is paid if slot 1's player wins, and if slot 2's does."""
        match, going = self.bracket.by_name[step.name], self.going[step.name]
        paid = []
        for side in (0, 1):
            pay = np.zeros((len(step.first), self.players + 1))
            sat = (step.first, step.second)
            ends = (
                (sat[side], match.winner_place, going.winner[side]),
                (sat[1 - side], match.loser_place, going.loser[1 - side]),
            )
            for players, place, on in ends:
                if place is not None and not on:
                    pay[np.arange(len(players)), players] += self.value[place]
            paid.append(pay[:, :-1])
        return paid[0], paid[1]

    def of_group(self, step: GroupStep) -> Floats:
        """Return what each of a group's orders pays, averaged over lots."""
        members = step.group.members
        orders = rank_orders(len(members), step.pairs).orders
        by_rank = [0.0 if place is None else self.value[place] for place in step.group.places]
        sums = np.concatenate([[0.0], np.cumsum(by_rank[: len(members)])])
        pay = np.zeros((len(orders), self.players))
        for k, player in enumerate(members):
            ahead = orders[:, k]
            level = (orders == ahead[:, None]).sum(axis=1)
            pay[:, player] = (sums[ahead + level] - sums[ahead]) / level
        return pay
