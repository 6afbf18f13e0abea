"""One league played under several handicap systems: the sums for each system.

Every replica of the league is drawn once (`evenbreak.league.world`) and played by each system in
turn. Sums are kept for groups of replicas, which are independent of each other, so that the error
of any measure, and of the difference between two systems, follows from its variation between
groups.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass, fields
from itertools import combinations
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints, array_values
from evenbreak.checks import seed_of, whole
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.handicaps.systems.history import Entries, History, Matches
from evenbreak.handicaps.systems.system import System, checked_races, checked_ratings, updated
from evenbreak.league.race_tables import RaceTables, known_tables
from evenbreak.league.world import Night, Play, World
from evenbreak.ratings.scale import SCALES
from evenbreak.workers import in_order

if TYPE_CHECKING:
    import distributed

EVEN = 0.6
"""A match is even if neither player's chance is higher than this, given their true skills."""

DECILES = 10
"""Number of groups of players by true skill, if there are as many players."""

GROUPS = 40
"""Number of groups of replicas, if there are as many: errors come from them."""

_AT_ONCE = 1 << 13
"""Approximate number of players simulated at a time: replicas times players."""

_INNINGS = 0.1
"""Games that a player with average skill wins per inning; a doubling above that, twice as many.

With this, the first to finish wins with the chance that the skills give. No league publishes its
innings: at this rate, the levels under the reported innings rule (`apa-like`) stay the same on
average.
"""

Captains = Callable[["Doublings", Floats, Floats, Floats], tuple[Ints, Ints]]
"""A function for two teams' lineups: from the system, the published numbers of each team's players
present, and two uniform numbers, to the positions of those who play, equally many on each team."""


class Doublings:
    """How the numbers that a system publishes relate to the skills in a world."""

    def __init__(self, system: System, world: World) -> None:
        self.system, self.world = system, world
        chart = system.chart
        self.levels: Floats | None = None
        if system.publishes == "levels" and isinstance(chart, LevelChart):
            points = level_skills(chart).points / 100.0
            self.levels, self.points = np.asarray(chart.levels, dtype=float), points - points.mean()
        scale = system.scale or world.scale
        same = scale.same_points(world.scale) or scale.name not in SCALES
        self.zero = world.origin if same else float(scale.center)
        self.doubling = scale.points_per_doubling

    @property
    def fixed(self) -> bool:
        """Whether it is known which skill a number corresponds to."""
        return self.levels is not None or (
            self.system.publishes == "ratings" and self.system.scale is not None
        )

    def skill(self, published: Floats) -> Floats:
        """Return the skill that a published number means, or the number if that is unknown."""
        if self.levels is not None:
            return np.asarray(np.interp(published, self.levels, self.points))
        if not self.fixed:
            return published
        return np.asarray((published - self.zero) / self.doubling)

    def entries(self, play: Play) -> Entries:
        """Return the players as their league would state them to the system."""
        world, shape = self.world, play.entry.shape
        played, games = world.players.played, np.full(len(world.players), -1)
        rating = np.rint(self.zero + self.doubling * play.entry)
        if not self.fixed:  # nothing says which number a skill has: everybody starts afresh
            rating[:] = np.nan
            played = np.zeros_like(played)
        elif world.games is not None:
            games = np.asarray(world.games)
        level = np.full(shape, np.nan)
        if world.level is not None:
            level[: len(world.level)] = np.asarray(world.level)[:, None]
        if self.levels is not None:
            guess = self.levels[np.abs(play.entry[..., None] - self.points).argmin(axis=-1)]
            level = np.where(np.isnan(level), guess, level)
        counts = (
            np.broadcast_to(world.extended(column, 0), shape).astype(np.int64)
            for column in (played, games)
        )
        return Entries.of(rating, level, *counts)


