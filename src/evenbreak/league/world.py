"""A league for comparing handicap systems: the same people, nights and luck for each system.

Skills are in doublings of the odds of a game, 0 in the middle of the league's scale, so that
systems with different scales can be given the strengths of the same players. The draws (skills,
form, absence, opponents, each match's luck) depend only on the seed and never on the system: two
systems differ only in their races and ratings.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Floats, Ints, array_values
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.league.players import LeaguePlayers
from evenbreak.league.schedule import RandomPairing, RoundRobin
from evenbreak.ratings.scale import SCALES, Scale

DUMPED = 3.0
"""How many doublings below their skill a sandbagger plays when it pays."""


class Night(NamedTuple):
    """The draws for a night, the same for every system.

    Nights count from 1, seasons from 0. a and b are positions of players (or numbers of teams), -1
    for an empty place, shape (matches, replicas) or (matches, 1); by player the shape is (players,
    replicas). `skill` of the night, in doublings, includes form, drift and how much a sandbagger
    holds back; `luck` and `pick` are uniform random numbers, by match, and by player for captains
    with a habit. `counts` marks the matches for which sandbaggers hold back in others.
    """

    night: int
    season: int
    a: Ints
    b: Ints
    here: Bools
    skill: Floats
    luck: NDArray[np.float32]
    pick: Floats
    counts: bool


@array_values
@dataclass(frozen=True, eq=False)
class World:
    """A league to be played under several systems.

    Parameters
    ----------
    players
        the players at the start, with ratings and skills in points of `scale`.
    scale
        the scale of these ratings.
    level
        the players' skill levels; NaN where not stated. None: no one has a level.
    games
        the games behind each rating, -1 where not stated. None: not stated for anyone.
    schedule
        who meets whom; None: a round robin of the players, or of the teams.
    weeks, seasons
        number of nights in a season, and of consecutive seasons; ratings carry over from one to the
        next.
    newcomers
        the share of places that newcomers take over in each season, on nights spread over it. A
        newcomer's skill is drawn from a normal distribution like the league's.
    starter_sd
        uncertainty of a newcomer's first rating (standard deviation), in doublings.
    sandbaggers
        the chance that a player is one. In the third quarter of a season sandbaggers play three
        doublings below their skill; the last quarter counts, and in it they play their best.
    teams
        the number of each player's team, from 0; None: a league of individual players.
    sets
        number of matches between two teams on a night.
    cap
        the largest allowed sum of a lineup's levels, if a system publishes levels.

    Raises
    ------
    InputError
        if a parameter has an invalid value.

    >>> world = World(LeaguePlayers.of([92, 80, 71, 64]), SCALES["npl"], weeks=12)
    >>> world.nights, world.many, world.matches
    (12, 5, 2)
    """

    players: LeaguePlayers
    scale: Scale
    level: Floats | None = None
    games: Ints | None = None
    schedule: Any = None
    weeks: int = 30
    seasons: int = 1
    newcomers: float = 0.2
    starter_sd: float = 1.0
    sandbaggers: float = 0.05
    teams: Ints | None = None
    sets: int = 5
    cap: float | None = None
    _rounds: dict[int, tuple[Ints, Ints]] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        put = object.__setattr__
        for name in ("weeks", "seasons", "sets"):
            put(self, name, whole(getattr(self, name), name, at_least=1))
        for name in ("newcomers", "sandbaggers"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise InputError(
                    "{name} must be a share from 0 to 1; you gave {value}",
                    name=name,
                    value=getattr(self, name),
                )
        if self.teams is not None:
            sizes = np.bincount(self.teams)
            if len(sizes) < 2 or sizes.min() < self.sets:
                raise InputError(
                    "team {team} has {n} players; a team league needs two teams, each with at "
                    "least {sets} players for a night's {sets} matches",
                    team=int(sizes.argmin()) + 1,
                    n=int(sizes.min()),
                    sets=self.sets,
                )
        if self.schedule is None:
            put(self, "schedule", RoundRobin(self.sides))

    @property
    def sides(self) -> int:
        """The number of places in the fixtures: players, or teams."""
        return len(self.players) if self.teams is None else int(self.teams.max()) + 1

    @property
    def nights(self) -> int:
        """The total number of nights."""
        return self.weeks * self.seasons

    @property
    def per_season(self) -> int:
        """The number of newcomers in a season."""
        return round(self.newcomers * len(self.players))

    @property
    def many(self) -> int:
        """The total number of players, including newcomers."""
        return len(self.players) + self.per_season * self.seasons

    @property
    def origin(self) -> float:
        """The rating of skill 0: the middle of the scale, or else of the league."""
        if self.scale.name in SCALES:
            return float(self.scale.center)
        return float(np.mean(self.players.rating))

    @cached_property
    def place(self) -> Ints:
        """Each player's place: their own, or the place of the player they follow."""
        first = np.arange(len(self.players))
        # Who is followed is drawn, but the same in all replicas and for all seeds.
        drawn = np.random.default_rng(len(first)).permuted(
            np.tile(first, (self.seasons, 1)), axis=1
        )
        return np.concatenate([first, drawn[:, : self.per_season].ravel()])

    @cached_property
    def spans(self) -> tuple[Ints, Ints]:
        """The first and the last night of each player."""
        many, new = len(self.players), self.per_season
        joins = np.array(self.players.joins, dtype=np.int64)
        leaves = np.where(self.players.leaves > 0, self.players.leaves, self.nights)
        nights = [
            season * self.weeks + 1 + (np.arange(new) * self.weeks) // max(new, 1)
            for season in range(self.seasons)
        ]
        joins = np.concatenate([joins, *nights]).astype(np.int64)
        leaves = np.concatenate([leaves, np.full(self.many - many, self.nights)]).astype(np.int64)
        last: dict[int, int] = {}
        for player, place in enumerate(self.place.tolist()):
            if place in last:
                leaves[last[place]] = min(leaves[last[place]], joins[player] - 1)
            last[place] = player
        return joins, leaves

    @cached_property
    def new(self) -> Bools:
        """Who is a newcomer when they start."""
        listed = np.array(self.players.played == 0)
        return np.concatenate([listed, np.full(self.many - len(listed), True)])

    @cached_property
    def team(self) -> Ints | None:
        """The team of each player, newcomers included."""
        return None if self.teams is None else np.asarray(self.teams)[self.place]

    def extended(self, values: Any, other: float) -> Floats:
        """Return a column of the players, with a different value for the newcomers, as a column."""
        column = np.full(self.many, other)
        column[: len(self.players)] = values
        return column[:, None]

    def holders(self, night: int) -> Ints:
        """Return who has each place on a night; -1 for an empty place."""
        joins, leaves = self.spans
        there = np.flatnonzero((joins <= night) & (night <= leaves))
        holder = np.full(len(self.players), -1)
        holder[self.place[there]] = there
        return holder

    @cached_property
    def matches(self) -> int:
        """The largest number of matches on a night."""
        if isinstance(self.schedule, RandomPairing):
            games = self.sides // 2 * self.schedule.matches_a_week
        else:
            games = max(len(self.fixtures(week)[0]) for week in range(1, self.weeks + 1))
        return games * (1 if self.teams is None else self.sets)

    def fixtures(self, week: int) -> tuple[Ints, Ints]:
        """Return who meets whom in a week of the season, if that is not drawn."""
        if week not in self._rounds:
            rounds = self.schedule.pairs(week, np.random.default_rng(week), self.sides)
            sides = [np.concatenate([pair[k] for pair in rounds] or [[]]) for k in (0, 1)]
            self._rounds[week] = sides[0].astype(np.int64), sides[1].astype(np.int64)
        return self._rounds[week]


