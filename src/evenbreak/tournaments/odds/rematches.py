"""Expected rematches: how often two players meet again.

Along with the chance of each joint state, the chance is tracked that it holds *and* the players in
two given open slots have met. The two players in a match have then met; winner and loser take their
past meetings with them to their next slots.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from evenbreak.arrays import Floats, frozen
from evenbreak.tournaments.brackets.bracket import Bracket, GoesOn, Match, Place, Slot, Source
from evenbreak.tournaments.brackets.standing import NOBODY, Results, Standing, standing
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of
from evenbreak.tournaments.odds.passes import (
    ForwardPass,
    gathered,
    group_odds,
    joined,
    split,
    summed,
)
from evenbreak.tournaments.odds.plan import GroupStep, MatchStep, Plan, Players
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.play import play_out

MOST_STATES = 1.5e6
"""The most joint states that one match may have for rematches to be exact."""

_RUNS, _BATCHES = 40_000, 20

_Met: TypeAlias = dict[frozenset[Slot], Floats]


@dataclass(frozen=True, eq=False)
class Rematches:
    """The expected number of rematches.

    Parameters
    ----------
    by_match
        P(each match is between two players who have met before in this tournament). Decided
        matches, matches within groups, and the second final, which is always a rematch, are left
        out.
    error
        the standard error of their sum; 0 if it is exact.
    """

    by_match: Mapping[str, float]
    error: float

    @property
    def mean(self) -> float:
        """The expected number of upcoming rematches."""
        return sum(self.by_match.values())


def expected_rematches(
    bracket: Bracket,
    win: Wins | None = None,
    *,
    results: Results | None = None,
    rng: np.random.Generator | None = None,
) -> Rematches:
    """Return the expected number of rematches.

    Parameters
    ----------
    win
        as in `title_odds`; None: all players are equal.
    results
        the results so far; results of matches whose players aren't known are ignored.
    rng
        the random number generator if the bracket is too large to be exact; None: a generator with
        seed 0.

    >>> from evenbreak.tournaments import double_elimination
    >>> rematches = expected_rematches(double_elimination(8))
    >>> rematches.mean, rematches.by_match["F"]
    (1.3125, 0.6875)
    """
    now = standing(bracket, results)
    equal = np.full((len(bracket.players), len(bracket.players)), 0.5)
    chances = chances_of(now, equal if win is None else win)
    remaining = now.remaining
    plan = exact_plan(remaining, (), MOST_STATES)
    if plan is None:
        return _played_out(now, chances, rng or np.random.default_rng(0))
    again = _met_again(plan, chances, _met_so_far(now))
    return Rematches({name: p for name, p in again.items() if name != "F2"}, 0.0)


def _met_so_far(now: Standing) -> Floats:
    """Return 1 for each pair that has met, with an added row and column for no one.

    Players in the same group count: they will have met before anything else is played.
    """
    count = len(now.bracket.players)
    met = np.zeros((count + 1, count + 1))
    for group in now.bracket.groups:
        met[np.ix_(group.members, group.members)] = 1.0
    for name in now.winners:
        one, other = now.seats[name]
        if one is not None and other is not None and NOBODY not in (one, other):
            met[one, other] = met[other, one] = 1.0
    return met


def _met_again(plan: Plan, chances: Chances, before: Floats) -> dict[str, float]:
    masses: dict[int, Floats] = {}
    pasts: dict[int, _Met] = {}
    again: dict[str, float] = {}
    for number, step in enumerate(plan.steps):
        if isinstance(step, GroupStep):
            masses[number], _ = group_odds(step, chances)
            pasts[number] = {}
            continue
        mass, past = _joined_pasts(
            [masses.pop(k) for k in step.joins], [pasts.pop(k) for k in step.joins]
        )
        again[step.name] = _share_met(plan, step, mass, past, before)
        p = chances.of(step.name)[step.first, step.second]
        won, lost = split(step, mass, p)
        masses[number] = gathered(step, 0, won) + gathered(step, 1, lost)
        pasts[number] = _past_after(plan, step, (won, lost), past, p)
    return again


def _joined_pasts(masses: list[Floats], pasts: list[_Met]) -> tuple[Floats, _Met]:
    if len(masses) < 2:
        return joined(masses), pasts[0] if pasts else {}
    past = {pair: joined([share, masses[1]]) for pair, share in pasts[0].items()}
    past |= {pair: joined([masses[0], share]) for pair, share in pasts[1].items()}
    return joined(masses), past


def _share_met(plan: Plan, step: MatchStep, mass: Floats, past: _Met, before: Floats) -> float:
    """Return P(a match's two players have met before)."""
    earlier = before[step.first, step.second]
    long_ago = earlier if step.pair is None else earlier[step.pair]
    lately = past.get(frozenset(plan.bracket.by_name[step.name].slots))
    if lately is None:
        return float(mass @ long_ago)
    return float(mass @ long_ago + lately @ (1.0 - long_ago))


def _past_after(
    plan: Plan, step: MatchStep, parts: tuple[Floats, Floats], past: _Met, p: Floats
) -> _Met:
    """Return who has met after a match."""
    slots = plan.bracket.by_name[step.name].slots
    outlets: list[Source] = [slot for slot in step.slots if slot.match == step.name]
    count = len(plan.bracket.players)
    real = (step.first < count) & (step.second < count)
    there = real if step.pair is None else real[step.pair]
    after: _Met = {}

    def add(one: Slot, other: Slot, side: int, mass: Floats) -> None:
        pair = frozenset((one, other))
        arrived = gathered(step, side, mass)
        after[pair] = after[pair] + arrived if pair in after else arrived

    for side in (0, 1):
        went: dict[Slot, list[Slot]] = {slots[0]: [], slots[1]: []}
        for outlet in outlets:
            sat = side if outlet.outcome == "winner" else 1 - side
            if outlet.via in (None, sat + 1):
                went[slots[sat]].append(outlet)
        for one in went[slots[0]]:
            for other in went[slots[1]]:
                add(one, other, side, parts[side] * there)
        of_state = p if step.pair is None else p[step.pair]
        share = of_state if side == 0 else 1.0 - of_state
        for pair, mass in past.items():
            one, other = pair
            if one in went and other in went:
                continue
            for new_one in went.get(one, [one]):
                for new_other in went.get(other, [other]):
                    add(new_one, new_other, side, mass * share)
    return after


def _played_out(now: Standing, chances: Chances, rng: np.random.Generator) -> Rematches:
    """Return rematches counted over simulated tournaments."""
    remaining = now.remaining
    nobody = len(now.bracket.players)
    runs = _RUNS // _BATCHES
    grouped = {name for group in now.bracket.groups for name in group.matches} | {"F2"}
    names = [match.name for match in remaining.matches if match.name not in grouped]
    shares: list[Floats] = []
    for _ in range(_BATCHES):
        met = np.repeat(_met_so_far(now)[None].astype(bool), runs, axis=0)
        played = play_out(remaining, chances, rng, runs)
        row = np.arange(runs)
        counts = []
        for name in names:
            first, second = played.first[name], played.second[name]
            real = (first < nobody) & (second < nobody)
            counts.append((met[row, first, second] & real).mean())
            met[row, first, second] = met[row, second, first] = True
        shares.append(np.array(counts))
    mean = np.mean(shares, axis=0).tolist()
    error = float(np.std(np.sum(shares, axis=1), ddof=1) / np.sqrt(_BATCHES))
    return Rematches(dict(zip(names, mean, strict=True)), error)


# Who meets whom in each match, and the places that follow from it.


class Meeting(NamedTuple):
    """The pairs of players who can meet in a match.

    Parameters
    ----------
    first, second
        the players in slot 1 and slot 2, by position.
    probability
        P(these two meet in this match, in these slots); a last axis, if any, is for samples.
    first_wins
        P(the player in slot 1 wins | these two meet).
    """

    first: Players
    second: Players
    probability: Floats
    first_wins: Floats

    @property
    def played(self) -> float:
        """P(the match is played): a second final may not be needed."""
        return float(self.probability.sum())


def plan_meetings(plan: Plan, through: ForwardPass) -> dict[str, Meeting]:
    """Return the meetings in a plan's matches, given its forward pass."""
    found = {}
    for name, (there, first, second) in plan.pairs.items():
        meet, p = through.meet[name], through.first_wins[name]
        if there is not None:
            meet, p = meet[there], p[there]
        if p.ndim > meet.ndim:
            meet = np.broadcast_to(meet[:, None], p.shape)
        found[name] = Meeting(first, second, frozen(meet), frozen(p))
    return found


def averaged(meetings: Mapping[str, Meeting]) -> dict[str, Meeting]:
    """Return the meetings averaged over the samples."""
    found = {}
    for name, (first, second, meet, p) in meetings.items():
        if p.ndim > 1:
            won, meet = (meet * p).mean(axis=1), meet.mean(axis=1)
            p = np.divide(won, meet, out=np.full_like(won, 0.5), where=meet > 0.0)
        found[name] = Meeting(first, second, meet, p)
    return found


def group_meetings(bracket: Bracket, chances: Chances) -> dict[str, Meeting]:
    """Return the meetings of group matches, whose players are known."""
    found = {}
    for group in bracket.groups:
        for name, pair in zip(group.matches, group.pairs, strict=True):
            one, other = (np.array([player], dtype=np.int16) for player in pair)
            p = chances.of(name)[one, other]
            found[name] = Meeting(one, other, np.ones(p.shape), p)
    return found


def settled_ranks(now: Standing) -> dict[str, Floats]:
    """Return the rank probabilities of finished groups: zeros and ones."""
    found = {}
    for group in now.bracket.groups:
        if Source(group.name, 1) in now.sent:
            ranks = range(1, len(group.members) + 1)
            order = [now.sent[Source(group.name, rank)] for rank in ranks]
            found[group.name] = np.equal.outer(group.members, order).astype(float)
    runners_up = now.bracket.runners_up
    if runners_up and Source(runners_up.name, 1) in now.sent:
        order = [now.sent[Source(runners_up.name, k + 1)] for k, _ in enumerate(runners_up.places)]
        found[runners_up.name] = np.equal.outer(range(len(now.bracket.players)), order) * 1.0
    return found


def meetings_so_far(now: Standing) -> dict[str, Meeting]:
    """Return the meetings in decided matches: one pair each, or none if the match wasn't needed."""
    found = {}
    for name, won in now.winners.items():
        one, other = now.seats[name]
        if one is None or other is None or NOBODY in (one, other):
            pair = np.empty(0, dtype=np.int16)
            found[name] = Meeting(pair, pair, pair.astype(float), pair.astype(float))
        else:
            found[name] = Meeting(
                np.array([one], dtype=np.int16),
                np.array([other], dtype=np.int16),
                np.ones(1),
                np.array([float(won == one)]),
            )
    return found


def place_odds(
    bracket: Bracket, meetings: Mapping[str, Meeting], ranks: Mapping[str, Floats]
) -> Floats:
    """Return P(each player has each place), shape (players, places) or (players, places, samples).

    ranks[i, k] = P(member i has rank k, counting from 0); for the runners-up, i is any player.
    """
    column = {place: k for k, place in enumerate(bracket.places)}
    samples = [part.probability.shape[1:] for part in meetings.values()]
    samples += [part.shape[2:] for part in ranks.values()]
    shape = max(samples, default=())
    odds = np.zeros((len(bracket.players), len(column), *shape))
    in_group = {name for group in bracket.groups for name in group.matches}
    for match in bracket.matches:
        if match.name in meetings and match.name not in in_group:
            add_places(odds, column, match, bracket.going[match.name], meetings[match.name])
    for group in bracket.groups:
        for rank, place in enumerate(group.places):
            if place is not None and group.name in ranks and rank < len(group.members):
                share = ranks[group.name][:, rank]
                more = share.shape[1:] or (1,) * len(shape)
                odds[list(group.members), column[place]] += share.reshape(len(share), *more)
    runners_up = bracket.runners_up
    if runners_up and runners_up.name in ranks:
        for rank, place in enumerate(runners_up.places):
            if place is not None:
                share = ranks[runners_up.name][:, rank]
                odds[:, column[place]] += share.reshape(len(share), *(1,) * len(shape))
    return odds


def add_places(
    odds: Floats, column: Mapping[Place, int], match: Match, going: GoesOn, meeting: Meeting
) -> None:
    """Add the places decided by a match: the places of players without a next match."""
    if all(going.winner) and all(going.loser):
        return
    won = meeting.probability * meeting.first_wins
    lost = meeting.probability * (1.0 - meeting.first_wins)
    for place, on, players, mass in (
        (match.winner_place, going.winner[0], meeting.first, won),
        (match.winner_place, going.winner[1], meeting.second, lost),
        (match.loser_place, going.loser[0], meeting.first, lost),
        (match.loser_place, going.loser[1], meeting.second, won),
    ):
        if place is not None and not on:
            added = summed(players, mass, len(odds))
            odds[:, column[place]] += added.reshape(
                len(odds), *added.shape[1:] or [1] * (odds.ndim - 2)
            )