@array_values
@dataclass(frozen=True, eq=False)
class Contest:
    """Sums over the replicas of a world, by system and group of replicas.

    Parameters
    ----------
    replicas
        in each group, shape (groups,).
    matches
        shape (systems, groups, 7): matches, even matches, the better players' chances, games,
        matches with equal skills (without a better player), matches whose race is right, and the
        chances of players a doubling better than their race expects.
    nights
        shape (systems, groups, 3): nights, the games of the player (or team) with the most games on
        each, and published numbers that changed.
    deciles
        shape (systems, groups, deciles, 3): the players' matches, their chances of winning, and
        their even matches, by true skill at the start from the weakest up.
    titles
        shape (systems, groups, deciles): seasons won by players (or teams) in each decile.
    weeks
        shape (systems, groups, nights + 1, 6): players; of the numbers published (as skills, in
        doublings) and the true skills the sums of squares and of products about their means in
        a replica, in the order xx, xy, yy; the sum of the differences of the two means; replicas.
    newcomers
        shape (systems, groups, nights + 1, 4): the same for newcomers, without means, by the number
        of nights since they joined.
    dumped
        shape (systems, groups, 2, 2): matches that count and wins in them, for others and for
        sandbaggers.
    players
        shape (systems, groups, players, 2): each player's matches and wins.
    """

    replicas: Ints
    matches: Floats
    nights: Floats
    deciles: Floats
    titles: Floats
    weeks: Floats
    newcomers: Floats
    dumped: Floats
    players: Floats


