"""Odds from sampling the first rounds; each sample's later rounds are exact.

Averages of exact conditional odds have a smaller variance than simulating everything
(Rao-Blackwell). Two more things reduce the variance: a batch's samples are stratified over each
match's luck (a Latin hypercube), and the first rounds' exact chances correct for samples in which
someone wins too often (control variates). All samples share one plan, so thousands of them take
seconds. Standard errors come from the differences between batches.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats
from evenbreak.tournaments.brackets.bracket import Bracket, GoesOn, Place, Slot, Source
from evenbreak.tournaments.brackets.standing import Standing
from evenbreak.tournaments.odds.chances import Chances, of_samples
from evenbreak.tournaments.odds.cut import Cut, cut_before, exact_starts
from evenbreak.tournaments.odds.passes import ForwardPass, forward_pass
from evenbreak.tournaments.odds.plan import MatchStep, Plan, Players
from evenbreak.tournaments.odds.planning import plan_of
from evenbreak.tournaments.odds.play import PlayedOut, play_out
from evenbreak.tournaments.odds.rematches import (
    Meeting,
    add_places,
    group_meetings,
    place_odds,
    plan_meetings,
)

_STATES_PER_SAMPLE = 1e5
"""The largest estimate of joint states for one sample's later rounds."""

_BATCHES = 40  # of samples

_CELLS = 80_000
"""The largest number of states times samples processed at once."""


class SampledOdds(NamedTuple):
    """Odds for the matches still to be played, without the places already taken.

    `p_place` is P(each place) for each player, `error` its standard errors.
    """

    p_place: Floats
    error: Floats
    meetings: dict[str, Meeting]
    samples: int


@dataclass
class _Batch:
    """One batch: the places in each sample, and the meetings in each match."""

    places: Floats
    counts: dict[str, Floats] = field(default_factory=dict)


