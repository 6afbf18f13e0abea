"""The arcs of a plain race as arrays, made without a Python loop over the states.

They are the same as those of `Race.moves`. The states are the scores, sorted by the number of racks
played, so every arc leads to a later state.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools
from evenbreak.game import ArcArrays
from evenbreak.games.breaks import BreakFormat
from evenbreak.games.match import Score
from evenbreak.games.rack import Rack


class ScoreStates(Sequence[tuple[int, ...]]):
    """The states (a, b) or (a, b, breaker) of a race, made only when they are read.

    a and b are the score in each cell; a state's position is its cell, or 2 cell + breaker - 1 with
    breakers.
    """

    def __init__(
        self, a: NDArray[Any], b: NDArray[Any], place: NDArray[Any], *, with_breaker: bool
    ) -> None:
        self._cells = a, b
        self._place = place
        self._with_breaker = with_breaker

    @cached_property
    def _columns(self) -> list[NDArray[Any]]:
        cell, late = np.divmod(self._place, 2) if self._with_breaker else (self._place, None)
        columns = [column[cell] for column in self._cells]
        return columns if late is None else [*columns, late + 1]

    def __repr__(self) -> str:
        """Return the number of states, and the first one.

        >>> ScoreStates(*np.divmod(np.arange(9), 3), np.arange(9), with_breaker=False)
        <9 states: (0, 0), (0, 1), (0, 2), ...>
        """
        shown = ", ".join(map(repr, self[:3])) + ", ..." * (len(self) > 3)
        return f"<{len(self):,} state{'s' * (len(self) != 1)}: {shown}>"

    def __len__(self) -> int:
        return self._place.size

    def __iter__(self) -> Iterator[tuple[int, ...]]:
        return zip(*(column.tolist() for column in self._columns), strict=True)

    def __contains__(self, state: object) -> bool:
        try:
            self.index(state)
        except ValueError:
            return False
        return True

    def __getitem__(self, key: Any) -> Any:
        """Return one state, or a list of them for a slice."""
        if isinstance(key, slice):
            return list(zip(*(column[key].tolist() for column in self._columns), strict=True))
        return tuple(int(column[key]) for column in self._columns)

    def index(self, value: Any, start: int = 0, stop: int | None = None) -> int:
        """Return the position of a state; raise ValueError if there is no such state."""
        if isinstance(value, tuple) and len(value) == len(self._columns):
            here = np.ones(len(self), dtype=bool)
            for column, entry in zip(self._columns, value, strict=True):
                here &= column == entry
            places = np.flatnonzero(here[start:stop])
            if places.size:
                return int(places[0]) + start
        raise ValueError(f"{value!r} isn't a state")


def race_arcs(
    need: Score, rack: Rack, breaks: BreakFormat | None, first_breaker: int, score: Score
) -> ArcArrays:
    """Return the states and arcs of the race to `need` from `score`, won by one game.

    The states that can be reached are sorted by racks played, the arcs by source, each with the
    probability of its target, given the source. Raises InputError if the rack holds arrays.
    """
    breakers = (1, 2) if rack.break_matters else (1,)
    count = len(breakers)
    a, b, after_loss = _cells(need[0] - score[0], need[1] - score[1])
    on = np.flatnonzero((a < need[0] - score[0]) & (b < need[1] - score[1])).astype(a.dtype)
    # One row for each state, one column for each winner. Player 2's win comes first: after
    # one more rack the smaller score of player 1 comes first, so the arcs are sorted.
    targets = np.empty((on.size, count, 2), dtype=on.dtype)
    chances = np.empty((count, 2))
    for j, breaker in enumerate(breakers):
        for k, winner in enumerate((2, 1)):
            nxt = breaks(breaker, winner) if breaks and rack.break_matters else 1
            targets[:, j, k] = after_loss[on] * count + (k * count + nxt - 1)
            chances[j, k] = rack.of_numbers().chance(winner, breaker)
    reached, sources, targets, probabilities = _reached(
        a.size * count,
        (on[:, None] * count + np.arange(count, dtype=on.dtype)).ravel(),
        targets.reshape(-1, 2),
        np.tile(chances, (on.size, 1)),
        start=first_breaker - 1 if rack.break_matters else 0,
    )
    states = ScoreStates(
        a + score[0], b + score[1], np.flatnonzero(reached), with_breaker=rack.break_matters
    )
    return ArcArrays(states, sources, targets, probabilities)


def _cells(m: int, n: int) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Return the scores a, b of a race m:n from 0:0, sorted by a + b, then by a.

    The third array is the position of (a, b+1); the position of (a+1, b) is the next one. Neither
    is meaningful if the race is over.
    """
    index_type = np.int32 if 2 * (m + 1) * (n + 1) < 2**31 else np.int64
    if m == 0 or n == 0:  # over before it begins
        zero = np.zeros(1, dtype=index_type)
        return zero, zero, zero
    racks = np.arange(m + n + 1, dtype=index_type)
    least = np.maximum(racks - n, 0)  # the smallest a on each diagonal
    length = np.minimum(racks, m) - least + 1
    offset = np.cumsum(length, dtype=index_type) - length - least  # position less a
    # The last diagonal holds only the score at which both would have won.
    racks, length, step = racks[:-1], length[:-1], np.diff(offset)
    place = np.arange(length.sum(), dtype=index_type)
    a = place - np.repeat(offset[:-1], length)
    return a, np.repeat(racks, length) - a, place + np.repeat(step, length)


def _reached(
    size: int,
    sources: NDArray[Any],
    targets: NDArray[Any],
    probabilities: NDArray[Any],
    start: int,
) -> tuple[Bools, NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Return which states can be reached, and the arcs between them by their new positions.

    The other first breaker cannot be reached, nor can a breaker that the format never chooses.
    Row k of `targets` and `probabilities` holds the two arcs out of state `sources[k]`.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import breadth_first_order

    possible = probabilities > 0.0
    ends = np.zeros(size + 1, dtype=sources.dtype)
    ends[sources + 1] = np.add(*possible.T, dtype=sources.dtype)
    graph = csr_array(
        (probabilities[possible], targets[possible], np.cumsum(ends, out=ends)), shape=(size, size)
    )
    reached = np.zeros(size, dtype=bool)
    reached[breadth_first_order(graph, start, return_predecessors=False)] = True
    new = np.cumsum(reached, dtype=sources.dtype) - 1
    # Flat masks: numpy picks single entries ten times as fast as rows of two.
    kept = (possible & reached[sources][:, np.newaxis]).ravel()
    return (
        reached,
        new[np.repeat(sources, 2)[kept]],
        new[targets.ravel()[kept]],
        probabilities.ravel()[kept],
    )