class _Side:
    """One system's progress through the replicas in a chunk."""

    def __init__(self, system: System, play: Play, sums: _Sums, captains: Captains | None) -> None:
        self.system, self.play, self.world, self.sums = system, play, play.world, sums
        self.captains = captains
        self.doublings = Doublings(system, play.world)
        shape = play.skill.shape
        self.entries = self.doublings.entries(play)
        self.ratings = checked_ratings(system, system.initial(self.entries), shape, "initial")
        self.initial, self.kept = self.ratings, dict[str, Any]()
        self.asks_innings = "innings" in system.asks
        rows = play.world.matches * play.world.nights
        self.held = {
            name: np.empty((rows, shape[1]), dtype=kind)
            for name, kind in _COLUMNS.items()
            if self.asks_innings or not name.startswith("innings")
        }
        self.night = np.empty(rows, dtype=np.int64)
        self.used = 0
        self.wins = np.zeros((play.world.sides if play.world.teams is not None else shape[0],
                              shape[1]))  # fmt: skip

    def play_night(self, night: Night, tables: RaceTables) -> None:
        """Play a night's matches and publish the resulting numbers."""
        sums, many = self.sums, self.play.replicas
        a, b = self._pairs(night)
        columns = np.arange(many)
        a, b = np.broadcast_to(a, (len(a), many)), np.broadcast_to(b, (len(b), many))
        at_a, at_b = np.maximum(a, 0) * many + columns, np.maximum(b, 0) * many + columns
        played = (a >= 0) & (b >= 0) & night.here.take(at_a) & night.here.take(at_b)
        rated = self.ratings.take(at_a), self.ratings.take(at_b)
        m, n = checked_races(self.system, *rated)
        true = self.play.skill.take(at_a) - self.play.skill.take(at_b)
        place = tables.places(m, n, true)
        chance, race = tables.chances.take(place), tables.numbers(place)
        gap = night.skill.take(at_a) - night.skill.take(at_b)
        place = tables.places(m, n, gap)
        score_a, score_b = tables.scores(place, m, n, night.luck[: len(a)])
        won = score_a == m
        each = (score_a + score_b, tables.right(race, true), tables.worth.take(race))
        sums.count_matches(at_a, at_b, played, chance, true, each)
        both = [at[played] for at in (at_a, at_b)]
        self._count_wins(night, both, won[played])
        values = {"a": np.where(played, a, -1), "b": np.where(played, b, -1)}
        values |= {"score_a": score_a, "score_b": score_b, "race_a": m, "race_b": n}
        values |= {"rating_a": rated[0], "rating_b": rated[1]}
        if self.asks_innings:
            games = np.maximum(score_a + score_b, 1)
            normal = self.play.innings(games.shape)
            pace = _INNINGS * (np.exp2(night.skill.take(at_a)) + np.exp2(night.skill.take(at_b)))
            spread = (1.0 - 1.0 / (9.0 * games) + normal / (3.0 * np.sqrt(games))) ** 3
            values["innings_a"] = values["innings_b"] = np.rint(games * spread / pace)
        self._publish(night, values)
        sums.count_night(self, night, played, at_a, at_b, score_a + score_b)

    def _count_wins(self, night: Night, both: list[Ints], won: Bools) -> None:
        """Count a night's wins: for the title, for the gain from dumping, and for each player."""
        sums, size = self.sums, self.play.skill.size
        winner = np.where(won, *both)
        wins = np.bincount(winner, minlength=size).reshape(self.play.skill.shape)
        games = np.bincount(np.concatenate(both), minlength=size).reshape(wins.shape)
        sums.count_players(games, wins, self.play.dumps if night.counts else None)
        team = self.world.team
        if team is None:
            self.wins += wins
        else:
            np.add.at(self.wins, team, wins)
        if night.night % self.world.weeks == 0:
            first = self.wins == self.wins.max(axis=0)
            sums.count_titles(first / first.sum(axis=0))
            self.wins[:] = 0

    def _publish(self, night: Night, values: dict[str, Any]) -> None:
        some = slice(self.used, self.used + len(values["a"]))
        self.night[some] = night.night
        for name, column in self.held.items():
            column[some] = values[name]
        self.used = some.stop
        played = {name: column[: self.used] for name, column in self.held.items()}
        matches = Matches(night=self.night[: self.used], **played)
        self.history = History(self.entries, self.initial, self.ratings, night.night, matches,
                               kept=self.kept)  # fmt: skip
        self.before, self.ratings = self.ratings, updated(self.system, self.history)

    def _pairs(self, night: Night) -> tuple[Ints, Ints]:
        """Return which players meet; in a team league, by the captains' lineups."""
        if self.world.team is None:
            return night.a, night.b
        ups = [self._line_up(team, night) for team in range(self.world.sides)]
        pairs = [
            self._best(night, (a, b), (ups[a], ups[b]))
            for a, b in zip(night.a[:, 0].tolist(), night.b[:, 0].tolist(), strict=True)
        ]
        return np.concatenate([a for a, _ in pairs]), np.concatenate([b for _, b in pairs])

    def _members(self, team: int, night: Night) -> Ints:
        holder = self.world.holders(night.night)
        return np.asarray(holder[(holder >= 0) & (np.asarray(self.world.teams) == team)])

    def _line_up(self, team: int, night: Night) -> Ints:
        """Return whom a captain with a habit puts up: anyone present, if the cap allows."""
        world, sets, rows = self.world, self.world.sets, self._members(team, night)
        groups = np.array(list(combinations(range(len(rows)), sets)))
        pick = night.pick[rows] - 10.0 * ~night.here[rows]
        wish = pick[groups].sum(axis=1)
        if world.cap is not None and self.system.publishes == "levels":
            wish -= 100.0 * np.maximum(self.ratings[rows][groups].sum(axis=1) - world.cap, 0.0)
        chosen = rows[groups[wish.argmax(axis=0)]].T
        order = np.take_along_axis(night.pick, chosen, axis=0).argsort(axis=0)
        return np.take_along_axis(chosen, order, axis=0)

    def _best(
        self, night: Night, teams: tuple[int, int], usual: tuple[Ints, Ints]
    ) -> tuple[Ints, Ints]:
        """Return the captains' best lineups, or the usual ones if too few players are present."""
        if self.captains is None:
            return usual
        ours, theirs = (side.copy() for side in usual)
        rows = [self._members(team, night) for team in teams]
        for replica in range(self.play.replicas):
            there = [side[night.here[side, replica]] for side in rows]
            if min(map(len, there)) < self.world.sets:
                continue
            mine, others = (self.ratings[side, replica] for side in there)
            luck = np.array([night.pick[side[0], replica] for side in there])
            places = self.captains(self.doublings, mine, others, luck)
            for up, side, place in zip((ours, theirs), there, places, strict=True):
                chosen = side[place]
                up[:, replica] = chosen[night.pick[chosen, replica].argsort()]
        return ours, theirs


_COLUMNS: dict[str, Any] = {
    **dict.fromkeys(("a", "b"), np.int64),
    **dict.fromkeys(("score_a", "score_b", "race_a", "race_b"), np.int32),
    **dict.fromkeys(("rating_a", "rating_b"), np.float64),
    **dict.fromkeys(("innings_a", "innings_b"), np.float64),
}


