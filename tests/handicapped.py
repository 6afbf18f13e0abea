"""Handicap leagues whose truth is known, drawn from a chart or from starts by class."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.special import expit

from evenbreak.handicaps import chart
from evenbreak.ratings import Results
from evenbreak.ratings.validation.within_matches import play_races

Race = tuple[int, int]
PLAYERS = 80
CLASSES = np.array(["D", "C", "B", "A"])


def by_chart(
    seed: int,
    *,
    doubling: float = 30.0,
    name: str = "npl_10",
    instead: Mapping[Race, Race] | None = None,
    levels: bool = True,
    matches: int = 2000,
    off: float = 6.0,
    form: float = 10.0,
) -> Results:
    """Return a league with ratings about `off` points off, and with form of `form` points.

    `doubling` points double the odds of a game; the chart plays other races `instead` of its own.
    """
    rng = np.random.default_rng(seed)
    rating = np.rint(rng.normal(80.0, 25.0, PLAYERS)).astype(np.int64)
    a, b = _pairs(rng, matches)
    race_a, race_b = (race.copy() for race in chart(name).races(rating[a] - rating[b]))
    was = race_a.copy(), race_b.copy()
    for (m, n), (new_m, new_n) in (instead or {}).items():
        for mine, theirs, new in ((m, n, (new_m, new_n)), (n, m, (new_n, new_m))):
            rows = (was[0] == mine) & (was[1] == theirs)
            race_a[rows], race_b[rows] = new
    skill = rating + rng.normal(0.0, off, PLAYERS)
    points = skill[a] - skill[b] + rng.normal(0.0, form, matches)
    given = _levels(rating[a], rating[b]) if levels else {}
    return _played(rng, a, b, points * math.log(2.0) / doubling, race_a, race_b, **given)


def by_class(
    seed: int, *, worth: float = 0.5, start: int = 1, named: bool = True, matches: int = 1200
) -> Results:
    """Return a league of four classes, `worth` log-odds apart, with so many games a class in 7."""
    rng = np.random.default_rng(seed)
    of = rng.integers(0, 4, PLAYERS)
    a, b = _pairs(rng, matches)
    apart = of[a] - of[b]
    race_a, race_b = 7 + start * np.minimum(apart, 0), 7 - start * np.maximum(apart, 0)
    skill = worth * of + rng.normal(0.0, 0.2, PLAYERS)
    given = _levels(CLASSES[of[a]], CLASSES[of[b]]) if named else {}
    return _played(rng, a, b, skill[a] - skill[b], race_a, race_b, **given)


def _pairs(rng: np.random.Generator, matches: int) -> tuple[Any, Any]:
    a = rng.integers(0, PLAYERS, matches)
    return a, (a + rng.integers(1, PLAYERS, matches)) % PLAYERS


def _levels(a: Any, b: Any) -> dict[str, Any]:
    return {"level_a": a.astype(str).astype(object), "level_b": b.astype(str).astype(object)}


def _played(
    rng: np.random.Generator, a: Any, b: Any, edge: Any, race_a: Any, race_b: Any, **given: Any
) -> Results:
    won, games = play_races(expit(edge), race_a, race_b, rng)
    names = tuple(f"p{k:02d}" for k in range(PLAYERS))
    dates = np.datetime64("2024-01-02") + np.arange(len(a)) // 40 * 7
    return Results(names, a, b, won, games - won, race_a=race_a, race_b=race_b, date=dates, **given)
