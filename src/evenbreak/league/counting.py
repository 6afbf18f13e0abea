"""The quantities counted while a chunk is played, and their conversion to a tally."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Floats, Ints, Places
from evenbreak.handicaps.ladders.comparison import near
from evenbreak.league.season import FIFTHS, WEEK_COLUMNS, Season, Tally, fifths_of

_DOUBLINGS = 4.0
"""How far rating errors and moves are counted individually: up to odds of 16 to 1."""

_BINS = 128
"""The most skill gaps that are counted separately."""

ALONE = 1 << 15
"""In a league with more players than this each batch is one replica."""

_LARGE = 1 << 20
"""A table of players with more entries than this is not kept."""

_SMALL = 1 << 15
"""The first whole number that signed 16 bits cannot hold."""

_FEW = 1 << 18
"""Errors in a whole chunk that are kept and counted at once, since each count takes a while."""

_BLOCK = 1 << 15
"""Ratings counted at a time, so that they stay in the cache."""


class Ended(NamedTuple):
    """The arrays at the end of a chunk, with players as rows: one column, or one per replica."""

    rating: NDArray[Any]
    wins: NDArray[Any]
    games: NDArray[Any] | None
    matches: NDArray[Any]
    skill: NDArray[Any]


class Counting:
    """Counts for a chunk while it is played."""

    def __init__(self, season: Season, replicas: int, batches: int) -> None:
        self.season, self.replicas, self.batches = season, replicas, batches
        self.look = look = season.lookup
        rows = 2 * look.gap + 1
        self.cells = np.zeros((batches, rows * look.races * 2), dtype=np.int64)
        self.codes = np.zeros((batches, rows * look.codes), dtype=np.int64)
        self.widest = round(_DOUBLINGS * season.system.scale.points_per_doubling)
        bins = 2 * self.widest + 1
        self.errors = np.zeros((season.weeks + 1, bins), dtype=np.int64)
        self.weeks = np.zeros((batches, season.weeks + 1, len(WEEK_COLUMNS)))
        errors = np.arange(-self.widest, self.widest + 1)
        is_near = near(errors, season.system.scale)
        self.noted = np.column_stack([errors**0, errors, errors**2, is_near])
        self.kept: list[tuple[int, NDArray[np.int16]]] = []
        # The bin of no error, among the bins of a row's batch.
        small = np.int16 if batches * bins < _SMALL else np.intp  # fewer bytes are faster
        zeros = (bins * np.arange(batches) + self.widest).astype(small)
        self.zero = np.broadcast_to(zeros[:, None], (batches, len(season.players))).reshape(-1, 1)

    def week(
        self,
        week: int,
        rating: NDArray[np.int16],
        skill: NDArray[np.int16],
        here: Bools | None,
    ) -> None:
        """Count the rating errors of the league's current players (None: everyone)."""
        if here is None and rating.size * len(self.errors) <= _FEW:
            self.kept.append((week, rating - skill))
            return
        bins = 2 * self.widest + 1
        counted = np.zeros(self.batches * bins, dtype=np.int64)
        step = max(1, _BLOCK // rating.shape[1])
        for start in range(0, len(rating), step):
            some = slice(start, start + step)
            error = rating[some] - skill[some]
            if max(int(error.max()), -int(error.min())) > self.widest:
                np.clip(error, -self.widest, self.widest, out=error)
            where = self.zero[some] + error
            if here is not None:
                where = where[here[some]]
            counted += np.bincount(where.ravel(), minlength=len(counted))
        by_batch = counted.reshape(self.batches, bins)
        self.errors[week] = by_batch.sum(axis=0)
        self.weeks[:, week] = by_batch @ self.noted

    def count_kept(self) -> None:
        """Count the errors of a small league's weeks all at once."""
        if not self.kept:
            return
        bins, weeks = 2 * self.widest + 1, [week for week, _ in self.kept]
        errors = np.stack([error for _, error in self.kept]).reshape(len(weeks), self.batches, -1)
        if max(int(errors.max()), -int(errors.min())) > self.widest:
            np.clip(errors, -self.widest, self.widest, out=errors)
        places = errors + (bins * np.arange(len(weeks)) + self.widest)[:, None, None]
        counted = np.bincount(places.ravel(), minlength=bins * len(weeks))
        self.errors[weeks] = counted.reshape(-1, bins)
        near = np.abs(errors) <= int(self.noted[:, 3].sum()) // 2  # a range around no error
        wide = errors.astype(np.int32)
        sums = [
            wide.sum(axis=2),
            np.einsum("wbr,wbr->wb", wide, wide, dtype=np.int64),
            near.sum(axis=2),
        ]
        self.weeks[:, weeks] = np.stack([np.full_like(sums[0], errors.shape[2]), *sums]).T

    def matches(self, cell: Places, won: Bools, played: Any) -> None:
        """Count matches by their position in the tables of all batches, and by winner.

        `cell` is even, and is overwritten.
        """
        cell += won
        _add_up(self.cells, cell, played)

    def scores(self, row: NDArray[Any], apart: NDArray[Any], score: Any, played: Any) -> None:
        """Count matches by skill difference and by class of their final score.

        `row` is the row for the skill difference in the tables of all batches.
        """
        look = self.look
        place = (apart.astype(np.intp) + look.widest) * look.outcomes + score
        _add_up(self.codes, row * look.codes + look.code.take(place), played)

    def tally(self, ended: Ended) -> Tally:
        """Return the tally of the chunk."""
        fixed_fifths = None if ended.skill.shape[1] > 1 else self.season.fifths
        wins, games = self._across(ended.wins), ended.games
        start = self.season.players.rating[:, None].astype(np.int16)
        moved = self._across(ended.rating) - start
        matches = self._across(ended.matches)
        width = -(-(self.look.gap + 1) // _BINS)
        share = 1 if ended.matches.shape[1] > 1 else self.replicas
        most = min(self.widest, max(int(moved.max()), -int(moved.min())))
        self.count_kept()
        return Tally(
            replicas=np.full(self.batches, self.replicas),
            matches=matches.sum(axis=1, dtype=np.int64) * share,
            wins=wins.sum(axis=1, dtype=np.int64),
            wins_squared=_squares(wins),
            rating=moved.sum(axis=1, dtype=np.int64),
            rating_squared=_squares(moved),
            games=None if games is None else self._across(games).sum(axis=1, dtype=np.int64),
            products=self._products(wins, moved, matches, share),
            wins_counts=_by_player(wins, int(wins.max(initial=0))),
            rating_counts=None
            if len(moved) * len(self.noted) > _LARGE
            else _by_player(np.clip(moved, -most, most) + most, 2 * most),
            errors=self.errors,
            gap_width=width,
            gaps=self._gaps(width),
            weeks=self.weeks,
            fifths=self._fifths(ended, share, fixed_fifths),
        )

    def _across(self, rows: NDArray[Any]) -> NDArray[Any]:
        """Return an array with a row for each player, all batches of the chunk side by side."""
        if self.batches == 1:
            return rows
        many = len(self.season.players)
        return rows.reshape(self.batches, many, -1).transpose(1, 0, 2).reshape(many, -1)

    def _products(self, wins: Any, moved: Any, matches: Any, share: int) -> Any:
        """Return a tally's `products`; None if a batch is one replica."""
        if len(wins) > ALONE:
            return None
        won, gone, played = (
            rows.reshape(len(rows), self.batches, -1).sum(axis=2, dtype=np.int64)
            for rows in (wins, moved, matches)
        )
        played *= share
        pairs = (won, won), (won, played), (played, played), (gone, gone)
        sums = [(left * right).sum(axis=1) for left, right in pairs]
        sums += [self.replicas * left.sum(axis=1) for left in (won, gone)]
        return np.column_stack(sums)

    def _fifths(self, ended: Ended, share: int, fixed_fifths: Any) -> Ints:
        """Return matches and wins by batch and fifth of true skill at the start."""
        many = len(self.season.players)
        sums = np.empty((self.batches, FIFTHS, 2), dtype=np.int64)
        for batch in range(self.batches):
            rows = slice(batch * many, (batch + 1) * many)
            fifth = fifths_of(ended.skill[rows]) if fixed_fifths is None else fixed_fifths
            sums[batch] = _by_fifth(ended.wins[rows], ended.matches[rows], share, fifth)
        return sums

    def _gaps(self, width: int) -> Floats:
        look = self.look
        bins = look.gap // width + 1
        skill = np.arange(-look.gap, look.gap + 1)
        bin_of = np.abs(skill) // width

        def summed(batch: Any, row: Any, *columns: NDArray[Any]) -> list[Floats]:
            place = batch * bins + bin_of[row]
            many = self.batches * bins
            return [np.asarray(np.bincount(place, column, many), float) for column in columns]

        # A chunk uses few cells of a large table.
        lost, won = self.cells.reshape(-1, 2).T
        both = lost + won
        at = np.flatnonzero(both)
        lost, won, both = lost[at], won[at], both[at]
        batch, cell = np.divmod(at, self.cells.shape[1] // 2)
        row = cell // look.races
        sign = np.sign(skill[row])
        sums = summed(batch, row, both, (both + sign * (won - lost)) / 2.0)
        if look.by_winner is None or self.season.play == "racks":
            noted = self.codes.reshape(-1, look.codes) @ look.noted
            sums += summed(*np.divmod(np.arange(len(noted)), len(skill)), *noted.T)
        else:
            sums += summed(batch, row, *(look.expected[:, cell] * both))
        return np.column_stack(sums).reshape(self.batches, bins, -1)


def _add_up(tables: Ints, where: NDArray[Any], played: Any) -> None:
    """Add one at each position where a match is played."""
    np.add.at(tables.reshape(-1), where.ravel() if played is None else where[played], 1)


def _squares(values: NDArray[Any]) -> Ints:
    """Return the sum of squares of each row."""
    squares = np.empty(len(values), dtype=np.int64)
    step = max(1, _BLOCK // values.shape[1])
    for start in range(0, len(values), step):
        some = values[start : start + step].astype(np.int64)
        squares[start : start + step] = np.sum(some * some, axis=1)
    return squares


def _by_player(values: NDArray[Any], most: int) -> Ints | None:
    """Return how often each row holds 0, 1, ..., most; None if that table is large."""
    many = most + 1
    if len(values) * many > _LARGE:
        return None
    place = values + (np.arange(len(values)) * many)[:, None]
    return np.bincount(place.ravel(), minlength=len(values) * many).reshape(-1, many)


def _by_fifth(wins: NDArray[Any], matches: NDArray[Any], share: int, fifth: Ints) -> Ints:
    """Return matches and wins by fifth of true skill at the start."""
    sums = np.zeros((FIFTHS, 2), dtype=np.int64)
    for column, values, times in ((0, matches, share), (1, wins, 1)):
        if fifth.shape[1] == 1:
            by_player = values.sum(axis=1, dtype=np.int64) * times
            np.add.at(sums[:, column], fifth[:, 0], by_player)
        else:
            # A single column of matches stands for all replicas and counts in each of them.
            each = np.broadcast_to(values, fifth.shape).astype(np.int64)
            np.add.at(sums[:, column], fifth.ravel(), each.ravel())
    return sums
