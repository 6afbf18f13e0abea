"""Chip tournaments simulated, many at once.

At each table, the winner stays; the loser pays a chip and goes to the end of the line, and the
first player in line comes to the table. Tables finish their racks in random order. There are never
so many tables in use that no one is waiting; the last four players are at one table. If it doesn't
matter who breaks, the last two aren't played out: they have the same chances as in a race.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.checks import column, floats, number, whole
from evenbreak.errors import InputError
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import Scale, scale_of


@own_arrays
@dataclass(frozen=True, eq=False)
class ChipOdds:
    """Who wins a chip tournament, by simulation.

    Parameters
    ----------
    p_place
        p_place[i, k] = P(player i finishes in place k + 1).
    error
        the standard errors of `p_place`.
    racks_mean
        the mean number of racks, until two players are left unless those were played out too.
    runs
        the number of tournaments simulated.
    lengths
        each tournament's length in consecutive racks, if all racks last equally long.
    by_sample
        P(each player wins) for each sample of the ratings, one per column.
    """

    p_place: Floats
    error: Floats
    racks_mean: float
    runs: int
    lengths: Floats
    by_sample: Floats

    @property
    def title(self) -> Floats:
        """P(each player wins the tournament)."""
        return self.p_place[:, 0]


def play_chips(
    chips: Sequence[int] | ArrayLike,
    racks: ArrayLike,
    *,
    tables: int = 1,
    line: Sequence[int] | None = None,
    in_use: int | None = None,
    to_the_end: bool = False,
    runs: int = 10_000,
    rng: np.random.Generator | None = None,
) -> ChipOdds:
    """Return who finishes where in a chip tournament, by simulation.

    Parameters
    ----------
    chips
        each player's starting chips.
    racks
        racks[i, j] = P(i, who stays at the table, beats the challenger j). A third axis, if any, is
        for samples of the ratings, which are used in turn.
    line
        the order in which players come to the tables; None: drawn anew for each run.
    in_use
        how many tables are in use at the start; None: as many as possible with someone waiting.
    to_the_end
        whether the last two are played out too, to see how long that takes.
    rng
        the random number generator; None: a generator with seed 0.

    Raises
    ------
    InputError
        if a parameter has an invalid value.

    >>> odds = play_chips([3, 3, 3, 3], np.full((4, 4), 0.5))
    >>> odds.title.round(2), odds.p_place.sum(axis=0).round(9)
    (array([0.25, 0.25, 0.25, 0.25]), array([1., 1., 1., 1.]))
    """
    counts = np.array([whole(count, "chips", at_least=1) for count in np.asarray(chips).tolist()])
    if len(counts) < 2:
        raise InputError("{chips} must have two players or more; you gave {value!r}", value=chips)
    table = np.asarray(racks, dtype=float)
    each = np.moveaxis(table.reshape(*table.shape[:2], -1), 2, 0)
    table = np.stack([checked_racks(one, len(counts)) for one in each])
    order = None if line is None else np.array(line)
    if order is not None and sorted(order.tolist()) != list(range(len(counts))):
        raise InputError(
            "{line} is {value!r}. Give each of {n_counts} players once.",
            value=line,
            n_counts=len(counts),
        )
    rng = rng or np.random.default_rng(0)
    room = _Room(counts, table, whole(tables, "tables", at_least=1), order, in_use, runs, rng)
    if to_the_end:
        room.play_out()
    while room.running.size:
        room.rack()
    law, error, won = room.places()
    return ChipOdds(law, error, float(room.racks) / runs, runs, room.lengths, won)


def tables_in_use(left: int, tables: int) -> int:
    """Return how many tables are in use: so many that someone is waiting, except heads-up.

    >>> [tables_in_use(left, 4) for left in (2, 4, 5, 8, 16)]
    [1, 1, 2, 3, 4]
    """
    return min(max((left - 1) // 2, 1), tables)


class _Room:
    """All runs at once; one per row."""

    def __init__(
        self,
        chips: Ints,
        table: Floats,
        tables: int,
        order: Ints | None,
        in_use: int | None,
        runs: int,
        rng: np.random.Generator,
    ) -> None:
        count = len(chips)
        self.table, self.rng, self.runs = table, rng, runs
        self.chips = np.tile(chips, (runs, 1))
        seats = np.tile(np.arange(count), (runs, 1))
        line = rng.permuted(seats, axis=1) if order is None else np.tile(order, (runs, 1))
        self.most = tables
        in_use = tables_in_use(count, tables) if in_use is None else in_use
        self.stays = line[:, 0 : 2 * in_use : 2].copy()
        self.challenges = line[:, 1 : 2 * in_use : 2].copy()
        self.open = np.full(runs, in_use)  # tables in use: the first so many
        waiting = line[:, 2 * in_use :]
        self.line = np.zeros((runs, count), dtype=np.int64)  # a ring: from head, so many
        self.line[:, : waiting.shape[1]] = waiting
        self.head = np.zeros(runs, dtype=np.int64)
        self.length = np.full(runs, waiting.shape[1])
        self.left = np.full(runs, count)
        self.place = np.zeros((runs, count), dtype=np.int64)  # 0: still in
        self.lengths = np.zeros(runs)
        self.racks = 0
        self.last = 1 if any(break_matters(one) for one in table) else 2
        self.running = np.flatnonzero(self.left > self.last)

    def play_out(self) -> None:
        """Play out the last two too."""
        self.last = 1
        self.running = np.flatnonzero(self.left > 1)

    def rack(self) -> None:
        """Play one rack in each run."""
        run = self.running
        at = (self.rng.random(len(run)) * self.open[run]).astype(np.int64)
        one, other = self.stays[run, at], self.challenges[run, at]
        won = self.rng.random(len(run)) < self.table[run % len(self.table), one, other]
        winner, loser = np.where(won, one, other), np.where(won, other, one)
        self.racks += len(run)
        self.lengths[run] += 1.0 / self.open[run]
        self.chips[run, loser] -= 1
        out = self.chips[run, loser] == 0
        self.place[run[out], loser[out]] = self.left[run[out]]
        self.left[run] -= out
        self._wait(run[~out], loser[~out])
        close = np.clip((self.left[run] - 1) // 2, 1, self.most) < self.open[run]
        stay = ~close & (self.left[run] > 1)
        goes_on = run[stay]
        self.stays[goes_on, at[stay]] = winner[stay]
        self.challenges[goes_on, at[stay]] = self._next(goes_on)
        if close.any():
            self._close(run[close], at[close], winner[close])
        if out.any():
            self.running = run[self.left[run] > self.last]

    def places(self) -> tuple[Floats, Floats, Floats]:
        """Return P(each player gets each place), the errors, and P(win) by rating sample."""
        count = self.chips.shape[1]
        law = np.zeros((count, count))
        squares = np.zeros((count, count))
        for place in range(self.last + 1, count + 1):
            law[:, place - 1] = squares[:, place - 1] = (self.place == place).sum(axis=0)
        if self.last == 1:
            law[:, 0] = squares[:, 0] = (self.place == 0).sum(axis=0)
            won = (self.place == 0).astype(float)
        else:
            won = self._heads_up(law, squares)
        samples = min(len(self.table), self.runs)
        by_sample = np.stack([won[k :: len(self.table)].mean(axis=0) for k in range(samples)], 1)
        law, squares = law / self.runs, squares / self.runs
        error = np.sqrt(np.maximum(squares - law**2, 0.0) / self.runs)
        return law, error, by_sample

    def _heads_up(self, law: Floats, squares: Floats) -> Floats:
        """Add the last two to the places; return P(each player wins) in each run."""
        rows = np.arange(self.runs)
        last = np.argsort(self.place, axis=1, kind="stable")[:, :2]  # the two without a place
        one, other = last[:, 0], last[:, 1]
        p = race_win_probability(
            self.table[rows % len(self.table), one, other],
            self.chips[rows, other],
            self.chips[rows, one],
        )
        for player, chance in ((one, p), (other, 1.0 - p)):
            for place, share in ((0, chance), (1, 1.0 - chance)):
                law[:, place] += np.bincount(player, share, len(law))
                squares[:, place] += np.bincount(player, share**2, len(law))
        won = np.zeros(self.place.shape)
        won[rows, one], won[rows, other] = p, 1.0 - p
        return won

    def _wait(self, run: Ints, player: Ints) -> None:
        """Send players to the end of the line."""
        size = self.line.shape[1]
        self.line[run, (self.head[run] + self.length[run]) % size] = player
        self.length[run] += 1

    def _next(self, run: Ints) -> Ints:
        """Take the first players in line."""
        player: Ints = self.line[run, self.head[run]]
        self.head[run] = (self.head[run] + 1) % self.line.shape[1]
        self.length[run] -= 1
        return player

    def _close(self, run: Ints, at: Ints, winner: Ints) -> None:
        """Close a table: its winner goes to wait, and the last table gets its number."""
        self._wait(run, winner)
        last = self.open[run] - 1
        self.stays[run, at] = self.stays[run, last]
        self.challenges[run, at] = self.challenges[run, last]
        self.open[run] = last


# The chances of a rack: P(whoever stays at the table beats the challenger).


def rack_chances(
    ratings: ArrayLike, *, scale: Scale | str | float = "fargo", break_advantage: float = 0.0
) -> Floats:
    """Return P(i, at the table, beats the challenger j), by rating.

    Parameters
    ----------
    scale
        a name, or the points that double the odds.
    break_advantage
        how many points better the breaker plays; the player who stays breaks. Negative if the
        challenger breaks.

    >>> rack_chances([600, 500]).round(3)
    array([[0.5  , 0.667],
           [0.333, 0.5  ]])
    """
    rated = column(ratings, "ratings", np.size(ratings), "players")
    gap = rated[:, None] - rated + number(break_advantage, "break_advantage")
    return np.asarray(scale_of(scale).win_probability(gap))


def checked_racks(racks: ArrayLike, players: int) -> Floats:
    """Return the array of rack chances, if it has the right shape."""
    table = floats(racks, "racks", low=0.0, high=1.0)
    if table.shape != (players, players):
        raise InputError(
            "{racks} must have a row and a column for each of {players} players; its "
            "shape is {table_shape}",
            table_shape=table.shape,
            players=players,
        )
    return table


def break_matters(racks: Floats) -> bool:
    """Return whether it makes a difference which of two players stays and which challenges."""
    return bool(np.abs(racks + racks.T - 1.0)[~np.eye(len(racks), dtype=bool)].max() > 1e-12)