class Play:
    """The draws for some replicas of a world, night by night.

    >>> world = World(LeaguePlayers.of([92, 80, 71, 64]), SCALES["npl"], weeks=3, newcomers=0)
    >>> [night.a.ravel().tolist() for night in Play(world, 2, np.random.SeedSequence(1))]
    [[0, 1], [0, 2], [0, 3]]
    """

    def __init__(self, world: World, replicas: int, seed: np.random.SeedSequence) -> None:
        self.world, self.replicas = world, replicas
        people, nights, innings = (
            np.random.Generator(np.random.SFC64(child)) for child in seed.spawn(3)
        )
        self.rng, self.innings_rng = nights, innings
        ppd, players = world.scale.points_per_doubling, world.players
        shape = world.many, replicas
        skill = (players.skill - world.origin) / ppd
        self.mean = float(np.mean(skill))
        sd = float(np.sqrt(np.var(skill) + np.mean((players.skill_sd / ppd) ** 2)))
        begun = world.extended(skill, self.mean)
        width = world.extended(players.skill_sd / ppd, sd)
        self.skill: Floats = begun + width * people.standard_normal(shape)
        rated = (players.rating - world.origin) / ppd
        guess = people.standard_normal((world.many - len(players), replicas))
        self.entry = np.concatenate([
            np.tile(rated[:, None], (1, replicas)),
            self.skill[len(players):] + world.starter_sd * guess,
        ])  # fmt: skip
        self.dumps: Bools = people.random(shape) < world.sandbaggers
        self.form = world.extended(players.day_sd / ppd, float(np.mean(players.day_sd)) / ppd)
        self.drift = world.extended(players.drift / ppd, 0.0)
        self.absence = world.extended(players.absence, float(np.mean(players.absence)))

    def innings(self, shape: tuple[int, ...]) -> Floats:
        """Return normal numbers for a night's innings; drawn separately from all others."""
        return self.innings_rng.standard_normal(shape)

    def __iter__(self) -> Iterator[Night]:
        world, rng, shape = self.world, self.rng, self.skill.shape
        for night in range(1, world.nights + 1):
            season, week = divmod(night - 1, world.weeks)
            here = np.zeros(shape, dtype=bool)
            holder = world.holders(night)
            here[holder[holder >= 0]] = True
            if self.absence.any():
                here &= rng.random(shape) >= self.absence
            skill = self.skill
            if self.form.any():
                skill = skill + self.form * rng.standard_normal(shape)
            quarter = 4 * week // world.weeks
            if quarter == 2 and world.sandbaggers:
                skill = skill - DUMPED * self.dumps
            a, b = self._pairs(week + 1, holder)
            luck = rng.random((world.matches, self.replicas), dtype=np.float32)
            pick = rng.random(shape if world.teams is not None else (0, 0))
            yield Night(night, season, a, b, here, skill, luck, pick, quarter == 3)
            if self.drift.any():
                self.skill = self.skill + self.drift

    def _pairs(self, week: int, holder: Ints) -> tuple[Ints, Ints]:
        world = self.world
        if isinstance(world.schedule, RandomPairing):
            who = np.flatnonzero(holder >= 0) if world.teams is None else np.arange(world.sides)
            half, rounds = len(who) // 2, []
            for _ in range(world.schedule.matches_a_week):
                order = who[self.rng.random((len(who), self.replicas)).argsort(axis=0)]
                rounds.append((order[:half], order[half : 2 * half]))
            a, b = (np.concatenate([pair[k] for pair in rounds]) for k in (0, 1))
        else:
            a, b = (side[:, None] for side in world.fixtures(week))
        return (a, b) if world.teams is not None else (holder[a], holder[b])
