"""Control variates: what is known exactly of the first rounds corrects what was drawn.

Y is what a draw says of the places, X which player came to which slot in it. The mean of
X is known exactly, so the mean of Y is estimated by that of Y - b (X - E X), with b from
the regression of Y on X. It is linear: what adds up to 1 in each draw still does.

P. Glasserman (2003), *Monte Carlo methods in financial engineering*, section 4.1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats
from evenbreak.tournaments.brackets.bracket import Bracket, Source
from evenbreak.tournaments.brackets.standing import Standing
from evenbreak.tournaments.odds.chances import Chances
from evenbreak.tournaments.odds.cut import exact_starts
from evenbreak.tournaments.odds.forward import forward_pass
from evenbreak.tournaments.odds.meetings import (
    Meeting,
    group_meetings,
    place_odds,
    plan_meetings,
)
from evenbreak.tournaments.odds.planning import plan_of
from evenbreak.tournaments.odds.play import PlayedOut

_STATES = 1e6
_MOST_CONTROLS = 600


@dataclass
class Controls:
    """The sums that the regression needs, batch by batch.

    Parameters
    ----------
    slots
        the slots whose player is a control, and who can come to each.
    cells
        the places (columns of Y) that are controls themselves.
    expected
        the exact mean of each control.
    """

    slots: Mapping[Source, NDArray[np.int64]]
    cells: NDArray[np.int64]
    expected: Floats
    batches: list[tuple[Floats, Floats]] = field(default_factory=list)
    samples: int = 0
    squares: Floats | float = 0.0
    products: Floats | float = 0.0

    def add(self, played: PlayedOut, places: Floats) -> None:
        """Add a batch of samples: how their first rounds went, and what each says of the places."""
        columns = [places[:, self.cells]]
        for slot, players in self.slots.items():
            columns.append(np.equal.outer(played.sent[slot], players).astype(float))
        x = np.concatenate(columns, axis=1) - self.expected
        self.batches.append((x.mean(axis=0), places.mean(axis=0)))
        self.samples += len(places)
        self.squares = self.squares + x.T @ x
        self.products = self.products + x.T @ places

    def estimate(self) -> tuple[Floats, Floats]:
        """Return the mean of the places and its standard error."""
        x, y = (np.stack(part) for part in zip(*self.batches, strict=True))
        if self.expected.size:
            centred = self.squares - self.samples * np.outer(x.mean(axis=0), x.mean(axis=0))
            joint = self.products - self.samples * np.outer(x.mean(axis=0), y.mean(axis=0))
            slope, _, rank, _ = np.linalg.lstsq(centred, joint, rcond=1e-9)
            y = y - x @ slope
            # Controls explain some of the noise by chance.
            spread = 1.0 / np.sqrt(max(1.0 - int(rank) / self.samples, 0.1))
        else:
            spread = 1.0
        error: Floats = spread * y.std(axis=0, ddof=1) / np.sqrt(len(y))
        mean: Floats = np.clip(y.mean(axis=0), 0.0, 1.0)
        return mean, error


def controls_of(
    now: Standing, bracket: Bracket, early: frozenset[str], chances: Chances
) -> Controls:
    """Return the controls for samples of the early matches of a bracket.

    They are who comes to which slot, and who leaves for which place, in as many of the early
    rounds as can be calculated exactly.

    Parameters
    ----------
    now
        where the tournament stands.
    bracket, early
        the matches still to be played, and those of them that are drawn.
    chances
        the chances of the matches.
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
    """Return for each player and place whether it is open and the start alone decides it."""
    inside = {match.name for match in start.matches}
    late = {
        place
        for match in whole.matches
        for place in (match.winner_place, match.loser_place)
        if match.name not in inside
    }
    early = np.array([place not in late for place in whole.places])
    settled: NDArray[np.bool_] = early & (law > 0.0) & (law < 1.0)
    return settled


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
    """Return P(each player comes to a slot)."""
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
