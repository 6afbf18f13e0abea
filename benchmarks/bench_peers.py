"""Ratings beside other packages: the same estimates, and who predicts a season better.

    python -m pip install -e . pytest choix evalica openskill glicko2 trueskill whole-history-rating
    python -m pytest -q -s benchmarks/bench_peers.py

The season is that of the folder beside the project; a test whose package or season is absent is
skipped. How engines are compared is said in `fairness.py`, which prints the tables.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from fairness import PLACE, installed, judged_engines, real

from evenbreak.ratings import Results, fit


@cache
def season() -> Results:
    if not PLACE.exists():
        pytest.skip(f"{PLACE.name} is not there")
    return real(PLACE)[0].played


def single_games(results: Results) -> list[tuple[int, int]]:
    """Return (winner, loser) of every game."""
    games = []
    rows = zip(results.player_a, results.player_b, results.score_a, results.score_b, strict=True)
    for a, b, m, n in rows:
        games += [(int(a), int(b))] * int(m) + [(int(b), int(a))] * int(n)
    return games


def timed(action: Callable[[], Any]) -> tuple[Any, float]:
    begin = time.perf_counter()
    return action(), time.perf_counter() - begin


def test_estimates_agree_with_choix() -> None:
    choix = pytest.importorskip("choix")
    results, sd = season(), 0.5
    games = single_games(results)
    # choix adds alpha times the squares, without the half of a normal prior.
    ours, mine = timed(lambda: fit(results, prior_sd=sd))
    options: dict[str, Any] = {"alpha": 0.5 * sd**-2, "method": "Newton-CG", "tol": 1e-12}
    theirs, other = timed(lambda: choix.opt_pairwise(len(results.players), games, **options))
    skill = ours.scale.log_odds(ours.rating - ours.anchor)
    print(f"\nfit: ours {1e3 * mine:.1f} ms, choix {1e3 * other:.1f} ms")
    print(f"largest difference {np.abs(skill - theirs).max():.1e} in log-odds")
    assert np.abs(skill - theirs).max() < 1e-6


def test_estimates_agree_with_evalica() -> None:
    """Maximum likelihood, where everybody has won and lost against everybody in a chain."""
    evalica = pytest.importorskip("evalica")
    rng = np.random.default_rng(1)
    a = rng.integers(0, 40, 4_000)
    b = (a + rng.integers(1, 40, 4_000)) % 40
    strength = rng.normal(0.0, 0.7, 40)
    won = rng.random(4_000) < 1.0 / (1.0 + np.exp(strength[b] - strength[a]))
    names = tuple(f"p{k:02d}" for k in range(40))
    results = Results(names, a, b, won.astype(int), 1 - won.astype(int))
    ours = fit(results, prior_sd=100.0)
    winners = [evalica.Winner.X if one else evalica.Winner.Y for one in won]
    told = evalica.bradley_terry(
        [names[k] for k in a], [names[k] for k in b], winners, tolerance=1e-12, limit=10_000
    )
    theirs = np.log(np.array([told.scores[name] for name in names]))
    skill = ours.scale.log_odds(ours.rating - ours.anchor)
    # A prior so wide moves nothing that is seen.
    assert np.abs(skill - skill.mean() - theirs + theirs.mean()).max() < 1e-3


def test_no_engine_predicts_better_from_the_same_results() -> None:
    season()
    for row in judged_engines(installed(), real(PLACE)):
        for of in ("game", "match"):
            behind, error = row[f"{of}_behind"], row[f"{of}_behind_error"]
            print(f"\n{row['name']} ({row['settings']}), {of}: {behind:+.4f} ± {error:.4f}")
            assert behind >= -2.0 * error
