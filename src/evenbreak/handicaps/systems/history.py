"""What a handicap system sees: the initial list, and all matches played so far.

Many leagues are simulated at a time, so arrays have players or matches as rows and replicas of the
league as columns. A single league from a file is one column.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, MutableMapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints

ESTABLISHED = 1_000_000
"""Matches or games assumed for a player if the list does not state them."""

NOBODY = -1
"""The position that stands for both players of a match that was not played."""

_STATE = TypeVar("_STATE")


@dataclass(frozen=True, eq=False)
class Entries:
    """The players as listed before the first night; NaN (or -1 games) where not stated.

    Shape (players,) or (players, replicas).

    >>> Entries.of([612.0, np.nan]).matches
    array([-1, -1])
    """

    rating: Floats
    level: Floats
    matches: Ints
    games: Ints

    @classmethod
    def of(
        cls, rating: Any = None, level: Any = None, matches: Any = None, games: Any = None
    ) -> Entries:
        """Return entries from the columns that a list has; the others are marked as not stated."""
        shape = np.shape(next(x for x in (rating, level, matches, games) if x is not None))
        columns = [
            np.full(shape, missing) if column is None else np.array(column, dtype=kind)
            for column, missing, kind in (
                (rating, np.nan, float),
                (level, np.nan, float),
                (matches, -1, np.int64),
                (games, -1, np.int64),
            )
        ]
        return cls(*columns)


@dataclass(frozen=True, eq=False)
class Matches:
    """Matches in the order in which they were played, one per row, with replicas as columns.

    Nights count from 1 and never decrease, shape (matches,). Players are positions, -1 for both
    where the match was not played. The winner reached their race; if the race is unknown (0), the
    higher score wins. Ratings (or levels) are those published then; innings, minus defensive shots,
    are None if not counted.
    """

    night: Ints
    a: Ints
    b: Ints
    score_a: Ints
    score_b: Ints
    race_a: Ints
    race_b: Ints
    rating_a: Floats
    rating_b: Floats
    innings_a: Ints | None = None
    innings_b: Ints | None = None

    @classmethod
    def of_night(cls, night: int, *columns: Any) -> Matches:
        """Return one night's matches, in order, from the other columns."""
        arrays = [None if column is None else np.asarray(column) for column in columns]
        first: Any = arrays[0]
        return cls(np.full(len(first), night, dtype=np.int64), *arrays)  # type: ignore[arg-type]

    def __len__(self) -> int:
        return len(self.night)

    def __getitem__(self, rows: Any) -> Matches:
        return self._each(lambda column: column[rows])

    def _each(self, view: Callable[[Any], Any]) -> Matches:
        values = {name: value for name, value in vars(self).items() if value is not None}
        return replace(self, **{name: view(value) for name, value in values.items()})

    @property
    def played(self) -> Bools:
        """Which matches took place."""
        return np.asarray(self.a >= 0)

    @property
    def won_a(self) -> Bools:
        """Which matches player a won; False where none was played."""
        known = (self.race_a > 0) & (self.race_b > 0)
        by_race = (self.score_a >= self.race_a) & (self.score_b < self.race_b)
        return np.where(known, by_race, self.score_a > self.score_b) & self.played

    def games_played(self) -> Ints:
        """Return how many games each match lasted."""
        return np.asarray(self.score_a + self.score_b)

    def nights(self) -> Iterator[Matches]:
        """Yield the matches of each night that has any, in order."""
        edges = np.flatnonzero(np.diff(self.night)) + 1
        for start, end in pairwise([0, *edges.tolist(), len(self)]):
            if end > start:
                yield self[start:end]

    def turned(self) -> Matches:
        """Return the same matches seen from player b."""
        pairs = ("score", "race", "rating", "innings")
        swapped: dict[str, Any] = {"a": self.b, "b": self.a}
        for name in pairs:
            swapped[f"{name}_a"] = getattr(self, f"{name}_b")
            swapped[f"{name}_b"] = getattr(self, f"{name}_a")
        return replace(self, **swapped)


def joined(nights: Sequence[Matches]) -> Matches:
    """Return the matches of several nights, one night after the other."""
    columns = {
        name: np.concatenate([getattr(night, name) for night in nights])
        for name, value in vars(nights[0]).items()
        if value is not None
    }
    return Matches(**columns)


