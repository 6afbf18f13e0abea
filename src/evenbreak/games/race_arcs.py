"""The arcs of a plain race as arrays, so that no Python loop runs per state.

The law is that of `Race.moves`; only the making differs. The states lie on the grid
of scores, sorted by the number of racks played, so every arc leads to a later state.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.checks import one_of
from evenbreak.game import ArcArrays
from evenbreak.games.breaks import BreakFormat
from evenbreak.games.match import Score
from evenbreak.games.rack import Rack

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["ScoreStates", "race_arcs"]


class ScoreStates(Sequence[tuple[int, ...]]):
    """States (a, b) or (a, b, breaker) that are kept as columns and made when asked for.

    Parameters
    ----------
    columns
        one integer array for each entry of a state, all of one length.

    >>> states = ScoreStates(np.array([0, 0, 1]), np.array([0, 1, 0]))
    >>> states[-1], states.index((0, 1)), (2, 2) in states
    ((1, 0), 1, False)
    """

    def __init__(self, *columns: NDArray[np.integer[Any]]) -> None:
        self._columns = columns

    def __len__(self) -> int:
        return len(self._columns[0])

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
            return list(ScoreStates(*(column[key] for column in self._columns)))
        return tuple(int(column[key]) for column in self._columns)

    def index(self, value: Any, start: int = 0, stop: int | None = None) -> int:
        """Return the position of a state; ValueError if it is not here."""
        if isinstance(value, tuple) and len(value) == len(self._columns):
            here = np.ones(len(self), dtype=bool)
            for column, entry in zip(self._columns, value, strict=True):
                here &= column == entry
            found = np.flatnonzero(here[start:stop])
            if found.size:
                return int(found[0]) + start
        raise ValueError(f"{value!r} is not a state")


def race_arcs(
    need: Score, rack: Rack, breaks: BreakFormat | None, first_breaker: int, score: Score
) -> ArcArrays:
    """Return the states and arcs of the race to `need` from `score`, winning by one.

    Parameters
    ----------
    need
        the games that player 1 and player 2 need.
    rack, breaks, first_breaker, score
        as in `Race`.

    Returns
    -------
    ArcArrays
        the states that can be reached, sorted by racks played; the arcs sorted by
        source, each probability conditional on it.

    Raises
    ------
    InputError
        if the break format answers anything but 1 or 2.

    >>> from evenbreak.games import winner_breaks
    >>> arcs = race_arcs((1, 1), Rack(0.6, 0.5), winner_breaks, 2, (0, 0))
    >>> list(arcs.states), arcs.probabilities
    ([(0, 0, 2), (0, 1, 2), (1, 0, 1)], array([0.5, 0.5]))
    """
    breakers = (1, 2) if rack.break_matters else (1,)
    a, b, cell = _cells(need, score)
    on = np.flatnonzero((a < need[0]) & (b < need[1]))
    # One row a cell, one column for each breaker and winner. Player 2's win first: at
    # a+1 racks the smaller score of player 1 comes first, so the arcs come out sorted.
    targets = np.empty((on.size, len(breakers), 2), dtype=np.intp)
    chances = np.empty((len(breakers), 2))
    for j, breaker in enumerate(breakers):
        for k, winner in enumerate((2, 1)):
            nxt = breaks(breaker, winner) if breaks and rack.break_matters else 1
            one_of(nxt, "the next breaker by the break format", (1, 2))
            row, column = a[on] - score[0], b[on] - score[1]
            to = cell[row + 1, column] if winner == 1 else cell[row, column + 1]
            targets[:, j, k] = to * len(breakers) + (nxt - 1)
            chances[j, k] = rack.chance(winner, breaker)
    sources = (on[:, None] * len(breakers) + np.arange(len(breakers))).repeat(2)
    probabilities = np.broadcast_to(chances, targets.shape).ravel()
    possible = probabilities > 0.0
    columns = [np.repeat(a, len(breakers)), np.repeat(b, len(breakers))]
    if rack.break_matters:
        columns.append(np.tile(np.array(breakers), a.size))
    return _reached(
        columns,
        sources[possible],
        targets.ravel()[possible],
        probabilities[possible],
        start=first_breaker - 1 if rack.break_matters else 0,
    )


def _cells(need: Score, score: Score) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Return a and b of each score sorted by a + b, and the place of each score there."""
    rows, columns = need[0] - score[0] + 1, need[1] - score[1] + 1
    if rows == 1 or columns == 1:  # it is over before it begins
        rows = columns = 1
    played = np.add.outer(np.arange(rows), np.arange(columns)).ravel()
    order = np.argsort(played, kind="stable")
    cell = np.empty(played.size, dtype=np.intp)
    cell[order] = np.arange(played.size)
    # The last one is the score at which both have won.
    a, b = np.divmod(order[:-1] if order.size > 1 else order, columns)
    return a + score[0], b + score[1], cell.reshape(rows, columns)


def _reached(
    columns: list[NDArray[Any]],
    sources: NDArray[Any],
    targets: NDArray[Any],
    probabilities: NDArray[Any],
    start: int,
) -> ArcArrays:
    """Leave out what cannot be reached: the other first breaker, a breaker nobody becomes."""
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import breadth_first_order

    size = columns[0].size
    ends = np.cumsum(np.bincount(sources, minlength=size))
    graph = csr_array((probabilities, targets, np.concatenate([[0], ends])), shape=(size, size))
    reached = np.zeros(size, dtype=bool)
    reached[breadth_first_order(graph, start, return_predecessors=False)] = True
    if not reached.all():
        new = np.cumsum(reached) - 1
        kept = reached[sources]
        sources, targets = new[sources[kept]], new[targets[kept]]
        probabilities = probabilities[kept]
        columns = [column[reached] for column in columns]
    return ArcArrays(ScoreStates(*columns), sources, targets, probabilities)
