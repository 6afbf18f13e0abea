"""Tournaments simulated with pseudo-random numbers, many at once."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats
from evenbreak.league.tables.ladder import places_by_wins
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Slot, Source
from evenbreak.tournaments.odds.chances import Chances
from evenbreak.tournaments.odds.plan import Players


@dataclass(frozen=True, eq=False)
class PlayedOut:
    """Many runs of a tournament, or of its first matches.

    The number of players means no one. `order` has, for each group, the players by rank, shape
    (runs, members), and so for the runners-up.
    """

    first: Mapping[str, Players]
    second: Mapping[str, Players]
    first_won: Mapping[str, NDArray[np.bool_]]
    sent: Mapping[Source, Players]
    order: Mapping[str, Players]


def play_out(
    bracket: Bracket,
    chances: Chances,
    rng: np.random.Generator,
    runs: int,
    *,
    only: Collection[str] | None = None,
    given: Mapping[str, NDArray[np.bool_]] | None = None,
) -> PlayedOut:
    """Simulate a bracket `runs` times.

    Each match's pseudo-random numbers are spread evenly over the runs (a Latin hypercube): one in
    each of `runs` equal parts of 0 to 1. They are drawn match by match, so that with the same seed,
    matches with the same name get the same luck whatever the chances are. Chances may have a third
    axis for runs; matches and groups in `only` come with everything that feeds them; `given` says
    whether slot 1's player wins in each run, if that is drawn elsewhere.

    M. D. McKay, R. J. Beckman, W. J. Conover (1979), "A comparison of three methods for selecting
    values of input variables", Technometrics 21.
    """
    nobody = len(bracket.players)
    first: dict[str, Players] = {}
    second: dict[str, Players] = {}
    first_won: dict[str, NDArray[np.bool_]] = {}
    sent: dict[Source, Players] = {}
    order: dict[str, Players] = {}

    def seated(slot: Slot) -> Players:
        if isinstance(slot, Source):
            return sent[slot]
        return np.full(runs, slot if slot >= 0 else nobody, dtype=np.int16)

    groups = _Groups(bracket, runs)

    def rank(after: str) -> None:
        """Advance players whose rank in a group, or among the runners-up, a match has decided."""
        for name, ordered in groups.ranked(after, first_won, rng):
            order[name] = ordered
            for slot in bracket.outlets.get(name, ()):
                sent[slot] = ordered[:, int(slot.outcome) - 1]

    rank("")
    for match in bracket.matches:
        luck = stratified_uniforms(rng, runs)
        if only is not None and match.name not in only:
            continue
        one, other = seated(match.slots[0]), seated(match.slots[1])
        if given is not None and match.name in given:
            won = given[match.name]
        else:
            won = luck < chances.each(match.name, one, other)
        first[match.name], second[match.name], first_won[match.name] = one, other, won
        for slot in bracket.outlets.get(match.name, ()):
            sent[slot] = _sent_on(slot, one, other, won, nobody)
        rank(match.name)
    return PlayedOut(first, second, first_won, sent, order)


def _sent_on(
    slot: Source, one: Players, other: Players, won: NDArray[np.bool_], nobody: int
) -> Players:
    """Return who goes from a match to a slot that is waiting for its winner or loser."""
    from_1 = won if slot.outcome == "winner" else ~won
    player = np.where(from_1, one, other)
    if slot.via is not None:
        player = np.where(from_1 == (slot.via == 1), player, nobody)
    return player.astype(np.int16)


def stratified_uniforms(rng: np.random.Generator, runs: int) -> Floats:
    """Return pseudo-random numbers from 0 to 1, one in each of `runs` equal parts, shuffled."""
    return np.asarray((rng.permutation(runs) + rng.random(runs)) / runs)


class _Groups:
    """The groups, and the runners-up from those that are over in each run."""

    def __init__(self, bracket: Bracket, runs: int) -> None:
        self.last = {group.matches[-1]: group for group in bracket.groups if group.matches}
        self.runners_up = bracket.runners_up
        settled = self.runners_up.settled if self.runners_up else ()
        self.who = [np.full(runs, player, dtype=np.int16) for _, player, _ in settled]
        self.share = [np.full(runs, share) for _, _, share in settled]

    def ranked(
        self, match: str, first_won: dict[str, NDArray[np.bool_]], rng: np.random.Generator
    ) -> Iterator[tuple[str, Players]]:
        """Yield the groups, and the overall runners-up, whose order a match has decided."""
        runners_up, group = self.runners_up, self.last.get(match)
        if group is not None:
            order, wins = _ordered(group, first_won, rng)
            yield group.name, order
            if runners_up is not None:
                weight = dict(runners_up.weights)[group.name]
                self.who.append(order[:, runners_up.rank - 1])
                self.share.append(wins[:, runners_up.rank - 1].astype(int) * weight)
        if runners_up is not None and len(self.who) == len(runners_up.weights):
            share = np.stack(self.share, axis=1)
            best_first = np.argsort(rng.random(share.shape) - share, axis=1)  # the rest by lot
            yield runners_up.name, np.take_along_axis(np.stack(self.who, axis=1), best_first, 1)
            self.runners_up = None


def _ordered(
    group: Group,
    first_won: dict[str, NDArray[np.bool_]],
    rng: np.random.Generator,
) -> tuple[Players, NDArray[np.int16]]:
    """Return a group's players in rank order, and their matches won."""
    seat = {player: k for k, player in enumerate(group.members)}
    runs = len(first_won[group.matches[0]])
    beats = np.zeros((runs, len(seat), len(seat)), dtype=np.int16)
    for name, pair in zip(group.matches, group.pairs, strict=True):
        one, other = seat[pair[0]], seat[pair[1]]
        beats[:, one, other] += first_won[name]
        beats[:, other, one] += ~first_won[name]
    lots = places_by_wins(beats) + rng.random((runs, len(seat)))
    members = np.array(group.members, dtype=np.int16)
    by_rank = np.argsort(lots, axis=1)
    wins = np.take_along_axis(beats.sum(axis=2, dtype=np.int16), by_rank, axis=1)
    return members[by_rank], wins
