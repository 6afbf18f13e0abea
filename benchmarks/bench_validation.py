"""What comes before ratings and what judges them: reading results, and walking through a season."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.optimize import minimize
from scipy.special import expit
from synthetic_seasons import season

from evenbreak.files import read_results
from evenbreak.ratings import Results
from evenbreak.ratings.validation.walk_forward import walk_forward

Beside = Callable[..., float]

ROWS = 100_000


def test_results_from_a_frame(beside: Beside, tmp_path: Path) -> None:
    """A data frame takes no more than twice as long as the same rows in a file."""
    played = season(ROWS, ROWS // 10)
    names = np.array(played.players)
    frame = pd.DataFrame(
        {
            "date": played.date.astype(str),
            "player_a": names[played.player_a],
            "player_b": names[played.player_b],
            "score_a": played.score_a,
            "score_b": played.score_b,
        }
    )
    path = tmp_path / "season.csv"
    frame.to_csv(path, index=False)
    ratio = beside(
        f"{ROWS:,} matches from a data frame / from a CSV file",
        lambda: Results.from_frame(frame),
        lambda: read_results(path),
        rounds=3,
    )
    assert ratio < 2.0


MATCHES, PLAYERS, DATES = 10_000, 500, 100
TAU = 4.0  # the prior precision, in log-odds


def bare_refit(
    a: np.ndarray, b: np.ndarray, won: np.ndarray, games: np.ndarray, start: np.ndarray
) -> np.ndarray:
    """Return the mode after some matches, by a plain page of scipy."""
    many = len(start)

    def cost(s: np.ndarray) -> float:
        apart = s[a] - s[b]
        return float((games * np.logaddexp(0.0, apart) - won * apart).sum() + TAU * s @ s / 2.0)

    def gradient(s: np.ndarray) -> np.ndarray:
        miss = games * expit(s[a] - s[b]) - won
        return np.bincount(a, miss, many) - np.bincount(b, miss, many) + TAU * s

    def hessian_times(s: np.ndarray, step: np.ndarray) -> np.ndarray:
        apart = s[a] - s[b]
        pull = games * expit(apart) * expit(-apart) * (step[a] - step[b])
        return np.bincount(a, pull, many) - np.bincount(b, pull, many) + TAU * step

    how: dict[str, Any] = {"method": "Newton-CG", "options": {"xtol": 1e-8}}
    return minimize(cost, start, jac=gradient, hessp=hessian_times, **how).x


def bare_walk(played: Results) -> np.ndarray:
    """Return the differences before each match, each date refitted from the one before."""
    a, b, won = played.player_a, played.player_b, played.score_a
    date_of = np.unique(played.date, return_inverse=True)[1]
    skill, differences = np.zeros(len(played.players)), np.zeros(len(played))
    for day in range(int(date_of[-1]) + 1):
        before, today = date_of < day, date_of == day
        games = (won + played.score_b)[before]
        skill = bare_refit(a[before], b[before], won[before], games, skill)
        differences[today] = skill[a[today]] - skill[b[today]]
    return differences


def test_a_walk_through_a_season(beside: Beside) -> None:
    """The bare side has no standard deviations, which are most of the work of ours."""
    played = season(MATCHES, PLAYERS, days=DATES)
    ours = walk_forward(played, prior_sd=TAU**-0.5)
    worst = np.abs(ours.difference - bare_walk(ours.results)).max()
    assert worst < 1e-4
    beside(
        f"walk through {MATCHES:,} matches on {DATES} dates / bare Newton-CG for each date",
        lambda: walk_forward(played, prior_sd=TAU**-0.5),
        lambda: bare_walk(ours.results),
        rounds=1,
        note=f"differences within {worst:.0e}",
    )