class _Sums:
    """One system's sums over a chunk, by group."""

    def __init__(self, play: Play, groups: Ints) -> None:
        world, many = play.world, int(groups.max()) + 1
        self.play, self.groups, self.many = play, groups, many
        players, parts = play.skill.shape[0], min(DECILES, play.skill.shape[0])
        self.parts = min(DECILES, world.sides if world.teams is not None else players)
        ranks = play.skill.argsort(axis=0).argsort(axis=0)
        self.key = groups * parts + ranks * parts // players
        strength = play.skill
        if world.teams is not None:
            first = play.skill[: len(world.players)]
            strength = np.stack([first[np.asarray(world.teams) == team].mean(axis=0)
                                 for team in range(world.sides)])  # fmt: skip
        ranks = strength.argsort(axis=0).argsort(axis=0)
        self.title_key = groups * self.parts + ranks * self.parts // len(strength)
        nights = world.nights + 1
        self.matches, self.nights = np.zeros((many, 7)), np.zeros((many, 3))
        self.deciles, self.titles = np.zeros((many, parts, 3)), np.zeros((many, self.parts))
        self.weeks, self.newcomers = np.zeros((many, nights, 6)), np.zeros((many, nights, 4))
        self.dumped, self.players = np.zeros((many, 2, 2)), np.zeros((many, players, 2))
        self.starts = np.searchsorted(groups, np.arange(many))

    def by_group(self, values: Any) -> Floats:
        """Return the sums for each group, with the replicas on the last axis."""
        return np.asarray(np.add.reduceat(values, self.starts, axis=-1), dtype=float)

    def count_matches(
        self, at_a: Ints, at_b: Ints, played: Bools, chance: Floats, true: Floats, each: Any
    ) -> None:
        """Count a night's matches: how even they are, their games, and how right the races are."""
        even = played & (np.maximum(chance, 1.0 - chance) <= EVEN)
        better = np.where(true > 0, chance, 1.0 - chance)
        better = np.where(true == 0, 0.5, better)
        games, *of_races = (value * played for value in each)
        values = (played, even, better * played, games, played & (true == 0), *of_races)
        for k, value in enumerate(values):
            self.matches[:, k] += self.by_group(value.sum(axis=0, dtype=float))
        shape = self.deciles.shape[:2]
        for at, own in ((at_a, chance), (at_b, 1.0 - chance)):
            key = self.key.take(at).ravel()
            for k, value in enumerate((played, own * played, even)):
                counted = np.bincount(key, value.ravel(), shape[0] * shape[1])
                self.deciles[..., k] += counted.reshape(shape)

    def count_players(self, games: Ints, wins: Ints, dumps: Bools | None) -> None:
        """Count each player's matches and wins, and those that count, by who holds back."""
        for k, value in enumerate((games, wins)):
            self.players[..., k] += self.by_group(value).T
            if dumps is not None:
                for who, rows in enumerate((~dumps, dumps)):
                    self.dumped[:, who, k] += self.by_group((value * rows).sum(axis=0))

    def count_titles(self, share: Floats) -> None:
        """Count a season's titles, which players with equal results share."""
        size = self.titles.size
        counted = np.bincount(self.title_key.ravel(), share.ravel(), size)
        self.titles += counted.reshape(self.titles.shape)

    def count_start(self, side: _Side) -> None:
        """Count the errors of the numbers before the first night."""
        self._count_errors(side, 0, side.world.holders(1))

    def count_night(
        self, side: _Side, night: Night, played: Bools, at_a: Ints, at_b: Ints, games: Ints
    ) -> None:
        """Count a night's length, the numbers published after it, and their errors."""
        shape = self.play.skill.shape
        each: Floats = np.zeros(shape)
        for at in (at_a, at_b):
            counted = np.bincount(at[played], games[played], shape[0] * shape[1])
            each += counted.reshape(shape)
        team = side.world.team
        if team is not None:
            of_teams = np.zeros((side.world.sides, shape[1]))
            np.add.at(of_teams, team, each)
            each = of_teams
        # Ratings are printed in whole points.
        shown = [np.rint(x) if side.system.scale else x for x in (side.before, side.ratings)]
        holder = side.world.holders(night.night)
        there = holder[holder >= 0]
        changed = (shown[0][there] != shown[1][there]).sum(axis=0)
        for k, value in enumerate((np.ones(shape[1]), each.max(axis=0), changed)):
            self.nights[:, k] += self.by_group(value.astype(float))
        self._count_errors(side, night.night, holder)

    def _count_errors(self, side: _Side, night: int, holder: Ints) -> None:
        rows = holder[holder >= 0]
        published = side.doublings.skill(side.ratings[rows])
        true = side.play.skill[rows]
        x, y = published - published.mean(axis=0), true - true.mean(axis=0)
        offset = published.mean(axis=0) - true.mean(axis=0)
        ones = np.ones(x.shape[1])
        products = [x * x, x * y, y * y]
        values = [len(rows) * ones, *(one.sum(axis=0) for one in products), offset, ones]
        for k, value in enumerate(values):
            self.weeks[:, night, k] += self.by_group(value)
        new = np.flatnonzero(side.world.new[rows])
        if new.size:
            since = np.maximum(night - side.world.spans[0][rows[new]] + 1, 0)
            for k, value in enumerate([np.ones_like(x), *products]):
                np.add.at(self.newcomers[:, :, k].T, since, self.by_group(value[new]))


