"""What is counted while a chunk is played, and how it becomes a tally."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.league.tally import FIFTHS, WEEK_COLUMNS, Tally, fifths_of

if TYPE_CHECKING:
    from evenbreak.league.season import Season

__all__ = ["Counting", "Ended"]

_DOUBLINGS = 4.0
"""How far rating errors and moves are told apart: odds of 16 to 1."""

_BINS = 128
"""Gaps of skill that are told apart at most."""

_LARGE = 1 << 20
"""Entries of a table of players that is not kept."""

_BLOCK = 1 << 16
"""Ratings that are counted at a time, so that they stay in the cache."""


_LOWEST = 1 << 15
"""The least whole number of 16 bits with a sign, read without it."""


class Ended(NamedTuple):
    """The arrays that a chunk ends with, players down: one column, or one for each replica."""

    rating: NDArray[Any]
    wins: NDArray[Any]
    games: NDArray[Any] | None
    matches: NDArray[Any]
    skill: NDArray[Any]


class Counting:
    """Counts of a chunk while it is played."""

    def __init__(self, season: Season, replicas: int) -> None:
        self.season, self.replicas, self.look = season, replicas, season.lookup
        look = self.look
        rows = 2 * look.gap + 1
        self.cells = np.zeros(rows * look.width * 2, dtype=np.int64)
        self.widest = round(_DOUBLINGS * season.system.scale.points_per_doubling)
        self.errors = np.zeros((season.weeks + 1, 2 * self.widest + 1), dtype=np.int64)
        self.codes = np.zeros((rows, look.codes), dtype=np.int64)

    def week(
        self,
        week: int,
        rating: NDArray[np.int16],
        skill: NDArray[np.int16],
        here: NDArray[np.bool_] | None,
    ) -> None:
        """Count the rating errors of those who are in the league (None: everybody)."""
        most = self.widest
        lowest = skill - np.int16(most)
        step = max(1, _BLOCK // rating.shape[1])
        for start in range(0, len(rating), step):
            some = slice(start, start + step)
            error = rating[some] - lowest[some]
            if here is not None:
                error = error[here[some]]
            # As unsigned numbers the errors below all bins come last.
            counted = np.bincount(error.view(np.uint16).ravel(), minlength=2 * most + 1)
            self.errors[week] += counted[: 2 * most + 1]
            if len(counted) == 2 * most + 1:
                continue
            self.errors[week, -1] += counted[2 * most + 1 : _LOWEST].sum()
            self.errors[week, 0] += counted[_LOWEST:].sum()

    def matches(self, cell: NDArray[np.intp], won: NDArray[np.bool_], played: Any) -> None:
        """Count matches by their place in the tables, which is even, and by who wins."""
        where = cell
        where += won
        np.add.at(self.cells, where.ravel() if played is None else where[played], 1)

    def scores(self, row: NDArray[Any], apart: NDArray[Any], score: Any, played: Any) -> None:
        """Count matches by skill difference and what is noted of their final score."""
        look = self.look
        place = (apart.astype(np.intp) + look.widest) * look.outcomes + score
        where = row * look.codes + look.code.take(place)
        np.add.at(self.codes.reshape(-1), where.ravel() if played is None else where[played], 1)

    def tally(self, ended: Ended) -> Tally:
        """Return the tally of the chunk."""
        known = None if ended.skill.shape[1] > 1 else self.season.fifths
        start = self.season.players.rating
        wins, games = ended.wins, ended.games
        moved = ended.rating - start[:, None].astype(np.int16)
        weeks = self._weeks()
        width = -(-(self.look.gap + 1) // _BINS)
        share = 1 if ended.matches.shape[1] > 1 else self.replicas
        return Tally(
            replicas=np.array([self.replicas]),
            matches=ended.matches.sum(axis=1, dtype=np.int64) * share,
            wins=wins.sum(axis=1, dtype=np.int64),
            wins_squared=_squares(wins),
            rating=moved.sum(axis=1, dtype=np.int64),
            rating_squared=_squares(moved),
            games=None if games is None else games.sum(axis=1, dtype=np.int64),
            wins_counts=_by_player(wins, int(wins.max(initial=0))),
            rating_counts=_by_player(
                np.clip(moved, -self.widest, self.widest) + self.widest, 2 * self.widest
            ),
            errors=self.errors,
            gap_width=width,
            gaps=self._gaps(width)[None],
            weeks=weeks[None],
            fifths=_by_fifth(ended, share, known)[None],
        )

    def _weeks(self) -> NDArray[np.float64]:
        values = np.arange(-self.widest, self.widest + 1)
        powers = values ** np.arange(len(WEEK_COLUMNS))[:, None]
        return (self.errors @ powers.T).astype(float)

    def _gaps(self, width: int) -> NDArray[np.float64]:
        look = self.look
        bins = look.gap // width + 1
        skill = np.arange(-look.gap, look.gap + 1)
        bin_of = np.abs(skill) // width

        def summed(row: NDArray[np.intp], *columns: NDArray[Any]) -> list[NDArray[np.float64]]:
            place = bin_of[row]
            return [np.asarray(np.bincount(place, column, bins), float) for column in columns]

        # Of millions of cells a chunk comes to few.
        lost, won = self.cells.reshape(-1, 2).T
        both = lost + won
        at = np.flatnonzero(both)
        row = at // look.width
        sign = np.sign(skill[row])
        stronger = (both[at] + sign * (won[at] - lost[at])) / 2.0
        sums = summed(row, both[at], stronger)
        if look.by_winner is None or self.season.play == "racks":
            noted = self.codes @ look.noted
            sums += summed(np.arange(len(skill)), *noted.T)
        else:
            sums += summed(row, *(look.expected[:, at] * both[at]))
        return np.column_stack(sums)


def _squares(values: NDArray[Any]) -> NDArray[np.int64]:
    """Return for each row the sum of its squares."""
    found = np.empty(len(values), dtype=np.int64)
    step = max(1, _BLOCK // values.shape[1])
    for start in range(0, len(values), step):
        some = values[start : start + step].astype(np.int64)
        found[start : start + step] = np.sum(some * some, axis=1)
    return found


def _by_player(values: NDArray[Any], most: int) -> NDArray[np.int64] | None:
    """Return how often each row holds 0, 1, ..., most; None where that is a large table."""
    many = most + 1
    if len(values) * many > _LARGE:
        return None
    place = values + (np.arange(len(values)) * many)[:, None]
    return np.bincount(place.ravel(), minlength=len(values) * many).reshape(-1, many)


def _by_fifth(ended: Ended, share: int, fifth: NDArray[np.int64] | None) -> NDArray[np.int64]:
    """Return matches and wins by fifth of true skill at the start."""
    found = np.zeros((FIFTHS, 2), dtype=np.int64)
    if fifth is None:
        fifth = fifths_of(ended.skill)
    for column, values, times in ((0, ended.matches, share), (1, ended.wins, 1)):
        if fifth.shape[1] == 1:
            by_player = values.sum(axis=1, dtype=np.int64) * times
            np.add.at(found[:, column], fifth[:, 0], by_player)
        else:
            # One column of matches stands for all replicas, and is counted in each of them.
            each = np.broadcast_to(values, fifth.shape).astype(np.int64)
            np.add.at(found[:, column], fifth.ravel(), each.ravel())
    return found
