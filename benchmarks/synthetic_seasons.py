"""Seasons of any size to time `fit`, `walk_forward` and `validate` with.

In a `season` players differ in how often they come; a third of them join later and begin weaker.
A `federation` has clubs of 20 to 100 players, one match in ten across them, and newcomers every
week. `python benchmarks/synthetic_seasons.py 20000 400 > season.csv` writes a season as a results
file, `python benchmarks/synthetic_seasons.py 1000000 100000 federation` a federation.
"""

from __future__ import annotations

import sys

import numpy as np
from scipy.special import expit

from evenbreak.ratings import Results

SPREAD, BELOW = 0.5, 0.3


def season(matches: int, players: int, **more: float) -> Results:
    """Return races to 5, 6 or 7 of players whose skills are normal with spread 0.5."""
    return season_with_truth(matches, players, **more)[0]  # type: ignore[arg-type]


def season_with_truth(
    matches: int,
    players: int,
    *,
    days: int = 250,
    years: float = 1.0,
    drift: float = 0.0,
    seed: int = 1,
) -> tuple[Results, np.ndarray]:
    """Return the same, and by how much player a is better in each match, in log-odds.

    Skills move by `drift` in a year, on a random walk.
    """
    rng = np.random.default_rng(seed)
    joins = np.where(rng.random(players) < 1 / 3, rng.integers(0, days * 4 // 5, players), 0)
    skill = rng.normal(0.0, SPREAD, players) - BELOW * (joins > 0)
    often = rng.gamma(0.7, 1.0, players) + 0.02
    day = np.sort(rng.integers(0, days, matches))
    a = np.concatenate(
        [_drawn(rng, often * (joins <= one), k) for one, k in enumerate(np.bincount(day))]
    )
    b = np.concatenate(
        [_drawn(rng, often * (joins <= one), k) for one, k in enumerate(np.bincount(day))]
    )
    b = np.where(a == b, (b + 1) % players, b)
    moved = np.zeros((days, players))
    if drift:
        steps = rng.normal(0.0, drift * np.sqrt(years / days), (days, players))
        moved = steps.cumsum(0) - steps.cumsum(0).mean(1, keepdims=True)
    better = skill[a] - skill[b] + moved[day, a] - moved[day, b]
    won, lost = _scores(rng, better)
    played = Results(
        tuple(f"Player {k:04d}" for k in range(players)), a, b, won, lost,
        date=np.datetime64("2018-01-01") + (day * (365.0 * years / days)).astype(int),
    )  # fmt: skip
    return played, better


def _drawn(rng: np.random.Generator, weight: np.ndarray, many: int) -> np.ndarray:
    return rng.choice(len(weight), many, p=weight / weight.sum())


WEEKS = 104
ACROSS = 0.1
CLUB_SPREAD = 0.3


def federation(matches: int, players: int, *, seed: int = 1) -> tuple[Results, np.ndarray]:
    """Return two years of races to 5, 6 or 7, and the players' true skills in log-odds.

    Half of the players are there from the start; every week others join, who begin weaker.
    """
    rng = np.random.default_rng(seed)
    sizes = rng.integers(20, 101, players // 20 + 1)
    club = np.repeat(np.arange(len(sizes)), sizes)[:players]
    first = np.searchsorted(club, club)
    size = np.bincount(club)[club]
    joins = np.where(rng.random(players) < 0.5, rng.integers(1, WEEKS - 10, players), 0)
    joins[first == np.arange(players)] = 0  # somebody to play against
    joins[np.minimum(first + 1, players - 1)] = 0
    skill = rng.normal(0.0, SPREAD, players) + rng.normal(0.0, CLUB_SPREAD, len(sizes))[club]
    skill -= BELOW * (joins > 0)
    often = np.cumsum(rng.gamma(2.0, 1.0, players))
    week, a, b = (np.zeros(0, dtype=np.int64) for _ in range(3))
    while len(week) < matches:
        drawn = matches - len(week) + 1000
        when = rng.integers(0, WEEKS, drawn)
        one = np.searchsorted(often, rng.random(drawn) * often[-1])
        other = first[one] + rng.integers(0, size[one])
        other = np.where(rng.random(drawn) < ACROSS, rng.integers(0, players, drawn), other)
        there = (joins[one] <= when) & (joins[other] <= when) & (one != other)
        week, a, b = (
            np.append(kept, new[there])[:matches]
            for kept, new in ((week, when), (a, one), (b, other))
        )
    order = np.argsort(week, kind="stable")
    a, b, day = a[order], b[order], 7 * week[order]
    won, lost = _scores(rng, skill[a] - skill[b])
    names = tuple(f"Player {k:07d}" for k in range(players))
    return Results(names, a, b, won, lost, date=np.datetime64("2024-01-01") + day), skill


def _scores(rng: np.random.Generator, difference: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the scores of races to 5, 6 or 7."""
    race = rng.integers(5, 8, len(difference))
    won = (rng.random((len(difference), 13)) < expit(difference)[:, None]).cumsum(1)
    lost = np.arange(1, 14) - won
    end = ((won == race[:, None]) | (lost == race[:, None])).argmax(1)
    rows = np.arange(len(end))
    return won[rows, end], lost[rows, end]


def main() -> None:
    """Write a season or a federation."""
    matches, players = map(int, sys.argv[1:3])
    if sys.argv[3:] == ["federation"]:
        made, _ = federation(matches, players)
    else:
        made = season(matches, players, years=float(sys.argv[3]) if sys.argv[3:] else 1.0)
    print("date,player_a,player_b,score_a,score_b")
    for row in zip(
        made.date, made.player_a, made.player_b, made.score_a, made.score_b, strict=True
    ):
        day, a, b, won, lost = row
        print(day, made.players[a], made.players[b], won, lost, sep=",")


if __name__ == "__main__":
    main()