class _Work(NamedTuple):
    """The data that all workers share."""

    world: World
    systems: tuple[System, ...]
    replicas: int
    seed: int
    captains: Captains | None

    @property
    def groups(self) -> int:
        return min(self.replicas, GROUPS)

    def chunks(self) -> list[tuple[int, int]]:
        """Return the first and last group of each chunk."""
        size = max(1, _AT_ONCE * self.groups // (self.world.many * self.replicas))
        starts = range(0, self.groups, size)
        return [(start, min(start + size, self.groups)) for start in starts]


def play_systems(
    world: World,
    systems: Sequence[System],
    *,
    replicas: int,
    seed: int | np.random.Generator,
    captains: Captains | None = None,
    executor: Executor | distributed.Client | None = None,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Contest:
    """Return the results of replicas of one league under each of the given systems.

    Parameters
    ----------
    systems
        one or more systems; differences are taken from the first.
    replicas
        how many leagues are drawn, 1 or more; good standard errors need at least 40.
    seed
        a whole number from 0, which gives the same sums to the last bit, or a generator.
    captains
        who chooses the players in a team league; None: any player present, as far as the cap
        allows.
    executor, jobs, progress
        as of `simulate`; the result is the same for any number of workers.

    Raises
    ------
    InputError
        if a number is not whole or too small, or a system returns invalid values.
    """
    work = _Work(world, tuple(systems), whole(replicas, "replicas", at_least=1), seed_of(seed),
                 captains)  # fmt: skip
    chunks, parts, done = work.chunks(), [], 0
    if progress is not None:
        progress(0, replicas)
    jobs = min(whole(jobs, "jobs", at_least=1), len(chunks))
    with closing(in_order(_played, work, chunks, executor=executor, jobs=jobs)) as results:
        for part in results:
            parts.append(part)
            done += int(part.replicas.sum())
            if progress is not None:
                progress(done, replicas)
    return Contest(
        np.concatenate([part.replicas for part in parts]),
        **{
            name: np.concatenate([getattr(part, name) for part in parts], axis=1)
            for name in _SUMMED
        },
    )


_SUMMED = tuple(one.name for one in fields(Contest) if one.name != "replicas")


def _played(work: _Work, chunk: tuple[int, int]) -> Contest:
    first, last = chunk
    bounds = work.replicas * np.arange(first, last + 1) // work.groups
    sizes = np.diff(bounds)
    groups = np.repeat(np.arange(last - first), sizes)
    seed = np.random.SeedSequence(work.seed, spawn_key=(first,))
    play = Play(work.world, len(groups), seed)
    tables = known_tables(float(np.sqrt(np.mean(play.form**2))))
    sides = [_Side(system, play, _Sums(play, groups), work.captains) for system in work.systems]
    for side in sides:
        side.sums.count_start(side)
    for night in play:
        for side in sides:
            side.play_night(night, tables)
    return Contest(
        sizes, **{name: np.stack([getattr(side.sums, name) for side in sides]) for name in _SUMMED}
    )
