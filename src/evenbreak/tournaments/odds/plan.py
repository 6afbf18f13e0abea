"""The joint states of open slots, worked out once: everything but the chances.

A plan says for each match which states its slots' joint law has, which two players meet in
each, and to which state a win of either leads. It depends on the bracket and the results
so far, not on the chances, so that one plan serves many draws of ratings.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from evenbreak.tournaments.brackets.bracket import Bracket, Group, Source

Players: TypeAlias = NDArray[np.int16]
Index: TypeAlias = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Branch:
    """What follows if the player in one of the slots wins.

    Parameters
    ----------
    rows
        the states in which they can win; None: all.
    to
        the state that follows each of them.
    """

    rows: Index | None
    to: Index


@dataclass(frozen=True, eq=False)
class MatchStep:
    """A match: its states are the pairs of states of the parts that it joins.

    Parameters
    ----------
    name
        the match.
    joins
        the steps whose open slots it joins, none, one or two.
    first, second
        the distinct pairs who can meet, slot 1's player and slot 2's.
    pair
        which of them meets in each state; None: state and pair are the same.
    branches
        what follows if slot 1's player wins, if slot 2's does.
    size
        how many states there are after it.
    slots
        the slots that are open after it, together with others' if it joined them.
    columns
        who sits in each of these slots, in each state.
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
        """The two branches as matrices that add up what arrives in each state after."""
        one, other = (adding_up(branch.to, self.size) for branch in self.branches)
        return one, other

    @cached_property
    def meeting(self) -> csc_array | None:
        """The matrix that adds up states of the same pair; None where there is nothing to add."""
        return None if self.pair is None else adding_up(self.pair, len(self.first))


@dataclass(frozen=True, eq=False)
class GroupStep:
    """A group: who has each rank that goes on.

    Parameters
    ----------
    group
        the group.
    pairs
        who meets in each of its matches, by seat in the group.
    ranks
        the ranks that go on, from 0 on.
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
    """The steps in their order."""

    bracket: Bracket
    steps: tuple[Step, ...]

    @property
    def states(self) -> int:
        """How many states all steps have together."""
        return sum(step.size for step in self.steps)


def adding_up(index: Index, size: int) -> csc_array:
    """Return the matrix that adds up rows with the same index."""
    count = len(index)
    return csc_array(
        (np.ones(count), index, np.arange(count + 1, dtype=np.int32)), shape=(size, count)
    )
