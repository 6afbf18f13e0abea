"""Gain from losing on purpose under any system, by simulating many small leagues at once.

This is for systems without a chain to solve. A player and some opponents, all with the same skill,
play one match a night; the opponents stay correctly rated. In one league the player is honest; in
the others, which share all its draws, the player loses the first D matches without a game. Given
the two published numbers, the chance of a match is exact, so only the moves are random; the
remaining uncertainty is stated as an error.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import seed_of, whole
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.ladders.level_ladder import Dumping
from evenbreak.handicaps.systems.history import Entries, History, Matches
from evenbreak.handicaps.systems.system import System, checked_races, updated
from evenbreak.league.race_tables import RaceTables
from evenbreak.stats.summary import Distribution

PLAYERS = 8
"""Number of players in each league: the one who may dump, and the opponents."""

_GAMES_BEFORE = 200
"""Games behind each rating at the start, so that everyone is established."""

_INNINGS = 2.25
"""Innings per game, such that a level-4 player's score is in the middle of that level."""


def dumping_played(
    system: System,
    dumped: Sequence[int],
    *,
    earnest: int = 20,
    in_a_row: int = 3,
    replicas: int = 400,
    seed: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> list[Dumping]:
    """Return the gain from matches lost on purpose, by number, with Monte Carlo errors.

    Parameters
    ----------
    dumped
        the numbers of matches lost on purpose.
    earnest
        the number of matches played in earnest afterward.
    in_a_row
        how many matches in a row win a tournament.
    replicas
        how many leagues are simulated for each number.
    seed
        for all draws.
    progress
        called with the number of leagues done and the total.

    Raises
    ------
    InputError
        if a number is out of range, or the system returns invalid values.

    >>> from evenbreak.handicaps import system_of
    >>> honest, five = dumping_played(system_of("step 3"), [0, 5], earnest=10, replicas=50)
    >>> honest.extra_wins, round(five.published), five.extra_wins > 3 * five.error
    (0.0, -14, True)
    """
    nights = max(dumped) + whole(earnest, "earnest", at_least=1)
    replicas = whole(replicas, "replicas", at_least=2)
    honest, ratings = _play(system, 0, nights, replicas, seed_of(seed))
    rows = []
    for done, many in enumerate(dumped):
        if progress is not None:
            progress(done, len(dumped))
        wins, now = _play(system, many, many + earnest, replicas, seed_of(seed))
        extra = wins[many:].sum(axis=0) - honest[many : many + earnest].sum(axis=0)
        rows.append(
            Dumping(
                many,
                float((now[many] - ratings[many]).mean()),
                float(honest[:many].sum(axis=0).mean()),
                float(wins[many].mean()),
                float((wins[many] ** in_a_row).mean()),
                float(extra.mean()),
                float(extra.std(ddof=1) / np.sqrt(replicas)),
            )
        )
    return rows


def errors_played(
    system: System, *, nights: int = 40, replicas: int = 200, seed: int = 1
) -> Distribution:
    """Return the error of an established player's number, in Fargo points, by simulation.

    The player starts correctly rated and meets equally skilled, correctly rated players; the second
    half of the nights counts.

    >>> from evenbreak.handicaps import system_of
    >>> round(errors_played(system_of("npl")).sd / 100 * 30, 1)  # a ladder has 4.6 in the long run
    4.2
    """
    _, numbers = _play(system, 0, nights, replicas, seed_of(seed))
    strengths = system.strength(np.array(numbers))
    errors = np.rint(strengths[nights // 2 :] - strengths[0]).astype(np.int64)
    values, counts = np.unique(errors, return_counts=True)
    chances = counts / counts.sum()
    return Distribution(tuple(values.tolist()), tuple(chances.tolist()))


def _entries(system: System, replicas: int) -> Entries:
    """Return identical players: at the middle level, or as newcomers to the system."""
    shape = PLAYERS, replicas
    levels = system.chart.levels if isinstance(system.chart, LevelChart) else (4,)
    center = np.nan if system.scale is None else system.scale.center
    rating = system.initial(
        Entries.of(np.full(shape, center), np.full(shape, float(levels[len(levels) // 2])))
    )
    ratings = rating if system.publishes == "ratings" else np.full(shape, np.nan)
    return Entries.of(
        ratings,
        np.full(shape, float(levels[len(levels) // 2])),
        np.full(shape, _GAMES_BEFORE // 5),
        np.full(shape, _GAMES_BEFORE),
    )


def _play(
    system: System, dumped: int, nights: int, replicas: int, seed: int
) -> tuple[Floats, list[Floats]]:
    """Return the first player's chance in each match, and their numbers before each match."""
    rng = np.random.default_rng(seed)
    entries = _entries(system, replicas)
    initial = ratings = system.initial(entries)
    chances, numbers = np.empty((nights, replicas)), []
    parts: list[list[Any]] = [[] for _ in range(11)]
    kept: dict[str, Any] = {}
    tables = RaceTables(0.0)
    for night in range(1, nights + 1):
        a, b = _pairs(night)
        of_a, of_b = ratings[a], ratings[b]
        race_a, race_b = checked_races(system, of_a, of_b)
        places = tables.places(race_a, race_b, np.zeros(race_a.shape))
        chances[night - 1] = tables.chances[places[0]]
        numbers.append(ratings[0])
        score_a, score_b = tables.scores(places, race_a, race_b, rng.random(race_a.shape))
        if night <= dumped:
            score_a[0], score_b[0] = 0, race_b[0]
        innings = np.rint(_INNINGS * (score_a + score_b)).astype(np.int64)
        shape = score_a.shape
        columns = (
            np.full(len(a), night),
            *(np.broadcast_to(who[:, None], shape) for who in (a, b)),
            *(score_a, score_b, race_a, race_b, of_a, of_b, innings, innings),
        )
        for part, column in zip(parts, columns, strict=True):
            part.append(column)
        matches = Matches(*(np.concatenate(part) for part in parts))
        ratings = updated(system, History(entries, initial, ratings, night, matches, kept=kept))
        ratings = np.concatenate([ratings[:1], initial[1:]])
    return chances, numbers


def _pairs(night: int) -> tuple[Ints, Ints]:
    """Return who meets: a new opponent for everyone each night, with the first player first."""
    others = 1 + (np.arange(PLAYERS - 1) + night) % (PLAYERS - 1)
    half = PLAYERS // 2
    return np.array([0, *others[1:half]]), np.array([others[0], *others[half:][::-1]])
