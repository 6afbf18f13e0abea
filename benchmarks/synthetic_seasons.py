"""Seasons of any size to time `walk_forward` and `validate` with.

Players differ in how often they come; a third of them join later and begin weaker.
`python benchmarks/synthetic_seasons.py 20000 400 > season.csv` writes one as a results file.
"""

from __future__ import annotations

import sys

import numpy as np
from scipy.special import expit

from evenbreak.ratings import Results

SPREAD, BELOW = 0.5, 0.3


def season(matches: int, players: int, *, days: int = 250, years: float = 1.0, seed: int = 1):
    """Return races to 5, 6 or 7 of players whose skills are normal with spread 0.5."""
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
    race = rng.integers(5, 8, matches)
    won = (rng.random((matches, 13)) < expit(skill[a] - skill[b])[:, None]).cumsum(1)
    lost = np.arange(1, 14) - won
    end = ((won == race[:, None]) | (lost == race[:, None])).argmax(1)
    rows = np.arange(matches)
    return Results(
        tuple(f"Player {k:04d}" for k in range(players)), a, b, won[rows, end], lost[rows, end],
        date=np.datetime64("2018-01-01") + (day * (365.0 * years / days)).astype(int),
    )  # fmt: skip


def _drawn(rng: np.random.Generator, weight: np.ndarray, many: int) -> np.ndarray:
    return rng.choice(len(weight), many, p=weight / weight.sum())


def main() -> None:
    """Write a season."""
    matches, players = map(int, sys.argv[1:3])
    made = season(matches, players, years=float(sys.argv[3]) if sys.argv[3:] else 1.0)
    print("date,player_a,player_b,score_a,score_b")
    for row in zip(
        made.date, made.player_a, made.player_b, made.score_a, made.score_b, strict=True
    ):
        day, a, b, won, lost = row
        print(day, made.players[a], made.players[b], won, lost, sep=",")


if __name__ == "__main__":
    main()
