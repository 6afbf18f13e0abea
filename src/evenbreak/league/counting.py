"""What is counted while a chunk is played, and how it becomes a tally."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.league.tally import FIFTHS, GAP_COLUMNS, WEEK_COLUMNS, Tally

if TYPE_CHECKING:
    from evenbreak.league.season import Season

__all__ = ["Counting", "Ended"]

_DOUBLINGS = 4.0
"""How far rating errors and moves are told apart: odds of 16 to 1."""

_BINS = 128
"""Gaps of skill that are told apart at most."""

_LARGE = 1 << 22
"""Entries of a table of players that is not kept."""

_BLOCK = 1 << 16
"""Ratings that are counted at a time, so that they stay in the cache."""


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
        self, week: int, rating: NDArray[Any], skill: NDArray[Any], here: NDArray[np.bool_]
    ) -> None:
        """Count the rating errors of those who are in the league."""
        everybody = bool(here.all())
        step = max(1, _BLOCK // rating.shape[1])
        for start in range(0, len(rating), step):
            some = slice(start, start + step)
            error = rating[some] - skill[some]
            if not everybody:
                error = error[here[some]]
            np.clip(error, -self.widest, self.widest, out=error)
            error += self.widest
            self.errors[week] += np.bincount(error.ravel(), minlength=self.errors.shape[1])

    def matches(self, cell: NDArray[Any], won: NDArray[np.bool_], played: Any) -> None:
        """Count matches by their place in the tables and by who wins."""
        where = cell * 2
        where += won
        np.add.at(self.cells, where.ravel() if played is None else where[played], 1)

    def scores(self, row: NDArray[Any], place: NDArray[Any], score: Any, played: Any) -> None:
        """Count matches by skill difference and what is noted of their final score."""
        look = self.look
        where = row * look.codes + look.code.take(place * look.outcomes + score)
        np.add.at(self.codes.reshape(-1), where.ravel() if played is None else where[played], 1)

    def tally(self, ended: Ended) -> Tally:
        """Return the tally of the chunk."""
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
            fifths=_fifths(ended, share)[None],
        )

    def _weeks(self) -> NDArray[np.float64]:
        values = np.arange(-self.widest, self.widest + 1)
        powers = values ** np.arange(len(WEEK_COLUMNS))[:, None]
        return (self.errors @ powers.T).astype(float)

    def _gaps(self, width: int) -> NDArray[np.float64]:
        look = self.look
        cells = self.cells.reshape(2 * look.gap + 1, look.width, 2)
        both = cells.sum(axis=2)
        lost, won = cells.sum(axis=1).T
        skill = np.arange(-look.gap, look.gap + 1)
        stronger = np.where(skill > 0, won, np.where(skill < 0, lost, (won + lost) / 2.0))
        if self.codes.any():
            noted = self.codes @ look.noted
        else:
            noted = np.einsum("gx,gxc->gc", both.astype(float), look.expected)
        sums = np.column_stack([won + lost, stronger, noted]).astype(float)
        found = np.zeros((look.gap // width + 1, len(GAP_COLUMNS)))
        np.add.at(found, np.abs(skill) // width, sums)
        return found


def _squares(values: NDArray[Any]) -> NDArray[np.int64]:
    """Return for each row the sum of its squares."""
    found = np.empty(len(values), dtype=np.int64)
    step = max(1, _BLOCK // values.shape[1])
    for start in range(0, len(values), step):
        some = values[start : start + step].astype(np.int64)
        found[start : start + step] = (some * some).sum(axis=1)
    return found


def _by_player(values: NDArray[Any], most: int) -> NDArray[np.int64] | None:
    """Return how often each row holds 0, 1, ..., most; None where that is a large table."""
    many = most + 1
    if len(values) * many > _LARGE:
        return None
    place = values + (np.arange(len(values)) * many)[:, None]
    return np.bincount(place.ravel(), minlength=len(values) * many).reshape(-1, many)


def _fifths(ended: Ended, share: int) -> NDArray[np.int64]:
    """Return matches and wins by fifth of true skill at the start; equals by their position."""
    skill, many = ended.skill, len(ended.skill)
    order = np.argsort(skill, axis=0, kind="stable")
    fifth = np.empty(skill.shape, dtype=np.int64)
    ranks = (np.arange(many) * FIFTHS // many)[:, None]
    np.put_along_axis(fifth, order, np.broadcast_to(ranks, skill.shape), axis=0)
    found = np.zeros((FIFTHS, 2), dtype=np.int64)
    for column, values, times in ((0, ended.matches, share), (1, ended.wins, 1)):
        if fifth.shape[1] == 1:
            by_player = values.sum(axis=1, dtype=np.int64) * times
            np.add.at(found[:, column], fifth[:, 0], by_player)
        else:
            each = np.broadcast_to(values, fifth.shape).astype(np.int64)
            # One column of matches stands for all replicas, and is counted in each of them.
            np.add.at(found[:, column], fifth.ravel(), each.ravel())
    return found
