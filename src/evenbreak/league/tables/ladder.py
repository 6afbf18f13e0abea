"""Who is ahead of whom in a table, for one ending of a season or many at once.

Everything is a sum over matches, so the order of the rows never matters.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats, Ints
from evenbreak.league.tables.rules import (
    DIFFERENCE,
    FORFEITS,
    HEAD_TO_HEAD,
    POINTS,
    SCORED,
    WIN_SHARE,
    WINS,
    Outcomes,
    TableRules,
)

_FINE = 100.0  # points are compared to a hundredth


@dataclass(frozen=True, eq=False)
class Record:
    """Input of a ladder: the matches played, and the remaining ones with many endings at once.

    `start` is points in addition to those from matches; `counted` is for which side a match counts:
    both, or 1 and 0 in a table of home matches. `kinds` are how a match can end, and `ends` the
    kind of each match in each ending of the season, shape (matches, endings).
    """

    sides: int
    rules: TableRules
    pairs: Ints
    outcomes: Outcomes
    start: Floats
    counted: tuple[int, int] = (1, 1)
    to_come: Ints = field(default_factory=lambda: np.zeros((0, 2), dtype=np.int64))
    kinds: Outcomes = field(default_factory=lambda: Outcomes([]))
    ends: Ints = field(default_factory=lambda: np.zeros((0, 1), dtype=np.int64))

    def total(self, gains: Callable[[Outcomes], NDArray[Any]]) -> Ints:
        """Return sums of each match's contributions to both sides, shape (sides, endings)."""
        now = np.zeros(self.sides, dtype=np.int64)
        np.add.at(now, self.pairs, gains(self.outcomes) * np.array(self.counted))
        total = np.repeat(now[:, None], self.ends.shape[1], axis=1)
        gain = np.asarray(gains(self.kinds), dtype=np.int64)
        for (home, away), end in zip(self.to_come.tolist(), self.ends, strict=True):
            total[home] += gain[end, 0]
            total[away] += gain[end, 1]
        return total

    def points(self, outcomes: Outcomes) -> Ints:
        """Return the points from matches, in hundredths."""
        return np.round(self.rules.points_of(outcomes) * _FINE).astype(np.int64)

    def values(self, rule: str, code: Ints) -> Ints:
        """Return the values that a rule compares, higher is better; `code` tells who is tied."""
        if rule == HEAD_TO_HEAD:
            return self._among_the_level(code)
        if rule == WIN_SHARE:
            twice = self.total(lambda of: 1 + of.won - 1 * of.won[:, ::-1])
            most = np.maximum(2 * self.total(lambda of: np.ones(of.score.shape, dtype=np.int64)), 1)
            # Quotients of small numbers are equal as floats exactly where they are equal.
            return np.unique(twice / most, return_inverse=True)[1].reshape(twice.shape)
        if rule == POINTS:
            return self.total(self.points) + np.round(self.start * _FINE).astype(np.int64)[:, None]
        return self.total(_GAINS[rule])

    def _among_the_level(self, code: Ints) -> Ints:
        """Return a number for the points from meetings between tied sides, recursively."""
        sides, endings = code.shape
        if (np.diff(np.sort(code, axis=0), axis=0) > 0).all():
            return np.zeros_like(code)
        found = np.empty_like(code)
        own, kinds = self.points(self.outcomes), self.points(self.kinds)
        one, other = self.pairs.T
        now = np.zeros((sides, sides), dtype=np.int64)
        np.add.at(now, (one, other), own[:, 0])
        np.add.at(now, (other, one), own[:, 1])
        meetings = np.zeros((sides, sides), dtype=np.int64)
        both = np.vstack([self.pairs, self.to_come])
        np.add.at(meetings, (both, both[:, ::-1]), 1)
        step = max(1, (1 << 20) // sides**2)
        for first in range(0, endings, step):
            part = slice(first, first + step)
            ends = self.ends[:, part]
            met = np.repeat(now[None], ends.shape[1], axis=0)
            for (home, away), end in zip(self.to_come.tolist(), ends, strict=True):
                met[:, home, away] += kinds[end, 0]
                met[:, away, home] += kinds[end, 1]
            found[:, part] = -by_meetings(met, _ahead(code[:, part].T), meetings).T
        return found


_GAINS: dict[str, Callable[[Outcomes], NDArray[Any]]] = {
    WINS: lambda of: of.won,
    SCORED: lambda of: of.score,
    DIFFERENCE: lambda of: of.score - of.score[:, ::-1],
    FORFEITS: lambda of: -1 * (of.won[:, ::-1] & of.forfeit[:, None]),
}


def ladder(record: Record) -> Iterator[tuple[str, Ints]]:
    """Yield each rule with a number for each side and ending, larger for the side that is ahead.

    Sides that no rule so far separates have equal numbers.
    """
    code = np.zeros((record.sides, record.ends.shape[1]), dtype=np.int64)
    for rule in record.rules.ladder:
        value = record.values(rule, code)
        low, high = int(value.min(initial=0)), int(value.max(initial=0))
        code = _dense(code) * (high - low + 1) + (value - low)
        yield rule, code


def ranks_of(record: Record) -> Ints:
    """Return a number for each side and ending that is larger for the side that is ahead.

    >>> met = Record(3, TableRules(ties=("head-to-head",)), np.array([[0, 1], [1, 2], [2, 0]]),
    ...              Outcomes([[3, 2], [3, 2], [3, 2]]), np.zeros(3))
    >>> len(set(ranks_of(met).ravel().tolist()))  # all beat one another: level for good
    1
    """
    *_, (_, code) = ladder(record)
    return code


def _dense(code: Ints) -> Ints:
    """Return smaller numbers in the same order, so that products fit in 64 bits."""
    if code.size and int(code.max()) - int(code.min()) < 1 << 30:
        return np.asarray(code - code.min())
    return np.asarray(np.unique(code, return_inverse=True)[1]).reshape(code.shape)


def by_meetings(
    met: NDArray[Any], ahead: NDArray[Any], meetings: Ints | None = None
) -> NDArray[Any]:
    """Return how many sides are ahead of each, after ranking ties by their meetings.

    Tied sides are ranked by what they won against each other, met[..., i, j] for i; those still
    tied are ranked by what they won against each other, and so on until nothing changes. `meetings`
    is how often each pair met: tied sides are ranked only if all of them met each other equally
    often, which may not be so in the middle of a season. None: they did.
    """
    while True:
        level = ahead[..., :, None] == ahead[..., None, :]
        counted = level if meetings is None else level & _equally_often(meetings, level)
        among = np.where(counted, met, 0).sum(axis=-1, dtype=met.dtype)
        more = _ahead(among, level)
        if not more.any():
            return ahead
        ahead = ahead + more


def _ahead(score: NDArray[Any], compared: NDArray[np.bool_] | bool = True) -> NDArray[Any]:
    better = score[..., None, :] > score[..., :, None]
    counted: NDArray[Any] = (better & compared).sum(axis=-1, dtype=score.dtype)
    return counted


def _equally_often(meetings: Ints, level: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return who is tied only with sides that all met each other equally often."""
    others = level & ~np.eye(len(meetings), dtype=bool)
    most = np.where(others, meetings, -1).max(axis=-1)
    least = np.where(others, meetings, 1 << 30).min(axis=-1)
    group_most = np.where(level, most[..., None, :], -1).max(axis=-1)
    group_least = np.where(level, least[..., None, :], 1 << 30).min(axis=-1)
    return np.asarray((group_most == group_least)[..., None])


def places_by_wins(beats: NDArray[np.int16]) -> NDArray[np.int16]:
    """Return how many players are ahead of each in a round robin: by wins, then by meetings.

    beats[..., i, j] is how often i beat j.

    >>> places_by_wins(np.array([[0, 1, 1], [0, 0, 1], [0, 0, 0]], dtype=np.int16)).tolist()
    [0, 1, 2]
    """
    return by_meetings(beats, _ahead(beats.sum(axis=-1, dtype=np.int16)))


class Standings(NamedTuple):
    """How many sides are ahead of each side in each ending, shapes (sides, endings).

    `level` is the number that no rule separates from it, itself included; lots decide among them.
    """

    ahead: Ints
    level: Ints

    def places(self, weights: Floats) -> Floats:
        """Return the weight with which each side takes each place: shape (sides, places).

        >>> standings_of(np.array([[5], [5], [9]])).places(np.ones(1)).tolist()
        [[0.0, 0.5, 0.5], [0.0, 0.5, 0.5], [1.0, 0.0, 0.0]]
        """
        sides = len(self.ahead)
        found = np.zeros((sides, sides))
        wide = sides + 1
        for side, (ahead, level) in enumerate(zip(self.ahead, self.level, strict=True)):
            both = np.bincount(ahead * wide + level, weights, minlength=sides * wide)
            for at in np.flatnonzero(both):
                first, many = divmod(int(at), wide)
                found[side, first : first + many] += both[at] / many
        return found

    def share_of(self, places: int) -> Floats:
        """Return each side's chance of finishing in the first places: 0, 1, or by lot.

        >>> standings_of(np.array([[5], [5], [9]])).share_of(2).ravel().tolist()
        [0.5, 0.5, 1.0]
        """
        return np.asarray(np.clip((places - self.ahead) / self.level, 0.0, 1.0))


def standings_of(ranks: Ints) -> Standings:
    """Return who is ahead of whom, from numbers such as those of `ranks_of`."""
    sides, endings = ranks.shape
    order = np.argsort(ranks, axis=0)
    ordered = np.take_along_axis(ranks, order, axis=0)
    new = np.ones((sides, endings), dtype=bool)
    new[1:] = ordered[1:] != ordered[:-1]
    steps = np.arange(sides)[:, None]
    first = np.maximum.accumulate(np.where(new, steps, 0), axis=0)
    last = np.ones((sides, endings), dtype=bool)
    last[:-1] = new[1:]
    end = np.minimum.accumulate(np.where(last, steps, sides)[::-1], axis=0)[::-1]
    ahead, level = np.empty_like(order), np.empty_like(order)
    np.put_along_axis(ahead, order, sides - 1 - end, axis=0)
    np.put_along_axis(level, order, end - first + 1, axis=0)
    return Standings(ahead, level)
