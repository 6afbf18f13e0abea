"""Ratings beside other packages: the same estimates, and who predicts a season better.

    python -m pip install -e . pytest choix evalica openskill glicko2
    python -m pytest -q -s benchmarks/bench_peers.py

The season is the file that SEASON names, or that of the folder beside the project; a test
whose package or season is absent is skipped. Every package predicts a date from the dates
before it; what it has to choose (a prior, a step) is chosen to suit the season, for each.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from evenbreak.files.results import read_results
from evenbreak.ratings import Results, fit, validate

PLACE = Path(__file__).resolve().parents[2] / "shared/data/snooker_2016_17_results.csv"


@cache
def season() -> Results:
    place = Path(os.environ.get("SEASON", PLACE))
    if not place.exists():
        pytest.skip(f"{place.name} is not there")
    played = read_results(place).results.played().results
    assert played.date is not None
    return played.select(np.argsort(played.date, kind="stable"))


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


Walker = Callable[[Results, float], float]


def walk(predict: Callable[[int, int], float], learn: Callable[[Results], None]) -> float:
    """Return the log-loss a match winner of a season, each date predicted before it is learnt."""
    results, loss = season(), 0.0
    assert results.date is not None
    for day in np.unique(results.date):
        today = results.select(results.date == day)
        for a, b, m, n in zip(
            today.player_a, today.player_b, today.score_a, today.score_b, strict=True
        ):
            p = predict(int(a), int(b))
            loss -= math.log(p if m > n else 1.0 - p)
        learn(today)
    return loss / len(results)


def elo(step: float) -> float:
    rating = np.zeros(len(season().players))

    def learn(today: Results) -> None:
        rows = zip(today.player_a, today.player_b, today.score_a > today.score_b, strict=True)
        for a, b, won in rows:
            change = step * (won - 1.0 / (1.0 + math.exp(rating[b] - rating[a])))
            rating[a] += change
            rating[b] -= change

    return walk(lambda a, b: 1.0 / (1.0 + math.exp(rating[b] - rating[a])), learn)


def openskill(beta: float) -> float:
    models = pytest.importorskip("openskill.models")
    model = models.PlackettLuce(beta=beta)
    rating = [model.rating() for _ in season().players]

    def learn(today: Results) -> None:
        rows = zip(today.player_a, today.player_b, today.score_a > today.score_b, strict=True)
        for a, b, won in rows:
            pair = [[rating[a]], [rating[b]]] if won else [[rating[b]], [rating[a]]]
            (one,), (other,) = model.rate(pair)
            rating[a], rating[b] = (one, other) if won else (other, one)

    return walk(lambda a, b: float(model.predict_win([[rating[a]], [rating[b]]])[0]), learn)


def glicko(deviation: float) -> float:
    glicko2 = pytest.importorskip("glicko2")
    player = [glicko2.Player(rating=1500, rd=deviation) for _ in season().players]

    def predict(a: int, b: int) -> float:
        one, other = player[a], player[b]
        spread = math.hypot(one.rd, other.rd) * math.log(10.0) / 400.0
        g = 1.0 / math.sqrt(1.0 + 3.0 * (spread / math.pi) ** 2)
        return float(1.0 / (1.0 + 10.0 ** (-g * (one.rating - other.rating) / 400.0)))

    def learn(today: Results) -> None:
        games: dict[int, list[tuple[float, float, bool]]] = {}
        rows = zip(today.player_a, today.player_b, today.score_a > today.score_b, strict=True)
        for a, b, won in rows:
            games.setdefault(int(a), []).append((player[b].rating, player[b].rd, bool(won)))
            games.setdefault(int(b), []).append((player[a].rating, player[a].rd, not won))
        for k, played in games.items():
            ratings, deviations, outcomes = zip(*played, strict=True)
            player[k].update_player(list(ratings), list(deviations), list(outcomes))

    return walk(predict, learn)


PEERS: dict[str, tuple[Callable[[float], float], tuple[float, ...]]] = {
    "Elo on matches": (elo, (0.1, 0.15, 0.2, 0.3, 0.4)),
    "openskill PlackettLuce": (openskill, (25 / 6, 25 / 3, 12.5, 25.0, 40.0)),
    "glicko2": (glicko, (60.0, 90.0, 120.0, 180.0, 350.0)),
}


@pytest.mark.parametrize("name", PEERS)
def test_match_winners_are_predicted_no_worse(name: str) -> None:
    walker, choices = PEERS[name]
    tried = {choice: walker(choice) for choice in choices}
    best = min(tried, key=tried.__getitem__)
    told = our_rows()
    print(f"\n{name}: {tried[best]:.4f} at {best:g}; all {[f'{x:.4f}' for x in tried.values()]}")
    print(", ".join(f"{row.how} {row.log_loss.value:.4f} at {row.prior_sd:.2f}" for row in told))
    assert min(row.log_loss.value for row in told) <= tried[best]


@cache
def our_rows() -> tuple[Any, ...]:
    return tuple(row for row in validate(season()).scored if row.of == "match")
