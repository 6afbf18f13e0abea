"""A plan: the joint states of open slots at each match, and where each result leads.

A plan depends on the bracket and the results so far, but not on the chances of the matches,
so one plan serves many samples of the ratings.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array

from evenbreak.arrays import Floats, frozen
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Source

_FEW = 2_000  # states, which take less time together than in parts

Players: TypeAlias = NDArray[np.int16]
Index: TypeAlias = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Branch:
    """The states in which one slot can win (None: all), and the next state for each."""

    rows: Index | None
    to: Index


@dataclass(frozen=True, eq=False)
class Apart:
    """A branch of a match whose parts are summed before they are joined.

    `winner` and `loser` say which of their slot's players wins or loses in each state of that part;
    `kept` is the sparse matrix that sums states of the loser's part that become one without the
    loser.
    """

    winner: Index
    loser: Index
    kept: csc_array


@dataclass(frozen=True, eq=False)
class MatchStep:
    """One match. Its states are all pairs of states from the parts of the bracket that it joins.

    `joins` has the numbers of the earlier steps whose open slots it joins, at most two, with
    `sizes` states each. `first` and `second` are the distinct pairs of players who can meet; `pair`
    is each state's pair, or None if states and pairs are the same. `size`, `slots` and `columns`
    are the states after the match, the open slots, and the player in each of these by state.
    """

    name: str
    joins: tuple[int, ...]
    sizes: tuple[int, ...]
    first: Players
    second: Players
    pair: Index | None
    branches: tuple[Branch, Branch]
    size: int
    slots: tuple[Source, ...]
    columns: tuple[Players, ...]

    @cached_property
    def scatter(self) -> tuple[csr_array, csr_array]:
        """The two branches as sparse matrices from states before to states after."""
        one, other = (by_rows(adding_up(branch.to, self.size)) for branch in self.branches)
        return one, other

    @cached_property
    def meeting(self) -> csr_array | None:
        """The sparse matrix that sums states by pair; None if states and pairs are the same."""
        return None if self.pair is None else by_rows(adding_up(self.pair, len(self.first)))

    @cached_property
    def apart(self) -> tuple[Apart, Apart] | None:
        """The two branches by the parts that the match joins; None if that saves nothing.

        When a loser is out, some states of their part no longer differ. These are summed, for each
        winner, before the parts are joined.
        """
        if len(self.sizes) < 2 or self.pair is None or len(self.pair) < _FEW:
            return None
        if not self.open:
            return None
        ones, others = self.sizes
        one, other = (branch.to.reshape(self.sizes) for branch in self.branches)
        of_other, of_one = _kept(one[0]), _kept(other[:, 0])
        first = np.arange(ones)[:, None] * (of_other.max() + 1) + of_other
        second = first[-1, -1] + 1 + of_one[:, None] * others + np.arange(others)
        if not (np.array_equal(one, first) and np.array_equal(other, second)):
            return None
        many = len(np.unique(self.second))  # all pairs are possible, slot 1's player first
        seats = self.pair[::others] // many, self.pair[:others] % many
        return (
            Apart(seats[0], seats[1], adding_up(of_other, int(of_other.max()) + 1)),
            Apart(seats[1], seats[0], adding_up(of_one, int(of_one.max()) + 1)),
        )

    @cached_property
    def distinct(self) -> bool:
        """Whether every state and result leads to a distinct state after the match."""
        return self.open and self.size == 2 * math.prod(self.sizes)

    @property
    def open(self) -> bool:
        """Whether either player can win in every state."""
        return all(branch.rows is None for branch in self.branches)


@dataclass(frozen=True, eq=False)
class GroupStep:
    """One group: who has each qualifying rank, counting from 0.

    `pairs` are positions in the group; size, slots and columns are as for a match.
    """

    group: Group
    pairs: tuple[tuple[int, int], ...]
    ranks: tuple[int, ...]
    size: int
    slots: tuple[Source, ...]
    columns: tuple[Players, ...]

    joins: tuple[int, ...] = ()

    @property
    def name(self) -> str:
        """The group's name."""
        return self.group.name


Step: TypeAlias = MatchStep | GroupStep


@dataclass(frozen=True, eq=False)
class Plan:
    """The steps, in processing order."""

    bracket: Bracket
    steps: tuple[Step, ...]

    @cached_property
    def pairs(self) -> dict[str, tuple[NDArray[np.bool_] | None, Players, Players]]:
        """For each match, the pairs that consist of two players: which (None: all), and who."""
        nobody, found = len(self.bracket.players), {}
        for step in self.steps:
            if isinstance(step, MatchStep):
                there = (step.first < nobody) & (step.second < nobody)
                first, second = frozen(step.first[there]), frozen(step.second[there])
                found[step.name] = None if there.all() else there, first, second
        return found

    @property
    def states(self) -> int:
        """The total number of states in all steps."""
        return sum(step.size for step in self.steps)

    @property
    def numbers(self) -> int:
        """About how many numbers it holds; these take up most of its memory."""
        held = [one.size * len(one.slots) for one in self.steps]
        for one in self.steps:
            if isinstance(one, MatchStep):
                held += [2 * len(branch.to) for branch in one.branches]
                held += [] if one.pair is None else [2 * len(one.pair)]
        return sum(held)


def _kept(to: Index) -> Index:
    """Return which states lead to the same state, as numbers from 0 up."""
    return np.unique(to, return_inverse=True)[1].astype(np.int32)


def adding_up(index: Index, size: int) -> csc_array:
    """Return the sparse matrix that sums rows with the same index."""
    ones, starts = _ones_and_starts(len(index))
    return csc_array((ones, index, starts), shape=(size, len(index)))


def by_rows(sums: csc_array) -> csr_array:
    """Return a matrix from `adding_up` in the form that multiplies fastest."""
    rows = sums.tocsr()
    rows.data = sums.data  # ones all the same, which all such matrices share
    return rows


_SHARED = [(np.ones(0), np.arange(1, dtype=np.int32))]
"""Ones, and 0, 1, 2, ...: all such matrices share a prefix of these."""


def _ones_and_starts(count: int) -> tuple[Floats, Index]:
    if len(_SHARED[0][0]) < count:
        many = 2 * count
        _SHARED[0] = np.ones(many), np.arange(many + 1, dtype=np.int32)
    ones, starts = _SHARED[0]
    return ones[:count], starts[: count + 1]
