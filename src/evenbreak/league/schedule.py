"""Who meets whom in which week.

A schedule answers `pairs(week, rng, count)`: a week's rounds, each of which is two arrays of equal
length with the positions of the players who meet. In a round a player occurs at most once, so that
all ratings of a round can move at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.arrays import Ints, Places, own_arrays
from evenbreak.checks import whole, whole_numbers
from evenbreak.errors import InputError

Round = tuple[Places, Places]
"""Who meets whom at one time: two arrays of positions, no position twice."""

_FEW = 5000
"""Number of players below which shuffling all is faster than drawing half of them."""


class Schedule(Protocol):
    """The interface of every schedule."""

    def pairs(self, week: int, rng: np.random.Generator, count: int) -> Sequence[Round]:
        """Return a week's rounds (1 is the first week) for `count` players."""


@dataclass(frozen=True)
class RoundRobin:
    """Repeated round robin: everyone meets everyone once before any two meet again.

    With an odd number of players, one of them has a bye in each round.

    Parameters
    ----------
    players
        number of players, two or more.
    matches_a_week
        matches per player and week.

    Raises
    ------
    InputError
        if a number is too small; `pairs` raises it if the league has a different number of players.

    Notes
    -----
    The circle method: one player stays in place, and the others move on by one place each round.

    >>> league = RoundRobin(4)
    >>> rng = np.random.default_rng(1)
    >>> [[(a.tolist(), b.tolist()) for a, b in league.pairs(week, rng, 4)] for week in (1, 2, 3)]
    [[([0, 1], [3, 2])], [([0, 2], [1, 3])], [([0, 3], [2, 1])]]
    """

    players: int
    matches_a_week: int = 1

    def __post_init__(self) -> None:
        object.__setattr__(self, "players", whole(self.players, "players", at_least=2))
        matches = whole(self.matches_a_week, "matches_a_week", at_least=1)
        object.__setattr__(self, "matches_a_week", matches)

    def pairs(self, week: int, rng: np.random.Generator, count: int) -> list[Round]:  # noqa: ARG002
        """Return a week's rounds (1 is the first week); nothing is drawn."""
        if count != self.players:
            raise InputError(
                "{players} is {value}, but the league has {count} players. Give "
                "RoundRobin({count}).",
                value=self.players,
                count=count,
            )
        first = (week - 1) * self.matches_a_week
        return [self._round(first + k) for k in range(self.matches_a_week)]

    def _round(self, number: int) -> Round:
        seats = self.players + self.players % 2
        circle = np.arange(seats)
        turned = number % (seats - 1)
        circle[1:] = np.roll(circle[1:], -turned)
        a, b = circle[: seats // 2], circle[: seats // 2 - 1 : -1]
        if seats == self.players:
            return a, b
        there = (a < self.players) & (b < self.players)  # the last seat is empty: a bye
        return a[there], b[there]


@dataclass(frozen=True)
class RandomPairing:
    """Random opponents, drawn for each round; with an odd number of players, one sits out.

    Parameters
    ----------
    matches_a_week
        matches per player and week.

    >>> (a, b), = RandomPairing().pairs(1, np.random.default_rng(1), 5)
    >>> len(a), len({*a.tolist(), *b.tolist()})
    (2, 4)
    """

    matches_a_week: int = 1

    def __post_init__(self) -> None:
        matches = whole(self.matches_a_week, "matches_a_week", at_least=1)
        object.__setattr__(self, "matches_a_week", matches)

    def pairs(self, week: int, rng: np.random.Generator, count: int) -> list[Round]:  # noqa: ARG002
        """Return a week's rounds, drawn from `rng`."""
        return [_matched(rng, count) for _ in range(self.matches_a_week)]

    def many_pairs(
        self, rng: np.random.Generator, count: int, times: int
    ) -> list[tuple[Places, Places]]:
        """Return a week's rounds for many leagues of equal size, with a row for each league.

        >>> (a, b), = RandomPairing().many_pairs(np.random.default_rng(1), 6, 2)
        >>> np.sort(np.hstack([a, b])).tolist()
        [[0, 1, 2, 3, 4, 5], [0, 1, 2, 3, 4, 5]]
        """
        half = count // 2
        seats = np.broadcast_to(np.arange(count), (times, count))
        drawn = [rng.permuted(seats, axis=1) for _ in range(self.matches_a_week)]
        return [(order[:, :half], order[:, half : 2 * half]) for order in drawn]


@own_arrays
@dataclass(frozen=True, eq=False)
class FixedSchedule:
    """Schedule from a list of matches, each in its week, in list order.

    Parameters
    ----------
    week
        the week of each match, from 1.
    a, b
        positions of the two players.

    Raises
    ------
    InputError
        if the columns differ in length, hold something other than weeks and positions, or have a
        player meet themselves; `pairs` raises it if a position is beyond the last player.

    >>> fixtures = FixedSchedule([1, 1, 3], [0, 0, 1], [1, 2, 2])
    >>> [(a.tolist(), b.tolist()) for a, b in fixtures.pairs(1, np.random.default_rng(1), 3)]
    [([0], [1]), ([0], [2])]
    >>> fixtures.weeks, len(fixtures), fixtures.pairs(2, np.random.default_rng(1), 3)
    (3, 3, [])
    """

    week: Ints = field(repr=False)
    a: Ints = field(repr=False)
    b: Ints = field(repr=False)

    def __init__(self, week: ArrayLike, a: ArrayLike, b: ArrayLike) -> None:
        for name, column, least in (("week", week, 1), ("a", a, 0), ("b", b, 0)):
            object.__setattr__(self, name, _whole_column(column, name, least))
        if not len(self.week) == len(self.a) == len(self.b):
            raise InputError(
                "week, a and b have {n_week}, {n_a} and {n_b} values. Give one of each "
                "for every match.",
                n_week=len(self.week),
                n_a=len(self.a),
                n_b=len(self.b),
            )
        if (self.a == self.b).any():
            row = int(np.argmax(self.a == self.b))
            raise InputError(
                "match {row} has player {a} twice. Give two different players.",
                row=row,
                a=self.a[row],
            )

    def __len__(self) -> int:
        return len(self.week)

    @property
    def weeks(self) -> int:
        """The last week that has a match; 0 if there are no matches."""
        return int(self.week.max(initial=0))

    def pairs(self, week: int, rng: np.random.Generator, count: int) -> list[Round]:  # noqa: ARG002
        """Return a week's rounds, of which there may be none."""
        most = int(max(self.a.max(initial=-1), self.b.max(initial=-1)))
        if most >= count:
            raise InputError(
                "the schedule has matches for player {most}, but the league has only players 0 "
                "to {count}. Leave out those matches, or add the player.",
                most=most,
                count=count - 1,
            )
        return self._rounds.get(week, [])

    @cached_property
    def _rounds(self) -> dict[int, list[Round]]:
        rows = np.argsort(self.week, kind="stable")
        weeks, starts = np.unique(self.week[rows], return_index=True)
        parts = np.split(rows, starts[1:])[: len(weeks)]  # no rows would make one part
        return {
            week: rounds_of(self.a[part], self.b[part])
            for week, part in zip(weeks.tolist(), parts, strict=True)
        }


def _matched(rng: np.random.Generator, count: int) -> Round:
    """Return a round, with all pairings of `count` players equally likely.

    If there are many players, half of them are drawn, in random order, and the others meet them in
    their own order. That is half the work of shuffling all.
    """
    half = count // 2
    if count < _FEW:
        order = rng.permutation(count)
        return order[:half], order[half : 2 * half]
    drawn = rng.choice(count, count - half, replace=False)
    left = np.ones(count, dtype=bool)
    left[drawn] = False
    return np.flatnonzero(left), drawn[:half]  # of an odd number the last one drawn sits out


def rounds_of(a: NDArray[Any], b: NDArray[Any]) -> list[Round]:
    """Return matches as rounds in which each player occurs at most once.

    Each match comes as early as possible without overtaking an earlier match of its players.

    >>> [(a.tolist(), b.tolist()) for a, b in rounds_of(np.array([0, 0, 2]), np.array([1, 2, 3]))]
    [([0], [1]), ([0], [2]), ([2], [3])]
    """
    free: dict[int, int] = {}
    place = np.zeros(len(a), dtype=np.intp)
    for row, (player, opponent) in enumerate(zip(a.tolist(), b.tolist(), strict=True)):
        place[row] = max(free.get(player, 0), free.get(opponent, 0))
        free[player] = free[opponent] = int(place[row]) + 1
    rounds = [np.flatnonzero(place == k) for k in range(int(place.max(initial=-1)) + 1)]
    return [(a[rows].astype(np.intp), b[rows].astype(np.intp)) for rows in rounds]


def _whole_column(values: ArrayLike, name: str, least: int) -> Ints:
    numbers = whole_numbers(values, name, at_least=least)
    if numbers.ndim != 1:
        raise InputError(
            "{name} must have one whole number for each match; its shape is {numbers_shape}",
            name=name,
            numbers_shape=numbers.shape,
        )
    column = numbers.astype(np.int64)
    column.flags.writeable = False
    return column