def sampled_odds(
    now: Standing, chances: Chances, samples: int, rng: np.random.Generator
) -> SampledOdds:
    """Return the odds for the matches still to be played, from at least this many samples."""
    bracket = now.remaining
    sampler = _Sampler(now, bracket, chances, cut_before(bracket, _STATES_PER_SAMPLE))
    controls = controls_of(now, bracket, sampler.cut.early, chances)
    size = max(2, -(-samples // _BATCHES))
    counts: dict[str, Floats] = {}
    for _ in range(_BATCHES):
        played = play_out(bracket, chances, rng, size, only=sampler.cut.early)
        batch = sampler.batch(played, size)
        controls.add(played, batch.places)
        for name, count in batch.counts.items():
            counts[name] = counts.get(name, 0.0) + count
    mean, error = controls.estimate()
    shape = len(bracket.players), len(sampler.column)
    meetings = sampler.meetings(counts, size * _BATCHES)
    return SampledOdds(mean.reshape(shape), error.reshape(shape), meetings, size * _BATCHES)


def places_of_samples(
    now: Standing, tables: Chances, samples: int, rounds: int, rng: np.random.Generator
) -> Floats:
    """Return P(each place) for each player in each sample, shape (players, places, samples).

    The chances' third axis is the samples; each sample's first rounds are simulated `rounds` times,
    and the places are averaged.
    """
    bracket = now.remaining
    cut = cut_before(bracket, _STATES_PER_SAMPLE)
    sampler = _Sampler(now, bracket, tables, cut)
    total: Floats | float = 0.0
    for _ in range(rounds):
        played = play_out(bracket, tables, rng, samples, only=cut.early)
        total = total + sampler.batch(played, samples).places
    places: Floats = np.asarray(total).reshape(samples, len(bracket.players), -1) / rounds
    return places.transpose(1, 2, 0)


class _Sampler:
    """What all batches share."""

    def __init__(
        self,
        now: Standing,
        bracket: Bracket,
        chances: Chances,
        cut: Cut,
    ) -> None:
        self.bracket, self.chances, self.cut = bracket, chances, cut
        self.column = {place: k for k, place in enumerate(now.bracket.places)}
        self.going = now.bracket.going
        self.plan: Plan = plan_of(cut.rest)
        self.first, self.second = who_can_sit(bracket)
        self.nobody = len(bracket.players)
        largest = max((step.size for step in self.plan.steps), default=1)
        self.at_once = max(1, _CELLS // largest)

    def batch(self, played: PlayedOut, size: int) -> _Batch:
        """Return a batch, given its first rounds' results."""
        batch = _Batch(np.zeros((size, self.nobody + 1, len(self.column))))
        self._early(batch, played, size)
        for start in range(0, size, self.at_once):
            if self.plan.steps:
                self._rest(batch, played, slice(start, min(size, start + self.at_once)))
        batch.places = batch.places[:, :-1].reshape(size, -1)
        return batch

    def meetings(self, counts: Mapping[str, Floats], samples: int) -> dict[str, Meeting]:
        """Return all samples' meetings."""
        found = {}
        for name, count in counts.items():
            one, other = np.nonzero(count)
            first, second = self.first[name][one], self.second[name][other]
            p = self.chances.of(name)[first, second]
            found[name] = Meeting(first, second, count[one, other] / samples, p)
        return found

    def _early(self, batch: _Batch, played: PlayedOut, size: int) -> None:
        ones, rows = np.ones(size), np.arange(size)
        grouped = {name for group in self.bracket.groups for name in group.matches}
        for name, first in played.first.items():
            second = played.second[name]
            self._count(batch, name, first, second, ones)
            if name not in grouped:
                match, won = self.bracket.by_name[name], played.first_won[name]
                places = match.winner_place, match.loser_place
                for k, players in early_places(self.going[name], places, first, second, won):
                    batch.places[rows, players, self.column[k]] = 1.0
        for group in self.bracket.groups:
            for rank, place in enumerate(group.places[: len(group.members)]):
                if place is not None:
                    who = played.order[group.name][:, rank]
                    batch.places[rows, who, self.column[place]] = 1.0
        runners_up = self.bracket.runners_up
        for rank, place in enumerate(runners_up.places if runners_up else ()):
            if runners_up and place is not None:
                who = played.order[runners_up.name][:, rank]
                batch.places[rows, who, self.column[place]] = 1.0

    def _rest(self, batch: _Batch, played: PlayedOut, rows: slice) -> None:
        """Add the later rounds, which are exact given the first."""
        many = rows.stop - rows.start
        who = np.full((len(self.cut.entrants) + 1, many), self.nobody)
        for k, slot in enumerate(self.cut.entrants):
            who[k] = played.sent[slot][rows] if isinstance(slot, Source) else slot
        through: ForwardPass = forward_pass(self.plan, self._tables(who, rows))
        shares = np.zeros((len(who), len(self.column), many))
        for step in self.plan.steps:
            if isinstance(step, MatchStep):
                shape = len(step.first), many
                meet = np.broadcast_to(through.meet[step.name].reshape(shape[0], -1), shape)
                first, second = who[step.first].ravel(), who[step.second].ravel()
                self._count(batch, step.name, first, second, meet.ravel())
                match, going = self.bracket.by_name[step.name], self.going[step.name]
                meeting = Meeting(step.first, step.second, meet, through.first_wins[step.name])
                add_places(shares, self.column, match, going, meeting)
        samples = np.arange(rows.start, rows.stop)
        for k, players in enumerate(who[:-1]):
            batch.places[samples, players] += shares[k].T

    def _tables(self, who: NDArray[np.int64], rows: slice) -> Chances:
        """Return the chances for these samples' entrants."""
        made: dict[int, Floats] = {}
        tables: dict[str, Floats] = {}
        for match in self.cut.rest.matches:
            table = self.chances.of(match.name)
            if id(table) not in made:
                made[id(table)] = of_samples(
                    table[..., rows] if table.ndim == 3 else table, who[:, None, :], who[None, :, :]
                )
            tables[match.name] = made[id(table)]
        return Chances(tables)

    def _count(
        self,
        batch: _Batch,
        name: str,
        first: NDArray[np.integer],
        second: NDArray[np.integer],
        weight: Floats,
    ) -> None:
        seats = []
        for players in (self.first[name], self.second[name]):
            seat = np.full(self.nobody + 1, len(players))
            seat[players] = np.arange(len(players))
            seats.append(seat)
        shape = len(self.first[name]) + 1, len(self.second[name]) + 1
        cell = seats[0][first] * shape[1] + seats[1][second]
        counts = np.bincount(cell, weight, shape[0] * shape[1]).astype(float, copy=False)
        counts = counts.reshape(shape)[:-1, :-1]
        before = batch.counts.get(name)
        batch.counts[name] = counts if before is None else before + counts


def early_places(
    going: GoesOn,
    places: tuple[Place | None, Place | None],
    first: Players,
    second: Players,
    won: NDArray[np.bool_],
) -> list[tuple[Place, Players]]:
    """Return each sample's place and the player who takes it; -1 if no one does."""
    found = []
    ends = zip(places, (going.winner, going.loser), (won, ~won), strict=True)
    for place, on, sat_in_1 in ends:
        if place is not None and not all(on):
            stays = np.where(sat_in_1, not on[0], not on[1])
            who = np.where(sat_in_1, first, second)
            found.append((place, np.where(stays, who, -1).astype(np.int16)))
    return found


def who_can_sit(bracket: Bracket) -> tuple[dict[str, Players], dict[str, Players]]:
    """Return the players who can be in slot 1 and in slot 2 of each match, ascending."""
    sent = {group.name: sum(1 << player for player in group.members) for group in bracket.groups}
    if bracket.runners_up:
        settled = sum(1 << player for _, player, _ in bracket.runners_up.settled)
        sent[bracket.runners_up.name] = sum(sent.values()) | settled
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


# Control variates: what is known exactly of the first rounds corrects what was drawn.
#
# Y is what a draw says of the places, X which player came to which slot in it. The mean of
# X is known exactly, so the mean of Y is estimated by that of Y - b (X - E X), with b from
# the regression of Y on X. It is linear: what adds up to 1 in each draw still does.
#
# P. Glasserman (2003), *Monte Carlo methods in financial engineering*, section 4.1.


_STATES = 1e6
_MOST_CONTROLS = 600


@dataclass
class Controls:
    """The sums needed for the regression, batch by batch.

    `slots` are those whose player is a control, and who can get there; `cells` are the places
    (columns of Y) that are controls themselves; `expected` is each control's exact mean.
    """

    slots: Mapping[Source, NDArray[np.int64]]
    cells: NDArray[np.int64]
    expected: Floats
    batches: list[tuple[Floats, Floats]] = field(default_factory=list)
    samples: int = 0
    squares: Floats | float = 0.0
    products: Floats | float = 0.0

    def add(self, played: PlayedOut, places: Floats) -> None:
        """Add a batch of samples: how their first rounds went, and the resulting places."""
        columns = [places[:, self.cells]]
        for slot, players in self.slots.items():
            columns.append(np.equal.outer(played.sent[slot], players).astype(float))
        x = np.concatenate(columns, axis=1) - self.expected
        self.batches.append((x.mean(axis=0), places.mean(axis=0)))
        self.samples += len(places)
        self.squares += x.T @ x
        self.products += x.T @ places

    def estimate(self) -> tuple[Floats, Floats]:
        """Return the places' means and standard errors."""
        x, y = (np.stack(part) for part in zip(*self.batches, strict=True))
        if self.expected.size:
            centered = self.squares - self.samples * np.outer(x.mean(axis=0), x.mean(axis=0))
            joint = self.products - self.samples * np.outer(x.mean(axis=0), y.mean(axis=0))
            # x times the slope; the other way around the solver would need a copy of `joint`.
            weights, rank = slope_of(centered, x.T, self.samples)
            y = y - weights.T @ joint
            # Controls explain some of the noise by chance.
            spread = 1.0 / np.sqrt(max(1.0 - rank / self.samples, 0.1))
        else:
            spread = 1.0
        error: Floats = spread * y.std(axis=0, ddof=1) / np.sqrt(len(y))
        mean: Floats = np.clip(y.mean(axis=0), 0.0, 1.0)
        return mean, error


def slope_of(centered: Floats, joint: Floats, samples: int) -> tuple[Floats, int]:
    """Return the regression of Y on the controls X, and how many of these add information.

    Controls that repeat others, or never vary, do no harm: the columns are scaled, and the
    regression is solved with the eigenvectors of their correlations. Other threads continue
    meanwhile, whereas scipy's `lstsq` would stop them all, for half a second on a busy computer.
    `centered` and `joint` are the sums of squares and products of X - mean X with itself, and with
    Y - mean Y.
    """
    squares = np.diag(centered)
    varies = squares > 1e-12 * samples
    scale = np.sqrt(squares[varies])
    inner = centered[np.ix_(varies, varies)] / np.outer(scale, scale)
    values, vectors = np.linalg.eigh(inner)
    kept = values > 1e-9 * values.max(initial=0.0)
    vectors = vectors[:, kept] / scale[:, None]
    slope = np.zeros_like(joint)
    slope[varies] = vectors @ ((vectors.T @ joint[varies]) / values[kept, None])
    return slope, int(kept.sum())


def controls_of(
    now: Standing, bracket: Bracket, early: frozenset[str], chances: Chances
) -> Controls:
    """Return the controls for samples of a bracket's early matches.

    They record who reaches which slot, and who takes which place, in as many of the early rounds as
    can be calculated exactly.
    """
    for start in exact_starts(bracket, early, _STATES):
        plan = plan_of(start)
        through = forward_pass(plan, chances)
        meetings = plan_meetings(plan, through) | group_meetings(start, chances)
        law = place_odds(now.bracket, meetings, through.ranks)
        cells = np.flatnonzero(_settled(now.bracket, start, law))
        slots, expected = {}, [law.ravel()[cells]]
        for slot in _leading_out(bracket, start):
            come = _coming(slot, meetings, through.ranks, start)
            players = np.flatnonzero((come > 0.0) & (come < 1.0))
            if len(players):
                slots[slot] = players
                expected.append(come[players])
        if sum(map(len, expected)) <= _MOST_CONTROLS:
            return Controls(slots, cells, np.concatenate(expected))
    return Controls({}, np.empty(0, dtype=np.int64), np.empty(0))


def _settled(whole: Bracket, start: Bracket, law: Floats) -> NDArray[np.bool_]:
    """Return which chances of places are open, yet decided by the early rounds alone."""
    inside = {match.name for match in start.matches}
    late = {
        place
        for match in whole.matches
        for place in (match.winner_place, match.loser_place)
        if match.name not in inside
    }
    early = np.array([place not in late for place in whole.places])
    return np.asarray(early & (law > 0.0) & (law < 1.0))


def _leading_out(bracket: Bracket, start: Bracket) -> list[Source]:
    inside = {*start.by_name, *(group.name for group in start.groups)}
    return [
        slot
        for match in bracket.matches
        for slot in match.slots
        if isinstance(slot, Source) and slot.match in inside and match.name not in inside
    ]


def _coming(
    slot: Source, meetings: Mapping[str, Meeting], ranks: Mapping[str, Floats], start: Bracket
) -> Floats:
    """Return P(each player reaches a slot)."""
    law = np.zeros(len(start.players))
    for group in start.groups:
        if group.name == slot.match:
            law[list(group.members)] = ranks[group.name][:, int(slot.outcome) - 1]
            return law
    meeting = meetings[slot.match]
    won = meeting.probability * meeting.first_wins
    lost = meeting.probability - won
    mass = (won, lost) if slot.outcome == "winner" else (lost, won)
    for side, players in enumerate((meeting.first, meeting.second)):
        if slot.via in (None, side + 1):
            law += np.bincount(players, mass[side], len(law))
    return law
