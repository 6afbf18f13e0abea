"""Simulate one season match by match, with every rack, as a league would record it.

This module does for one season, in the obvious way, what `evenbreak.league.many_seasons` does for
thousands: its results can be rated like any league's, and it is the reference for the fast version.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints, array_values
from evenbreak.checks import seed_of
from evenbreak.handicaps.systems.by_match import PlayedMatch, UpdateRule
from evenbreak.league.schedule import RandomPairing, Round
from evenbreak.league.season import Season
from evenbreak.ratings.results import Results

FIRST_NIGHT = np.datetime64("2025-01-07")
"""The default date of week 1."""

_APART = 0x6D617463
"""Makes this season's draws independent of those of the replicas with the same seed."""


class _Match(NamedTuple):
    """A match: positions, ratings before, the race, the racks in order, the moves."""

    week: int
    a: int
    b: int
    rating: tuple[int, int]
    race: tuple[int, int]
    racks: str
    points: tuple[int, int]


@array_values
@dataclass(frozen=True, eq=False)
class PlayedSeason:
    """A simulated season, with the true skills, which are unknown in a real season.

    Parameters
    ----------
    results
        the matches, in the order in which they were played: dates, races, scores and racks;
        players in the order of the season.
    week
        the week of each match, from 1.
    rating_a, rating_b
        before each match, in points.
    skill
        true skill before the first week, in points.
    rating
        after the last week, in points.
    skill_after
        true skill after the last week, in points, drift included.
    """

    results: Results
    week: Ints
    rating_a: Ints
    rating_b: Ints
    skill: Floats
    rating: Ints
    skill_after: Floats


def season_matches(season: Season, seed: int | np.random.Generator) -> PlayedSeason:
    """Play one season rack by rack and return its matches.

    In each week, everyone who is present plays at their skill of the day. The ratings before the
    week set its races, and its moves are added at the end of the week, as `apply_results` does for
    a night. Absent players' matches are not played.

    Parameters
    ----------
    seed
        a whole number from 0, which always gives the same season, or a generator.

    Raises
    ------
    InputError
        if the seed is not such a number.

    >>> from evenbreak.handicaps import chart, system_of
    >>> from evenbreak.league import LeaguePlayers, RoundRobin, Season
    >>> club = LeaguePlayers.of([92, 80, 71, 65])
    >>> season = Season(club, system_of("npl"), chart("npl_10"), RoundRobin(4), 3)
    >>> played = season_matches(season, seed=1)
    >>> len(played.results), played.week.tolist(), played.results.date[0]
    (6, [1, 1, 2, 2, 3, 3], np.datetime64('2025-01-07'))
    """
    rng = np.random.default_rng([_APART, seed_of(seed)])
    players = season.players
    rating = np.array(players.rating, dtype=np.int64)
    skill = rng.normal(players.skill, players.skill_sd)
    began, played = skill.copy(), np.array(players.played, dtype=np.int64)
    matches: list[_Match] = []
    for week in range(1, season.weeks + 1):
        there = _there(season, week, rng)
        today = np.rint(skill + rng.normal(0.0, players.day_sd))
        move = np.zeros_like(rating)
        for ones, others in _rounds(season, week, rng):
            for a, b in zip(ones.tolist(), others.tolist(), strict=True):
                if there[a] and there[b]:
                    match = _play(season, week, (a, b), rating, played, today, rng)
                    matches.append(match)
                    move[[a, b]] += match.points
                    played[[a, b]] += 1
        rating += move
        skill = skill + players.drift
    return _played_season(season, matches, began, rating, skill)


def _there(season: Season, week: int, rng: np.random.Generator) -> Bools:
    """Return who plays in a week: members who are not absent."""
    players = season.players
    return np.asarray(players.here(week) & (rng.random(len(players)) >= players.absence))


def _rounds(season: Season, week: int, rng: np.random.Generator) -> list[Round]:
    """Return who meets whom; random opponents are drawn only among the week's members."""
    if not isinstance(season.schedule, RandomPairing):
        return list(season.schedule.pairs(week, rng, len(season.players)))
    who = np.flatnonzero(season.players.here(week))
    return [(who[a], who[b]) for a, b in season.schedule.pairs(week, rng, len(who))]


def _play(
    season: Season,
    week: int,
    pair: tuple[int, int],
    rating: Ints,
    played: Ints,
    today: Floats,
    rng: np.random.Generator,
) -> _Match:
    a, b = pair
    before = int(rating[a]), int(rating[b])
    race = season.chart.race(before[0] - before[1])
    p = season.system.scale.win_probability(float(today[a] - today[b]))
    racks = ""
    while racks.count("a") < race[0] and racks.count("b") < race[1]:
        racks += "a" if rng.random() < p else "b"
    points = _points(season, before, racks, race, (int(played[a]), int(played[b])))
    return _Match(week, a, b, before, race, racks, points)


def _points(
    season: Season,
    rating: tuple[int, int],
    racks: str,
    race: tuple[int, int],
    played: tuple[int, int],
) -> tuple[int, int]:
    """Return the points that the two ratings move; the rule takes the winner first."""
    (r, s), (m, n), (i, j) = rating, race, played
    won, lost = racks.count("a"), racks.count("b")
    rule: UpdateRule = season.system.rule
    if racks[-1] == "a":
        return rule(PlayedMatch((r, s), (won, lost), (m, n), (i, j)))
    up, down = rule(PlayedMatch((s, r), (lost, won), (n, m), (j, i)))
    return down, up


def _played_season(
    season: Season,
    matches: Sequence[_Match],
    began: Floats,
    rating: Ints,
    skill_after: Floats,
) -> PlayedSeason:
    """Return the matches as columns."""
    names = season.players.names or tuple(f"player {k}" for k in range(1, len(rating) + 1))
    columns = np.array(
        [(row.week, row.a, row.b, *row.rating, *row.race) for row in matches], dtype=np.int64
    ).reshape(-1, 7)
    week, a, b, rating_a, rating_b, race_a, race_b = columns.T
    results = Results(
        names,
        a,
        b,
        np.array([row.racks.count("a") for row in matches], dtype=np.int64),
        np.array([row.racks.count("b") for row in matches], dtype=np.int64),
        date=FIRST_NIGHT + 7 * (week - 1),
        race_a=race_a,
        race_b=race_b,
        racks=np.array([row.racks for row in matches], dtype=object),
    )
    return PlayedSeason(results, week, rating_a, rating_b, began, rating, skill_after)
