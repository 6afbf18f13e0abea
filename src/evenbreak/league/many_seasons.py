"""Simulate many replicas of a season at once, a round of matches at a time.

Ratings are an array of small integers, with players as rows and replicas as columns, so a player's
replicas are adjacent in memory. A round gathers the rows of the players who meet, looks up all
their matches in flat tables by race and skill difference, draws each winner with 32 random bits,
adds the moves, and counts everything along the way. Rounds are played in blocks that stay in the
cache.

Replicas side by side share the draw of opponents: they are a *batch*. Standard errors come from
the differences between batches, so there must be many of them, while numpy is fast with long
arrays. So a *chunk* plays several batches as one league, with the players of each batch placed
below those of the previous batch.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Places
from evenbreak.errors import AccuracyError
from evenbreak.handicaps.systems.npl import step_after
from evenbreak.league.counting import Counting, Ended
from evenbreak.league.lookup import Lookup, draw_scores, draw_winners, play_racks, random_bits
from evenbreak.league.players import LeaguePlayers
from evenbreak.league.schedule import FixedSchedule, RandomPairing, Round, RoundRobin
from evenbreak.league.season import Season, Tally

_BLOCK = 1 << 15
"""Matches played at a time."""

_HIGHEST = 16_000
"""The highest rating, in points, whose differences fit 16 bits."""

_MANY = 30_000
"""Number of matches above which a player's wins in another week might not fit 16 bits."""

_LOOK = 8
"""Number of weeks between two checks of the highest and the lowest rating."""

_WIN = 1 << 16
"""One win, in the upper bits of a player's state."""


def run_chunk(
    season: Season, replicas: int, seed: np.random.SeedSequence, *, batches: int = 1
) -> Tally:
    """Return the tally of a chunk: batches of replicas, each with its own draw of opponents.

    Parameters
    ----------
    replicas
        in each batch, 1 or more.
    seed
        for all draws in the chunk; the same seed gives the same tally.
    batches
        1 or more.

    Raises
    ------
    AccuracyError
        if a rating exceeds 16,000 points, or a player has more than 30,000 matches.

    >>> from evenbreak.league import LeaguePlayers
    >>> season = Season(LeaguePlayers.of([92, 80, 71, 64]), "npl", weeks=12)
    >>> tally = run_chunk(season, 100, np.random.SeedSequence(1))
    >>> tally.matches, int(tally.wins.sum()), int(tally.rating.sum())
    (array([1200, 1200, 1200, 1200]), 2400, 0)
    """
    chunk = _Chunk(season, replicas, np.random.Generator(np.random.SFC64(seed)), batches)
    chunk.count_week(0, chunk.here(1))
    for week in range(1, season.weeks + 1):
        chunk.play(week)
    return chunk.count.tally(chunk.ended())