@dataclass(frozen=True, eq=False)
class History:
    """All matches up to and including a night, and the numbers published before it.

    `initial` was published before the first night, and `ratings` before the update: shape (players,
    replicas), or (players,) for one league. Nights count from 1 and may have no matches; `day`
    counts days from the first night; None: nights are a week apart. `kept` is where a system may
    keep sums between updates, private to the system and the run; it must also work from the matches
    alone.
    """

    entries: Entries
    initial: Floats
    ratings: Floats
    night: int
    matches: Matches
    days: Floats | None = None
    kept: MutableMapping[str, Any] = field(default_factory=dict)

    @property
    def players(self) -> int:
        """The number of players."""
        return len(self.initial)

    @property
    def tonight(self) -> Matches:
        """The matches on the last night."""
        return self.matches[np.searchsorted(self.matches.night, self.night) :]

    @property
    def day(self) -> Floats:
        """Days from the first night to that of each match, shape (matches,)."""
        nights = self.matches.night
        days = 7.0 * np.arange(self.night) if self.days is None else np.asarray(self.days)
        return np.asarray(days[nights - 1], dtype=float)

    @property
    def matches_before(self) -> Ints:
        """How many matches each player had played before the last night.

        If the list does not state them, it is a million, or none for a player about whom the list
        states nothing.
        """
        unknown = np.isnan(self.entries.rating) & np.isnan(self.entries.level)
        usual = column_of(np.where(unknown, 0, ESTABLISHED), self.initial.shape)
        stated = column_of(self.entries.matches, self.initial.shape)
        tonight = np.zeros(self.initial.size)
        for who in (self.tonight.a, self.tonight.b):
            place = positions(who, self.initial.shape)[self.tonight.played]
            tonight += np.bincount(place, minlength=tonight.size)
        so_far = self.counts("matches", lambda _: 1) - tonight.reshape(self.initial.shape)
        before: Ints = np.where(stated < 0, usual, stated) + so_far.astype(np.int64)
        return before

    def one(self, replica: int) -> History:
        """Return one replica's history: arrays without an axis for replicas."""

        def column(values: Any) -> Any:
            return values[:, min(replica, values.shape[1] - 1)] if np.ndim(values) > 1 else values

        return replace(
            self,
            entries=Entries(*(column(values) for values in vars(self.entries).values())),
            initial=column(self.initial),
            ratings=column(self.ratings),
            matches=self.matches._each(column),  # noqa: SLF001
            kept=self.kept.setdefault(f"replica {replica}", {}),
        )

    def fold(
        self, name: str, start: Callable[[], _STATE], add: Callable[[_STATE, Matches], _STATE]
    ) -> _STATE:
        """Return the accumulated state of all nights, from `add(state, a night's matches)`.

        Only nights that are new since the last update are added to the state in `kept`, so `add`
        must depend on the matches alone.

        >>> night = Matches.of_night(1, [0], [1], [5], [3], [5], [4], [620.0], [560.0])
        >>> begun = np.array([620.0, 560.0])
        >>> history = History(Entries.of(begun), begun, begun, 1, night)
        >>> history.fold("matches", lambda: 0, lambda many, night: many + len(night))
        1
        """
        done, state = self.kept[name] if name in self.kept else (0, start())
        for matches in self.matches[done:].nights():
            state = add(state, matches)
        self.kept[name] = len(self.matches), state
        total: _STATE = state
        return total

    def counts(self, name: str, of_a: Callable[[Matches], Any]) -> Floats:
        """Return a sum over each player's matches, shaped like `initial`, and keep it by name.

        `of_a` returns what player a adds; it is called again for the other side.
        """

        def add(sums: Floats, matches: Matches) -> Floats:
            for side in (matches, matches.turned()):
                place = positions(side.a, self.initial.shape)
                added = np.broadcast_to(of_a(side), side.a.shape)
                weights = np.where(side.played, added, 0.0).ravel()
                sums += np.bincount(place.ravel(), weights, sums.size).reshape(sums.shape)
            return sums

        return self.fold(name, lambda: np.zeros(self.initial.shape), add).copy()

    def last(self, most: int, name: str, of_a: Callable[[Matches], Any]) -> Floats:
        """Return each player's last scores, newest first, padded with NaN.

        As for `counts`, the shape is (most,) followed by that of `initial`; NaN scores are left
        out.
        """
        size = self.initial.size

        def add(state: tuple[Floats, Ints], matches: Matches) -> tuple[Floats, Ints]:
            scores, count = state
            sides = [(side.a, np.broadcast_to(of_a(side), side.a.shape)) for side in
                     (matches, matches.turned())]  # fmt: skip
            for row in range(len(matches)):
                for who, values in sides:
                    place = np.atleast_1d(positions(who, self.initial.shape)[row])
                    value = np.atleast_1d(values[row]).astype(float)
                    kept = np.atleast_1d(who[row] >= 0) & ~np.isnan(value)
                    place = place[kept]
                    scores[count[place] % most, place] = value[kept]
                    count[place] += 1
            return scores, count

        def start() -> tuple[Floats, Ints]:
            return np.full((most, size), np.nan), np.zeros(size, dtype=np.int64)

        scores, count = self.fold(name, start, add)
        turn = (count - 1 - np.arange(most)[:, None]) % most
        newest = np.take_along_axis(scores, turn, axis=0)
        return newest.reshape(most, *self.initial.shape)


def column_of(values: Any, shape: tuple[int, ...]) -> Any:
    """Return values expanded from a column to an entry for each player and replica.

    >>> column_of([3, 5], (2, 4)).shape
    (2, 4)
    """
    array = np.asarray(values)
    extra = (None,) * (len(shape) - array.ndim)
    return np.broadcast_to(array[(..., *extra)], shape)


def positions(who: Ints, shape: tuple[int, ...]) -> Ints:
    """Return the flat positions of players in an array of players and replicas; 0 for no one.

    >>> positions(np.array([[1, 0]]), (2, 2))
    array([[2, 1]])
    """
    first: Ints = np.maximum(who, 0)
    return first * shape[1] + np.arange(shape[1]) if len(shape) > 1 else first
