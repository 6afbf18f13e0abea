"""Odds by drawing the first rounds: each draw's later rounds are worked out exactly.

Averaging what is exact given the draw varies less than playing all of it out by lot
(Rao & Blackwell). All draws share one plan: only who is who differs between them. Draws
come in batches, each spread evenly over the luck of each match (a Latin hypercube), and the
standard errors are those of the mean of the batches.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.tournaments.brackets.bracket import Bracket, Slot, Source
from evenbreak.tournaments.odds.chances import Chances, Floats
from evenbreak.tournaments.odds.forward import Flow, flow
from evenbreak.tournaments.odds.meetings import Meeting, place_law
from evenbreak.tournaments.odds.order import elimination_order
from evenbreak.tournaments.odds.plan import MatchStep, Plan, Players, plan_of
from evenbreak.tournaments.odds.play import PlayedOut, play_out

_STATES_A_DRAW = 1e5
"""The estimate of joint states up to which the rest of a draw is exact."""

_BATCHES = 40
_CELLS = 4_000_000
"""States times draws that are worked out at once."""


class Cut(NamedTuple):
    """A bracket cut in two.

    Parameters
    ----------
    early
        the matches and groups that are drawn.
    rest
        the later ones, as a bracket whose players are the slots that the early ones fill.
    entrants
        what fills each of these: a source or a player.
    """

    early: frozenset[str]
    rest: Bracket
    entrants: tuple[Slot, ...]


@dataclass
class Tally:
    """Who met in each match, counted over draws."""

    first: dict[str, Players]
    second: dict[str, Players]
    counts: dict[str, Floats] = field(default_factory=dict)
    ranks: dict[str, Floats] = field(default_factory=dict)
    draws: int = 0

    def meetings(self, chances: Chances) -> dict[str, Meeting]:
        """Return the meetings of all draws so far."""
        found = {}
        for name, count in self.counts.items():
            one, other = np.nonzero(count)
            first, second = self.first[name][one], self.second[name][other]
            p = chances.of(name)[first, second]
            found[name] = Meeting(first, second, count[one, other] / self.draws, p)
        return found

    def add(self, batch: Tally) -> None:
        """Add another tally of the same bracket."""
        self.draws += batch.draws
        for mine, others in ((self.counts, batch.counts), (self.ranks, batch.ranks)):
            for name, count in others.items():
                mine[name] = mine[name] + count if name in mine else count


def cut_bracket(bracket: Bracket, most_states: float = _STATES_A_DRAW) -> Cut:
    """Return the bracket cut as early as the work on its later part allows.

    It is cut by the number of matches that are still to come after a match, at most. Groups
    are always early.
    """
    to_come = _to_come(bracket)
    for height in range(max(to_come.values(), default=0) - 1, 0, -1):
        cut = _cut_at(bracket, to_come, height)
        if elimination_order(cut.rest).states <= most_states:
            return cut
    return _cut_at(bracket, to_come, 0)


def _to_come(bracket: Bracket) -> dict[str, int]:
    """Return for each match how many matches its players can still have, with it."""
    grouped = {name for group in bracket.groups for name in group.matches}
    longest: dict[str, int] = {}
    for match in reversed(bracket.matches):
        longest[match.name] = 1 + longest.get(match.name, 0)
        for slot in match.slots:
            if isinstance(slot, Source):
                longest[slot.match] = max(longest.get(slot.match, 0), longest[match.name])
    top = max(longest.values(), default=0) + 1
    return longest | dict.fromkeys([*grouped, *(group.name for group in bracket.groups)], top)


def _cut_at(bracket: Bracket, to_come: Mapping[str, int], height: int) -> Cut:
    early = frozenset(name for name, count in to_come.items() if count > height)
    number: dict[Slot, int] = {}

    def seat(slot: Slot) -> Slot:
        if (isinstance(slot, Source) and slot.match not in early) or slot == -1:
            return slot
        return number.setdefault(slot, len(number))

    later = tuple(
        replace(match, slots=(seat(match.slots[0]), seat(match.slots[1])))
        for match in bracket.matches
        if match.name not in early
    )
    rest = Bracket(bracket.format, tuple(map(str, range(len(number)))), later)
    return Cut(early, rest, tuple(number))


def drawn_tallies(
    bracket: Bracket, chances: Chances, draws: int, rng: np.random.Generator
) -> list[Tally]:
    """Return the tallies of batches of draws.

    Parameters
    ----------
    bracket
        the matches still to be played.
    chances
        their chances.
    draws
        how many draws in all.
    rng
        where pseudo-random numbers come from.
    """
    cut = cut_bracket(bracket)
    plan = plan_of(cut.rest)
    largest = max((step.size for step in plan.steps), default=1)
    batch = max(2, -(-draws // _BATCHES))
    at_once = max(1, min(batch, _CELLS // largest))
    first, second = who_can_sit(bracket)
    tallies = []
    for _ in range(_BATCHES):
        tally = Tally(first, second, draws=batch)
        played = play_out(bracket, chances, rng, batch, only=cut.early)
        _count_played(tally, bracket, played)
        for start in range(0, batch, at_once):
            rows = slice(start, min(batch, start + at_once))
            _count_rest(tally, cut, plan, chances, played, rows, len(bracket.players))
        tallies.append(tally)
    return tallies


def mean_and_error(laws: list[Floats]) -> tuple[Floats, Floats]:
    """Return the mean of batches and its standard error."""
    stacked = np.stack(laws)
    error: Floats = stacked.std(axis=0, ddof=1) / np.sqrt(len(laws))
    mean: Floats = stacked.mean(axis=0)
    return mean, error


def batch_law(
    whole: Bracket,
    tally: Tally,
    chances: Chances,
    so_far: Mapping[str, Meeting],
    ranks: Mapping[str, Floats],
) -> Floats:
    """Return the places of one batch."""
    mine = {name: count / tally.draws for name, count in tally.ranks.items()}
    return place_law(whole, {**so_far, **tally.meetings(chances)}, {**ranks, **mine})


def who_can_sit(bracket: Bracket) -> tuple[dict[str, Players], dict[str, Players]]:
    """Return the players who can sit in slot 1 and in slot 2 of each match, ascending."""
    sent: dict[str, int] = {group.name: 0 for group in bracket.groups}
    for group in bracket.groups:
        sent[group.name] = sum(1 << player for player in group.members)
    sides: tuple[dict[str, Players], dict[str, Players]] = ({}, {})
    for match in bracket.matches:
        masks = [_mask(slot, sent) for slot in match.slots]
        sent[match.name] = masks[0] | masks[1]
        for side, mask in zip(sides, masks, strict=True):
            there = [k for k in range(len(bracket.players)) if mask >> k & 1]
            side[match.name] = np.array(there, dtype=np.int16)
    return sides


def _mask(slot: Slot, sent: dict[str, int]) -> int:
    if isinstance(slot, Source):
        return sent[slot.match]
    return 1 << slot if slot >= 0 else 0


def _count_played(tally: Tally, bracket: Bracket, played: PlayedOut) -> None:
    ones = np.ones(tally.draws)
    for name, first in played.first.items():
        _count(tally, name, first, played.second[name], ones, len(bracket.players))
    for group in bracket.groups:
        order = played.order[group.name]
        tally.ranks[group.name] = np.array(
            [(order == player).sum(axis=0) for player in group.members], dtype=float
        )


def _count_rest(
    tally: Tally,
    cut: Cut,
    plan: Plan,
    chances: Chances,
    played: PlayedOut,
    rows: slice,
    nobody: int,
) -> None:
    """Add the meetings of the later rounds, exact given what was drawn."""
    if not plan.steps:
        return
    many = rows.stop - rows.start
    who = np.array(
        [
            played.sent[slot][rows] if isinstance(slot, Source) else np.full(many, slot)
            for slot in cut.entrants
        ]
        + [np.full(many, nobody)]
    )
    tables: dict[int, Floats] = {}
    of_match: dict[str, Floats] = {}
    for match in cut.rest.matches:
        table = chances.of(match.name)
        if id(table) not in tables:
            tables[id(table)] = table[who[:, None, :], who[None, :, :]]
        of_match[match.name] = tables[id(table)]
    through: Flow = flow(plan, Chances(of_match))
    for step in plan.steps:
        if isinstance(step, MatchStep):
            meet = np.broadcast_to(
                through.meet[step.name].reshape(len(step.first), -1), (len(step.first), many)
            )
            first, second = who[step.first].ravel(), who[step.second].ravel()
            _count(tally, step.name, first, second, meet.ravel(), nobody)


def _count(
    tally: Tally,
    name: str,
    first: NDArray[np.integer],
    second: NDArray[np.integer],
    weight: Floats,
    nobody: int,
) -> None:
    shape = len(tally.first[name]) + 1, len(tally.second[name]) + 1
    seats = []
    for players in (tally.first[name], tally.second[name]):
        seat = np.full(nobody + 1, len(players))
        seat[players] = np.arange(len(players))
        seats.append(seat)
    cell = seats[0][first] * shape[1] + seats[1][second]
    counts = np.bincount(cell, weight, shape[0] * shape[1]).reshape(shape)[:-1, :-1]
    tally.counts[name] = tally.counts.get(name, 0.0) + counts


