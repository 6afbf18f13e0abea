"""Many replicas of a season at once, a round of matches at a time.

Ratings are an array of small whole numbers, players down and replicas across, so that the
replicas of a player lie side by side in memory: a round gathers the rows of those who meet,
looks all their matches up in flat tables by rating difference and skill difference, draws who
wins with 32 random bits a match, and adds the moves. All is counted on the way. Rounds are
taken in blocks that stay in the cache.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import AccuracyError
from evenbreak.handicaps.systems import step_after
from evenbreak.league.counting import Counting, Ended
from evenbreak.league.drawing import draw_scores, draw_winners, play_racks, random_bits
from evenbreak.league.season import Season, draws_opponents
from evenbreak.league.tally import Tally

if TYPE_CHECKING:
    from evenbreak.league.lookup import Lookup

__all__ = ["chunk_replicas", "run_chunk"]

_BLOCK = 1 << 14
"""Matches that are played at a time."""

_CHUNK = 1 << 16
"""Players times replicas that a chunk has if the season is not larger by itself."""

_CHUNKS = 10
"""Chunks that there are at least where there are as many replicas: errors come from them."""

_HIGHEST = 16_000
"""Points beyond which differences do not fit the arrays."""


def chunk_replicas(season: Season, replicas: int) -> int:
    """Return how many replicas a chunk should have: as many as the cache holds.

    There are ten chunks or more where there are ten replicas or more, since standard errors
    come from how chunks differ.

    >>> from evenbreak.league import LeaguePlayers
    >>> chunk_replicas(Season(LeaguePlayers.of([50] * 64), "npl"), 100_000)
    1024
    """
    return max(1, min(_CHUNK // len(season.players), replicas // _CHUNKS))


def run_chunk(season: Season, replicas: int, seed: np.random.SeedSequence) -> Tally:
    """Return the tally of a chunk: replicas of a season that share the draw of opponents.

    Parameters
    ----------
    season
        what is played.
    replicas
        how many times, 1 or more.
    seed
        whence all draws of the chunk come; the same one gives the same tally.

    Raises
    ------
    AccuracyError
        if a rating or a skill leaves what the arrays hold.

    >>> from evenbreak.league import LeaguePlayers
    >>> season = Season(LeaguePlayers.of([92, 80, 71, 64]), "npl", weeks=12)
    >>> tally = run_chunk(season, 100, np.random.SeedSequence(1))
    >>> tally.matches, int(tally.wins.sum()), int(tally.rating.sum())
    (array([1200, 1200, 1200, 1200]), 2400, 0)
    """
    chunk = _Chunk(season, replicas, np.random.Generator(np.random.SFC64(seed)))
    chunk.count.week(0, chunk.rating, chunk.points(chunk.skill), season.players.here(1))
    for week in range(1, season.weeks + 1):
        chunk.play(week)
    return chunk.count.tally(
        Ended(chunk.rating, chunk.wins, chunk.games, chunk.matches, chunk.began)
    )


class _Chunk:
    """The state of the replicas while they are played."""

    def __init__(self, season: Season, replicas: int, rng: np.random.Generator) -> None:
        players = season.players
        shape = len(players), replicas
        self.season, self.rng, self.replicas = season, rng, replicas
        self.lookup: Lookup = season.lookup
        self.rating = np.empty(shape, dtype=np.int16)
        self.rating[:] = players.rating[:, None]
        # One column where all replicas are alike: then there is less to look up.
        self.skill: NDArray[np.floating[Any]] = players.skill[:, None]
        if players.skill_sd.any():
            drawn = rng.standard_normal(shape, dtype=np.float32)
            self.skill = self.skill + players.skill_sd[:, None] * drawn
        self.wins = np.zeros(shape, dtype=np.int16 if season.weeks < 1000 else np.int32)
        self.games = np.zeros(shape, dtype=np.int32) if season.play == "racks" else None
        columns = replicas if players.absence.any() else 1
        self.matches = np.zeros((len(players), columns), dtype=np.int32)
        self.factors = _factors(season)
        self.began = self.skill
        self.count = Counting(season, replicas)

    def points(self, skill: NDArray[Any]) -> NDArray[np.int16]:
        """Return skills as whole points."""
        return np.rint(np.clip(skill, -_HIGHEST, _HIGHEST)).astype(np.int16)

    def play(self, week: int) -> None:
        """Play a week: its matches, its moves, its drift."""
        players, rng = self.season.players, self.rng
        here = players.here(week)
        today = self.points(self.skill)
        if players.day_sd.any():
            strays = rng.standard_normal(self.rating.shape, dtype=np.float32)
            today = self.points(self.skill + players.day_sd[:, None] * strays)
        absent = None
        if players.absence.any():
            limit = np.minimum(np.rint(np.ldexp(players.absence, 32)), 2.0**32 - 1)
            absent = random_bits(rng, self.rating.shape) < limit.astype(np.uint32)[:, None]
        rounds = self._rounds(week, here)
        before = self.rating if len(rounds) < 2 else self.rating.copy()
        step = max(1, _BLOCK // self.replicas)
        for a, b in rounds:
            for start in range(0, len(a), step):
                some = slice(start, start + step)
                self._block(before, today, absent, a[some], b[some])
        if players.drift.any():
            self.skill = self.skill + players.drift[:, None]
        self.count.week(week, self.rating, self.points(self.skill), here)

    def _rounds(self, week: int, here: NDArray[np.bool_]) -> list[Any]:
        """Return who meets whom, of those who are in the league."""
        schedule, everybody = self.season.schedule, bool(here.all())
        if everybody:
            return list(schedule.pairs(week, self.rng, len(here)))
        if draws_opponents(schedule):
            who = np.flatnonzero(here)
            return [(who[a], who[b]) for a, b in schedule.pairs(week, self.rng, len(who))]
        rounds = []
        for a, b in schedule.pairs(week, self.rng, len(here)):
            both = here[a] & here[b]
            rounds.append((a[both], b[both]))
        return rounds

    def _block(
        self,
        before: NDArray[np.int16],
        today: NDArray[np.int16],
        absent: NDArray[np.bool_] | None,
        a: NDArray[np.intp],
        b: NDArray[np.intp],
    ) -> None:
        """Play matches in which nobody occurs twice."""
        look = self.lookup
        apart = before.take(a, axis=0)
        apart -= before.take(b, axis=0)
        np.clip(apart, -look.widest, look.widest, out=apart)
        gap = today.take(a, axis=0)
        gap -= today.take(b, axis=0)
        np.clip(gap, -look.gap, look.gap, out=gap)
        row = gap.astype(np.intp)
        row += look.gap
        cell = row * look.width + look.widest + apart
        place = apart.astype(np.intp)
        place += look.widest
        played = None
        if absent is not None:
            played = ~(absent.take(a, axis=0) | absent.take(b, axis=0))
        won, score = self._draw(row, cell, place)
        one, two = self._moves(place, won, score)
        if self.factors is not None:
            factor = self._factor(a), self._factor(b)
            one, two = one * factor[0], two * factor[1]
        lost = ~won
        self.count.matches(cell, won, played)
        if score is not None:
            self.count.scores(row, place, score, played)
        if played is not None:
            one, two, won, lost = one * played, two * played, won & played, lost & played
        many = np.ones((len(a), 1), dtype=bool) if played is None else played
        for rows, move, wins in ((a, one, won), (b, two, lost)):
            _add(self.rating, rows, move)
            _add(self.wins, rows, wins)
            _add(self.matches, rows, many)
        if self.games is not None:
            for rows, games in zip((a, b), look.won_games, strict=True):
                _add(self.games, rows, games.take(place * look.outcomes + score) * many)

    def _draw(
        self, row: NDArray[Any], cell: NDArray[Any], place: NDArray[Any]
    ) -> tuple[NDArray[np.bool_], NDArray[Any] | None]:
        """Return where player 1 wins and, where that is drawn, which final score it is."""
        look = self.lookup
        if self.season.play == "racks":
            score = play_racks(look, row, place, self.rng)
        elif look.by_winner is None:
            score = draw_scores(look, row, place, self.rng)
        else:
            return draw_winners(look, cell, self.rng), None
        return score < look.needs[1].take(place), score

    def _moves(
        self, place: NDArray[Any], won: NDArray[np.bool_], score: NDArray[Any] | None
    ) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return the points that established players move."""
        look = self.lookup
        if look.steps is not None:
            up, down = look.steps
            one = won * np.int16(up - down)
            two = np.int16(up) - one
            one += np.int16(down)
            return one, two
        if look.by_winner is not None:
            tables, where = look.by_winner, 2 * place + won
        else:
            tables, where = look.moves, place * look.outcomes + score
        return tables[0].take(where), tables[1].take(where)

    def _factor(self, rows: NDArray[np.intp]) -> NDArray[np.int16]:
        """Return by what factor these players move: newcomers move more."""
        last = len(self.factors) - 1
        before = np.minimum(self.season.players.played[rows], last)[:, None]
        return self.factors.take(np.minimum(before + self.matches.take(rows, axis=0), last))


def _factors(season: Season) -> NDArray[np.int16] | None:
    """Return by what factor a player moves after 0, 1, 2, ... matches, or None: nobody is new."""
    steps = season.system.newcomer_steps
    last = sum(matches for matches, _ in steps)
    if not (season.players.played < last).any():
        return None
    return np.array([step_after(played, steps) for played in range(last + 1)], dtype=np.int16)


def _add(to: NDArray[Any], rows: NDArray[np.intp], what: NDArray[Any]) -> None:
    """Add to rows of which none occurs twice."""
    if to.shape[1] == 1:  # a column alone is much faster as a line
        line = to[:, 0]
        line[rows] = line.take(rows) + what[:, 0]
    else:
        found = to.take(rows, axis=0)
        found += what
        to[rows] = found