class _Chunk:
    """State of the replicas while they are played.

    The arrays have a row for each player of the first batch, then of the second, and so on.

    `state` has a player's rating in its lower 16 bits and the wins in its upper bits, so that both
    are gathered and written together: rating + 2^16 wins.
    """

    def __init__(
        self, season: Season, replicas: int, rng: np.random.Generator, batches: int = 1
    ) -> None:
        players = season.players
        shape = batches * len(players), replicas
        self.season, self.rng, self.replicas, self.batches = season, rng, replicas, batches
        self.lookup: Lookup = season.lookup
        # Each batch counts in a table of its own. With a copy of the chances for each batch, the
        # same place serves to draw a match and to count it.
        self.wins = self.lookup.wins if batches == 1 else np.tile(self.lookup.wins, batches)
        self.state = np.empty(shape, dtype=np.int32)
        self.state[:] = self._column(players.rating)
        # One column if all replicas are alike, so that there is less to look up.
        self.skill: NDArray[np.floating[Any]] = self._column(players.skill)
        if players.skill_sd.any():
            drawn = rng.standard_normal(shape, dtype=np.float32)
            self.skill = self.skill + self._column(players.skill_sd) * drawn
        self.began = self.skill
        self.games = np.zeros(shape, dtype=np.int32) if season.play == "racks" else None
        absence = _absence(players)
        self.absence = None if absence is None else self._column(absence)
        columns = 1 if absence is None else replicas
        self.matches = np.zeros((shape[0], columns), dtype=np.int32)
        self.factors = _factors(season)
        self.before = None if self.factors is None else self._column(players.played)
        self.drifts, self.strays = bool(players.drift.any()), bool(players.day_sd.any())
        self.stay = bool((players.joins == 1).all() and (players.leaves == 0).all())
        # Skills in whole points: the true ones, and those of the day.
        self.points = self.today = _points(self.skill)
        drawn_skills = self.strays or bool(players.skill_sd.any())
        self.beyond = drawn_skills or season.widest_gap > self.lookup.gap
        self.highest, self.lowest = int(players.rating.max()), int(players.rating.min())
        self.longest = season.longest_move
        self.rounds = 0
        self.count = Counting(season, replicas, batches)

    def _column(self, of_players: NDArray[Any]) -> NDArray[Any]:
        """Return a column of the players, expanded to all rows."""
        stacked = of_players if self.batches == 1 else np.tile(of_players, self.batches)
        return stacked[:, None]

    def count_week(self, week: int, here: Bools | None) -> None:
        """Count the rating errors after a week, and check that the arrays can still hold them."""
        rating = self.state.astype(np.int16)
        if week % _LOOK == 0 or max(self.highest, -self.lowest) > _HIGHEST:
            self.highest, self.lowest = int(rating.max()), int(rating.min())
        if max(self.highest, -self.lowest) > _HIGHEST or self.rounds > _MANY:
            raise AccuracyError(
                "weeks is {weeks}, but by week {week} a rating is beyond {highest} "
                "points, or a player has played more than {many} matches. Play fewer weeks.",
                weeks=self.season.weeks,
                week=week,
                highest=_HIGHEST,
                many=_MANY,
            )
        self.count.week(week, rating, self.points, here)

    def here(self, week: int) -> Bools | None:
        """Return which rows are in the league in a week; None: all rows."""
        return None if self.stay else self._column(self.season.players.here(week))[:, 0]

    def play(self, week: int) -> None:
        """Play a week: its matches, its moves, its drift."""
        players, rng = self.season.players, self.rng
        here = self.here(week)
        if self.strays:
            normal = rng.standard_normal(self.state.shape, dtype=np.float32)
            self.today = _points(self.skill + self._column(players.day_sd) * normal)
        absent = None
        if self.absence is not None:
            absent = random_bits(rng, self.state.shape) < self.absence
        rounds = self._rounds(week, here)
        before = self.state if len(rounds) < 2 else self.state.copy()
        step = max(1, _BLOCK // self.replicas)
        for a, b in rounds:
            for start in range(0, len(a), step):
                some = slice(start, start + step)
                self._block(before, absent, a[some], b[some])
            if absent is None:
                self._count_matches(a, b)
        self.rounds += len(rounds)
        self.highest += len(rounds) * self.longest
        self.lowest -= len(rounds) * self.longest
        if self.drifts:
            self.skill = self.skill + self._column(players.drift)
            self.points = self.today = _points(self.skill)
        self.count_week(week, here)

    def _rounds(self, week: int, here: Bools | None) -> list[Round]:
        """Return which rows meet in a week, among those in the league."""
        schedule, many = self.season.schedule, len(self.season.players)
        first = many * np.arange(self.batches)[:, None]  # row of each batch
        if isinstance(schedule, RandomPairing):
            if here is None and self.batches == 1:
                return schedule.pairs(week, self.rng, many)
            who = None if here is None else np.flatnonzero(self.season.players.here(week))
            count = many if who is None else len(who)
            drawn = (
                schedule.pairs(week, self.rng, count)
                if self.batches == 1
                else schedule.many_pairs(self.rng, count, self.batches)
            )
            if who is not None:
                drawn = [(who[a], who[b]) for a, b in drawn]
            return [((a + first).ravel(), (b + first).ravel()) for a, b in drawn]
        if isinstance(schedule, RoundRobin | FixedSchedule):
            rounds = [(a + first, b + first) for a, b in schedule.pairs(week, self.rng, many)]
        else:  # a schedule of the user's own, which may draw too
            each = [schedule.pairs(week, self.rng, many) for _ in range(self.batches)]
            rounds = [_below(of_batches, many) for of_batches in zip_longest(*each)]
        if here is None:
            return [(a.ravel(), b.ravel()) for a, b in rounds]
        return [(a[both], b[both]) for a, b in rounds for both in [here[a] & here[b]]]

    def _count_matches(self, a: Places, b: Places) -> None:
        """Count a round's matches in all replicas."""
        if 2 * len(a) == len(self.matches):  # nobody occurs twice, so everybody plays
            self.matches += 1
        else:
            self.matches[a] += 1
            self.matches[b] += 1

    def _block(
        self,
        before: NDArray[np.int32],
        absent: Bools | None,
        a: Places,
        b: Places,
    ) -> None:
        """Play matches in which no player occurs twice."""
        look = self.lookup
        one, two = before.take(a, axis=0), before.take(b, axis=0)
        apart = (one - two).astype(np.int16)  # the lower bits of the difference: of ratings
        if self.highest - self.lowest > look.widest:
            np.clip(apart, -look.widest, look.widest, out=apart)
        row = self._rows(a, b)
        counted = row if self.batches == 1 else row + self._first_rows(a)
        cell = np.empty(apart.shape, dtype=np.intp)
        np.take(look.twice_race, apart, out=cell, mode="wrap")
        cell += counted * (2 * look.races)
        won, score = self._draw(row, cell, apart)
        played = None
        if absent is not None:
            played = ~(absent.take(a, axis=0) | absent.take(b, axis=0))
        self.count.matches(cell, won, played)
        if score is not None:
            self.count.scores(counted, apart, score, played)
            if self.games is not None:
                self._count_games(a, b, apart, score, played)
        if before is not self.state:
            one, two = self.state.take(a, axis=0), self.state.take(b, axis=0)
        if look.steps is not None and self.factors is None and played is None:
            up, down = look.steps
            change = won.astype(np.int32)
            change *= np.int32(_WIN + up - down)
            change += np.int32(down)
            one += change
            two += np.int32(_WIN + up + down)
            two -= change  # the two changes always have this sum
        else:
            for state, change in zip(
                (one, two), self._changes(a, b, apart, won, score), strict=True
            ):
                state += change if played is None else change * played
        _put(self.state, a, one)
        _put(self.state, b, two)
        if played is not None:
            self.matches[a] += played
            self.matches[b] += played

    def _rows(self, a: Places, b: Places) -> Places:
        """Return the difference between the skills of the day, as a row of the tables."""
        row = self.today.take(a, axis=0).astype(np.intp)
        row -= self.today.take(b, axis=0)
        if self.beyond:
            np.clip(row, -self.lookup.gap, self.lookup.gap, out=row)
        row += self.lookup.gap
        return row

    def _first_rows(self, a: Places) -> Places:
        """Return the first row of the table for each player's batch."""
        batch = a // len(self.season.players)
        return (batch * (2 * self.lookup.gap + 1))[:, None]

    def _count_games(self, a: Places, b: Places, apart: Any, score: Any, played: Any) -> None:
        assert self.games is not None  # noqa: S101
        place = (apart.astype(np.intp) + self.lookup.widest) * self.lookup.outcomes + score
        for rows, games in zip((a, b), self.lookup.won_games, strict=True):
            self.games[rows] += games.take(place) * (1 if played is None else played)

    def _changes(
        self, a: Places, b: Places, apart: Any, won: Any, score: Any
    ) -> Iterator[NDArray[np.int32]]:
        """Yield the amounts added to the two players' states: moves and wins."""
        for rows, move, wins in zip(
            (a, b), self._moves(apart, won, score), (won, ~won), strict=True
        ):
            change = wins * np.int32(_WIN)
            change += move if self.factors is None else move * self._factor(self.factors, rows)
            yield change

    def _draw(
        self, row: NDArray[Any], cell: NDArray[Any], apart: NDArray[np.int16]
    ) -> tuple[Bools, NDArray[Any] | None]:
        """Return where player 1 wins, and the final score if it is drawn."""
        look = self.lookup
        if self.season.play == "matches" and look.by_winner is not None:
            return draw_winners(self.wins, cell, self.rng), None
        place = apart.astype(np.intp) + look.widest
        draw = play_racks if self.season.play == "racks" else draw_scores
        score = draw(look, row, place, self.rng)
        return score < look.needs[1].take(place), score

    def _moves(
        self, apart: NDArray[np.int16], won: Bools, score: NDArray[Any] | None
    ) -> tuple[NDArray[Any], ...]:
        """Return the points that established players move."""
        look = self.lookup
        if look.steps is not None:
            up, down = look.steps
            of_a = won * np.int16(up - down)
            of_b = np.int16(up) - of_a
            of_a += np.int16(down)
            return of_a, of_b
        place = apart.astype(np.intp) + look.widest
        if look.by_winner is not None:
            tables = look.by_winner
            place = 2 * place + won
        else:
            assert score is not None  # noqa: S101 (these matches are drawn with their score)
            tables = look.moves
            place = place * look.outcomes + score
        return tables[0].take(place), tables[1].take(place)

    def _factor(self, factors: NDArray[np.int16], rows: Places) -> NDArray[np.int16]:
        """Return the factor by which these players move; newcomers move more."""
        assert self.before is not None  # noqa: S101
        last = len(factors) - 1
        before = np.minimum(self.before[rows], last)
        factor: NDArray[np.int16] = factors.take(
            np.minimum(before + self.matches.take(rows, axis=0), last)
        )
        return factor

    def ended(self) -> Ended:
        """Return the arrays at the end of the chunk."""
        rating = self.state.astype(np.int16)
        wins = (self.state - rating) >> 16
        return Ended(rating, wins, self.games, self.matches, self.began)


def _points(skill: NDArray[Any]) -> NDArray[np.int16]:
    """Return skills as whole points."""
    rounded: NDArray[np.int16] = np.rint(np.clip(skill, -_HIGHEST, _HIGHEST)).astype(np.int16)
    return rounded


def _below(of_batches: Sequence[Round | None], many: int) -> Round:
    """Return a round of every batch as a single round, each batch below the previous one."""
    there = [(k * many, pairs) for k, pairs in enumerate(of_batches) if pairs is not None]
    a, b = (np.concatenate([first + pairs[side] for first, pairs in there]) for side in (0, 1))
    return a, b


def _absence(players: LeaguePlayers) -> NDArray[np.uint32] | None:
    """Return P(absent) in 2^32nds, or None if no one ever is absent."""
    if not players.absence.any():
        return None
    scaled = np.minimum(np.rint(np.ldexp(players.absence, 32)), 2.0**32 - 1.0)
    return np.asarray(scaled.astype(np.uint32))


def _factors(season: Season) -> NDArray[np.int16] | None:
    """Return a player's factor after 0, 1, 2, ... matches, or None if no one is new."""
    steps = season.system.newcomer_steps
    last = sum(matches for matches, _ in steps)
    if not (season.players.played < last).any():
        return None
    return np.array([step_after(played, steps) for played in range(last + 1)], dtype=np.int16)


def _put(to: NDArray[Any], rows: Places, what: NDArray[Any]) -> None:
    """Set rows, with no row occurring twice."""
    if to.shape[1] == 1:  # a column alone is twice as fast as a line
        to[:, 0][rows] = what[:, 0]
    else:
        to[rows] = what
