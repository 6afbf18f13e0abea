"""Who meets whom in each match, and the places that follow from it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats, frozen
from evenbreak.tournaments.brackets.bracket import Bracket, GoesOn, Match, Place, Source
from evenbreak.tournaments.brackets.standing import NOBODY, Standing
from evenbreak.tournaments.odds.chances import Chances
from evenbreak.tournaments.odds.forward import ForwardPass, summed
from evenbreak.tournaments.odds.plan import Plan, Players


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
    """Return the meetings of a plan's matches from its forward pass."""
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
    """Return the rank probabilities of groups that are over: zeros and ones."""
    found = {}
    for group in now.bracket.groups:
        if Source(group.name, 1) in now.sent:
            ranks = range(1, len(group.members) + 1)
            order = [now.sent[Source(group.name, rank)] for rank in ranks]
            found[group.name] = np.equal.outer(group.members, order).astype(float)
    return found


def meetings_so_far(now: Standing) -> dict[str, Meeting]:
    """Return the meetings of decided matches: one pair each, none if it was not needed."""
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

    Parameters
    ----------
    bracket
        the whole bracket.
    meetings
        the meetings of the matches to take into account.
    ranks
        for each group to take into account, ranks[i, k] = P(member i has rank k, from 0 on).
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
    return odds


def add_places(
    odds: Floats, column: Mapping[Place, int], match: Match, going: GoesOn, meeting: Meeting
) -> None:
    """Add the places that a match decides: those of players without a next match."""
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
