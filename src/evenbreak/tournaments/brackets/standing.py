"""A tournament in progress: results so far, who is in which match, what can be played now."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np

from evenbreak.errors import InputError
from evenbreak.league.tables.ladder import places_by_wins
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Match, Slot, Source, some_of

NOBODY = -1
"""The player in a slot that stays empty, as in a second final that isn't needed."""

Results: TypeAlias = Mapping[str, str | Sequence[str]]
"""The winner of each decided match, by match name.

For a group whose ties were broken by lot, also its players in final order, by group name; the same
goes for the runners-up, by their rank.
"""


@dataclass(frozen=True, eq=False)
class Standing:
    """A bracket at one moment in the tournament.

    Parameters
    ----------
    winners
        the winner of each decided match, by position; NOBODY for a match that is not needed.
    seats
        the players in each match's two slots: a position, NOBODY, or None if not known yet.
    sent
        the players who advanced from decided matches and groups.
    assumed
        what-if results: those of matches whose players aren't known yet.
    """

    bracket: Bracket
    winners: Mapping[str, int]
    seats: Mapping[str, tuple[int | None, int | None]]
    sent: Mapping[Source, int]
    assumed: Mapping[str, int]

    @cached_property
    def to_play(self) -> tuple[str, ...]:
        """The matches that can be played now, because both players are known."""
        return tuple(
            name
            for name, seats in self.seats.items()
            if name not in self.winners and None not in seats
        )

    @cached_property
    def remaining(self) -> Bracket:
        """The undecided matches, with their slots' players as far as they are known."""
        groups = tuple(group for group in self.bracket.groups if not self._settled(group))
        still = {name for group in groups for name in group.matches}
        matches = tuple(
            self._seated(match)
            for match in self.bracket.matches
            if match.name not in self.winners or match.name in still
        )
        runners_up = self.bracket.runners_up
        if runners_up is not None:
            runners_up = replace(runners_up, settled=tuple(self.runners_up))
            if Source(runners_up.name, 1) in self.sent:
                runners_up = None
        return replace(self.bracket, matches=matches, groups=groups, byes=(), runners_up=runners_up)

    @cached_property
    def runners_up(self) -> list[tuple[str, int, int]]:
        """Each finished group's runner-up, by position, and the weight of their wins."""
        return _runners_up(self.bracket, self.winners, self.sent)

    def _seated(self, match: Match) -> Match:
        slots = self._slot(match.slots[0]), self._slot(match.slots[1])
        return match if slots == match.slots else replace(match, slots=slots)

    def _slot(self, slot: Slot) -> Slot:
        return slot if isinstance(slot, int) else self.sent.get(slot, slot)

    def _settled(self, group: Group) -> bool:
        return Source(group.name, 1) in self.sent


def standing(bracket: Bracket, results: Results | None = None) -> Standing:
    """Return the state of a bracket after the results so far.

    Raises
    ------
    InputError
        if a match or a player is unknown, or a winner is not in the match.

    >>> from evenbreak.tournaments import double_elimination
    >>> now = standing(double_elimination(["Ann", "Bo", "Cy", "Di"]), {"W1.1": "Di"})
    >>> now.to_play, now.seats["L1.1"], now.seats["W2.1"]
    (('W1.2',), (0, None), (3, None))
    """
    given = dict(results or {})
    _check_names(bracket, given)
    group_of = {name: group for group in bracket.groups for name in group.matches}
    winners: dict[str, int] = {}
    seats: dict[str, tuple[int | None, int | None]] = {}
    sent: dict[Source, int] = {}
    assumed: dict[str, int] = {}
    for match in bracket.matches:
        one, other = (slot if isinstance(slot, int) else sent.get(slot) for slot in match.slots)
        seats[match.name] = one, other
        won = _winner(bracket, match, (one, other), given.get(match.name))
        if won is None:
            continue
        if one is None or other is None:
            assumed[match.name] = won
            continue
        winners[match.name] = won
        if match.name in group_of:
            sent |= _settled_ranks(bracket, group_of[match.name], winners, given)
            sent |= _best_runners_up(bracket, winners, sent, given)
        else:
            sent |= _outcomes(match.name, (one, other), won)
    return Standing(bracket, winners, seats, sent, assumed)


def _check_names(bracket: Bracket, results: dict[str, str | Sequence[str]]) -> None:
    known = {*bracket.by_name, *(group.name for group in bracket.groups)}
    known |= {bracket.runners_up.name} if bracket.runners_up else set()
    for name in results:
        if name not in known:
            listed = some_of(list(bracket.by_name))
            raise InputError(
                "{results} has match {name!r}. Give one of {listed}.", name=name, listed=listed
            )


