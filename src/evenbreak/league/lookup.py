"""The chances and moves of matches as flat integer tables, for millions of draws.

A match is looked up by two integer differences: the rating difference (its race and the moves) and
the skill difference (the chance of each score). Chances are held in 32 bits and compared with 32
random bits, so a chance is off by less than 2^-32.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Floats, Ints, Places
from evenbreak.handicaps.systems.match_table import MatchTable

CLASSES = 3
"""The features counted for a final score: hill-hill, shutout, games."""

_CERTAIN = 12.0
"""Limit on skill gaps, in doublings of the odds; larger ones are treated as equal to it."""

_AT_ONCE = 64
"""Number of skill differences whose scores are worked out at a time."""


@dataclass(frozen=True, eq=False)
class Lookup:
    """Lookup of a system's matches, by skill difference and rating difference; see `lookup_of`.

    Skill differences larger than `gap`, in whole points, are treated as `gap`. `wins` has P(player
    1 wins) in 2^32nds, flat, at 2 * ((skill difference + gap) * races + number of the race) and the
    place after it, so that the winner can be added to the place.
    """

    table: MatchTable
    gap: int
    wins: NDArray[np.uint32]

    @property
    def widest(self) -> int:
        """The largest rating difference; larger ones are treated as equal to it."""
        return self.table.widest

    @property
    def width(self) -> int:
        """The number of rating differences."""
        return 2 * self.table.widest + 1

    @property
    def races(self) -> int:
        """The number of different races."""
        return len(self.table.races[0])

    @cached_property
    def twice_race(self) -> Places:
        """Twice the race number by rating difference; negative differences count from the end."""
        return np.asarray(np.roll(2 * self.table.races[1], -self.widest))

    @property
    def outcomes(self) -> int:
        """The number of possible final scores at each rating difference."""
        return int(self.table.games.shape[1])

    @cached_property
    def game(self) -> Floats:
        """P(player 1 wins a game) by skill difference, shape (2 * gap + 1,)."""
        scale = self.table.system.scale
        return np.asarray(scale.win_probability(np.arange(-self.gap, self.gap + 1.0)))

    @cached_property
    def racks(self) -> NDArray[np.uint32]:
        """`game` in 2^32nds."""
        return _in_bits(self.game)

    @cached_property
    def steps(self) -> tuple[int, int] | None:
        """The points that winners and losers move in every match; None if they vary by match."""
        table = self.table
        real = table.games[..., 0] >= 0
        won = np.where(table.won, table.moves[..., 0], table.moves[..., 1])[real]
        lost = np.where(table.won, table.moves[..., 1], table.moves[..., 0])[real]
        if (won == won[0]).all() and (lost == lost[0]).all():
            return int(won[0]), int(lost[0])
        return None

    @cached_property
    def by_winner(self) -> tuple[NDArray[np.int16], NDArray[np.int16]] | None:
        """Points of player 1 and player 2, flat by (rating difference, whether player 1 wins).

        None if they depend on the final score too.
        """
        table = self.table
        moves = table.moves
        scores = np.empty((self.width, 2, 2), dtype=np.int16)
        for won in (0, 1):
            side = ((table.won == bool(won)) & (table.games[..., 0] >= 0))[..., None]
            most = np.max(moves, axis=1, where=side, initial=-(2**15))
            if (most != np.min(moves, axis=1, where=side, initial=2**15)).any():
                return None
            scores[:, won] = most
        return np.ascontiguousarray(scores[..., 0]).ravel(), scores[..., 1].ravel()

    @cached_property
    def moves(self) -> tuple[NDArray[np.int16], NDArray[np.int16]]:
        """Points of player 1 and player 2, flat by (rating difference, final score)."""
        first, second = np.moveaxis(self.table.moves.astype(np.int16), 2, 0)
        return first.ravel(), second.ravel()

    @cached_property
    def needs(self) -> tuple[NDArray[np.int8], NDArray[np.int8]]:
        """The games that player 1 and player 2 need, by rating difference."""
        m, n = self.table.needs.astype(np.int8).T
        return np.ascontiguousarray(m), np.ascontiguousarray(n)

    @cached_property
    def classes(self) -> Ints:
        """Hill-hill, shutout and games of each final score, shape (width, outcomes, 3).

        A match is hill-hill if the loser is one game short, and a shutout if the loser has no
        games.
        """
        games, needs = self.table.games, self.table.needs[:, None, :]
        real = games[..., 0] >= 0
        hill = real & ((needs - games).sum(axis=2) == 1)
        shut = real & (games.min(axis=2) == 0)
        return np.stack([hill, shut, np.where(real, games.sum(axis=2), 0)], axis=2).astype(np.int64)

    @property
    def codes(self) -> int:
        """The number of possible values of `code`."""
        return 4 * (int(self.classes[..., 2].max()) + 1)

    @cached_property
    def code(self) -> Ints:
        """`classes` as a single number, 4 * games + 2 * shutout + hill-hill, flat."""
        return np.asarray(self.classes @ np.array([1, 2, 4])).ravel()

    @cached_property
    def noted(self) -> Ints:
        """The `classes` for each value of `code`, shape (codes, 3)."""
        code = np.arange(self.codes)
        return np.column_stack([code & 1, code >> 1 & 1, code >> 2])

    @cached_property
    def won_games(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Games of player 1 and player 2, flat by (rating difference, final score)."""
        first, second = np.moveaxis(self.table.games.astype(np.int32), 2, 0)
        return first.ravel(), second.ravel()

    @cached_property
    def expected(self) -> Floats:
        """The mean of each of `classes` by skill difference and race, shape (3, rows * races)."""
        first, _ = self.table.races
        means = np.empty((len(self.game), len(first), CLASSES))
        for start in range(0, len(self.game), _AT_ONCE):
            some = slice(start, start + _AT_ONCE)
            chances = self.table.chances(self.game[some])[first]
            means[some] = np.einsum("rog,roc->grc", chances, self.classes[first])
        return np.ascontiguousarray(np.moveaxis(means, 2, 0)).reshape(CLASSES, -1)

    @cached_property
    def cumulative(self) -> tuple[NDArray[np.uint32], Places]:
        """The largest draw for each final score, and the race at each rating difference.

        The first has shape (final scores, (2 * gap + 1) * races): a table for each score.
        """
        first, place = self.table.races
        sums = np.empty((self.outcomes, len(self.game), len(first)))
        for start in range(0, len(self.game), _AT_ONCE):
            some = slice(start, start + _AT_ONCE)
            chances = self.table.chances(self.game[some])[first]
            sums[:, some] = np.cumsum(chances, axis=1).transpose(1, 2, 0)
        last = np.maximum(np.rint(np.ldexp(sums, 32)) - 1.0, 0.0).astype(np.uint32)
        return last.reshape(self.outcomes, -1), place


