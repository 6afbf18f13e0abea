"""A plan: the joint states of open slots at each match, and where each result leads.

A plan depends on the bracket and the results so far, but not on the chances of the matches,
so one plan serves many samples of the ratings.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from evenbreak.arrays import Floats
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Source

Players: TypeAlias = NDArray[np.int16]
Index: TypeAlias = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Branch:
    """What follows if the player in one of the two slots wins.

    Parameters
    ----------
    rows
        the states in which that player can win; None: all.
    to
        the next state for each of them.
    """

    rows: Index | None
    to: Index


@dataclass(frozen=True, eq=False)
class MatchStep:
    """One match. Its states are all pairs of states of the parts of the bracket that it joins.

    Parameters
    ----------
    name
        the match.
    joins
        the numbers of the steps before it whose open slots it joins: none, one or two.
    first, second
        the distinct pairs of players who can meet, by slot.
    pair
        the pair in each state; None if states and pairs are the same.
    branches
        what follows if slot 1's player wins, and if slot 2's player wins.
    size
        the number of states after the match.
    slots
        the open slots of this part of the bracket after the match.
    columns
        the player in each of these slots, for each state.
    """

    name: str
    joins: tuple[int, ...]
    first: Players
    second: Players
    pair: Index | None
    branches: tuple[Branch, Branch]
    size: int
    slots: tuple[Source, ...]
    columns: tuple[Players, ...]

    @cached_property
    def scatter(self) -> tuple[csc_array, csc_array]:
        """The two branches as sparse matrices from states before to states after."""
        one, other = (adding_up(branch.to, self.size) for branch in self.branches)
        return one, other

    @cached_property
    def meeting(self) -> csc_array | None:
        """The sparse matrix that sums states by pair; None if states and pairs are the same."""
        return None if self.pair is None else adding_up(self.pair, len(self.first))


@dataclass(frozen=True, eq=False)
class GroupStep:
    """One group: who has each qualifying rank.

    Parameters
    ----------
    group
        the group.
    pairs
        the two players of each match, by position in the group.
    ranks
        the qualifying ranks, from 0 on.
    size, slots, columns
        as for a match.
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
    """The steps, in the order in which they are processed."""

    bracket: Bracket
    steps: tuple[Step, ...]

    @property
    def states(self) -> int:
        """The number of states of all steps together."""
        return sum(step.size for step in self.steps)

    @property
    def numbers(self) -> int:
        """How many numbers it holds, about; they are most of its memory."""
        held = [one.size * len(one.slots) for one in self.steps]
        for one in self.steps:
            if isinstance(one, MatchStep):
                held += [2 * len(branch.to) for branch in one.branches]
                held += [] if one.pair is None else [2 * len(one.pair)]
        return sum(held)


def adding_up(index: Index, size: int) -> csc_array:
    """Return the sparse matrix that sums rows with the same index."""
    ones, starts = _ones_and_starts(len(index))
    return csc_array((ones, index, starts), shape=(size, len(index)))


_SHARED = [(np.ones(0), np.arange(1, dtype=np.int32))]
"""Ones, and 0, 1, 2, ...: of these all such matrices have the beginning."""


def _ones_and_starts(count: int) -> tuple[Floats, Index]:
    if len(_SHARED[0][0]) < count:
        many = 2 * count
        _SHARED[0] = np.ones(many), np.arange(many + 1, dtype=np.int32)
    ones, starts = _SHARED[0]
    return ones[:count], starts[: count + 1]