def _winner(
    bracket: Bracket,
    match: Match,
    seats: tuple[int | None, int | None],
    given: str | Sequence[str] | None,
) -> int | None:
    one, other = seats
    if given is None:
        if NOBODY in seats and None not in seats:
            return one if other == NOBODY else other
        return None
    player = bracket.player(str(given))
    if None not in seats and player not in seats:
        names = " and ".join(bracket.players[k] for k in seats if k is not None and k >= 0)
        raise InputError(
            "results has {given!r} as the winner of {match}, which is between {what}",
            given=given,
            match=match.name,
            what=names or "nobody",
        )
    return player


def _outcomes(name: str, seats: tuple[int, int], won: int) -> dict[Source, int]:
    slot = 1 if won == seats[0] else 2
    there = {"winner": won, "loser": seats[2 - slot]}
    sent: dict[Source, int] = {}
    for outcome, player in there.items():
        sat = slot if outcome == "winner" else 3 - slot
        sent[Source(name, outcome)] = player
        sent[Source(name, outcome, sat)] = player
        sent[Source(name, outcome, 3 - sat)] = NOBODY
    return sent


def _settled_ranks(
    bracket: Bracket,
    group: Group,
    winners: dict[str, int],
    given: dict[str, str | Sequence[str]],
) -> dict[Source, int]:
    """Return a group's final ranking, or nothing while it is open."""
    if not all(name in winners for name in group.matches):
        return {}
    if group.name in given:
        order = _in_given_order(bracket, group.name, group.members, given)
    else:
        places = ranked(group.members, group.pairs, [winners[name] for name in group.matches])
        if len(set(places)) < len(places):
            return {}
        order = [player for _, player in sorted(zip(places, group.members, strict=True))]
    return {Source(group.name, rank): player for rank, player in enumerate(order, 1)}


def _in_given_order(
    bracket: Bracket,
    name: str,
    members: Sequence[int],
    given: dict[str, str | Sequence[str]],
) -> list[int]:
    """Return the final order of a group, or of the runners-up, as stated in the results."""
    order = [bracket.player(player) for player in given[name]]
    if sorted(order) != sorted(members):
        raise InputError(
            "results has {given!r} for group {group}. Give the group's players in order of rank.",
            given=given[name],
            group=name,
        )
    return order


def _runners_up(
    bracket: Bracket, winners: Mapping[str, int], sent: Mapping[Source, int]
) -> list[tuple[str, int, int]]:
    if bracket.runners_up is None:
        return []
    weight, found = dict(bracket.runners_up.weights), []
    for group in bracket.groups:
        player = sent.get(Source(group.name, bracket.runners_up.rank))
        if player is not None:
            wins = sum(winners.get(name) == player for name in group.matches)
            found.append((group.name, player, wins * weight[group.name]))
    return found


def _best_runners_up(
    bracket: Bracket,
    winners: Mapping[str, int],
    sent: Mapping[Source, int],
    given: dict[str, str | Sequence[str]],
) -> dict[Source, int]:
    """Return the runners-up's order, or nothing while it is open which of them advance."""
    found = _runners_up(bracket, winners, sent)
    if bracket.runners_up is None or len(found) < len(bracket.groups):
        return {}
    name, best = bracket.runners_up.name, bracket.runners_up.going_on
    if name in given:
        order = _in_given_order(bracket, name, [player for _, player, _ in found], given)
    else:
        ranking = sorted(found, key=lambda one: -one[2])
        shares = [share for _, _, share in ranking]
        if len(set(shares[: best + 1])) < len(shares[: best + 1]):
            return {}
        order = [player for _, player, _ in ranking]
    return {Source(name, rank): player for rank, player in enumerate(order, 1)}


# The ranking of a group: matches won, then matches won among tied players.


def ranked(
    members: Sequence[int], pairs: Sequence[tuple[int, int]], winners: Sequence[int]
) -> list[int]:
    """Return how many players are ranked ahead of each member; tied players share a number."""
    seat = {player: k for k, player in enumerate(members)}
    beats = np.zeros((len(seat), len(seat)), dtype=np.int16)
    for (one, other), won in zip(pairs, winners, strict=True):
        beats[seat[won], seat[other if won == one else one]] += 1
    ahead: list[int] = places_by_wins(beats).tolist()
    return ahead