def lookup_of(table: MatchTable, gap: float) -> Lookup:
    """Return the tables for skills up to `gap` points apart."""
    certain = _CERTAIN * table.system.scale.points_per_doubling
    size = int(np.ceil(min(max(gap, 1.0), certain)))
    p = table.system.scale.win_probability(np.arange(-size, size + 1.0))
    wins = np.repeat(_in_bits(table.wins(p)[table.races[0]].T).ravel(), 2)
    return Lookup(table, size, wins)


def _in_bits(chance: Any) -> NDArray[np.uint32]:
    scaled = np.rint(np.ldexp(chance, 32))
    return np.ascontiguousarray(np.minimum(scaled, 2.0**32 - 1.0).astype(np.uint32))


# How a block of matches is drawn: the winner, the final score, or every rack.
#
# Arrays have a row for each pair of players and a column for each replica. `row` is the skill
# difference + gap and may have one column for all replicas; `place` is the rating difference +
# widest.


Score = NDArray[np.int8]


def random_bits(rng: np.random.Generator, shape: tuple[int, ...]) -> NDArray[np.uint32]:
    """Return integers from 0 to 2^32 - 1, each equally likely.

    >>> random_bits(np.random.default_rng(1), (2, 3)).shape
    (2, 3)
    """
    many = math.prod(shape)
    # Twice as fast as `integers`, which returns the same bits.
    raw: Any = rng.bit_generator.random_raw((many + 1) // 2)
    return np.asarray(raw, dtype=np.uint64).view(np.uint32)[:many].reshape(shape)


def draw_winners(wins: NDArray[np.uint32], cell: NDArray[Any], rng: np.random.Generator) -> Bools:
    """Return where player 1 wins; `cell` is the position in `wins`, with chances in 2^32nds."""
    limit = np.empty(cell.shape, dtype=np.uint32)
    np.take(wins, cell, out=limit, mode="wrap")  # all are in range; 'raise' would copy
    return random_bits(rng, cell.shape) < limit


def draw_scores(
    look: Lookup, row: NDArray[Any], place: NDArray[Any], rng: np.random.Generator
) -> Score:
    """Return the final score of each match, drawn with its exact probability."""
    tables, races = look.cumulative
    where = row * int(races.max() + 1) + races.take(place)
    bits = random_bits(rng, where.shape)
    score = np.zeros(where.shape, dtype=np.int8)
    for table in tables[:-1]:
        score += bits > table.take(where)
    return score


def play_racks(
    look: Lookup, row: NDArray[Any], place: NDArray[Any], rng: np.random.Generator
) -> Score:
    """Return the final score of each match, after playing all its racks."""
    m, n = (needs.take(place) for needs in look.needs)
    limit = look.racks.take(row)
    a, b = np.zeros_like(m), np.zeros_like(n)
    going = np.ones(m.shape, dtype=bool)
    while going.any():
        won = random_bits(rng, m.shape) < limit
        a += won & going
        b += ~won & going
        going = (a < m) & (b < n)
    return np.where(a == m, b, n + a)
