"""Ratings of 5,000 players from a million games, beside a bare Newton-CG on the games.

Two leagues: well mixed, and in divisions of a hundred with a thousand games across. And a
federation by size, with other packages beside:

    python -m pip install -e . pytest-benchmark evalica choix glicko2
    PYTHONPATH=benchmarks python -m pytest -q -s benchmarks/bench_ratings.py -k federation

A package that is absent, or whose work or memory grows too fast for a size, is left out there.
"""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.special import expit
from synthetic_seasons import federation

from evenbreak.ratings import Results, fit

Beside = Callable[..., float]

PLAYERS, GAMES = 5_000, 1_000_000
TAU = 1.0  # the prior precision, in log-odds


@cache
def league(kind: str) -> Results:
    """Return a million rows of one game each, by skills drawn with spread 0.7."""
    rng = np.random.default_rng(2026)
    size = PLAYERS if kind == "mixed" else 100
    a = rng.integers(0, PLAYERS, GAMES)
    b = a - a % size + (a % size + rng.integers(1, size, GAMES)) % size
    if kind == "divisions":
        across = rng.integers(0, GAMES, 1_000)
        b[across] = (a[across] + rng.integers(1, PLAYERS, len(across))) % PLAYERS
    skill = rng.normal(0.0, 0.7, PLAYERS)
    won = (rng.random(GAMES) < expit(skill[a] - skill[b])).astype(int)
    return Results(tuple(f"p{k:04d}" for k in range(PLAYERS)), a, b, won, 1 - won)


def bare_fit(winner: np.ndarray, loser: np.ndarray) -> np.ndarray:
    """Return the mode, game by game: what a plain page of scipy does."""

    def cost(skill: np.ndarray) -> float:
        lost_by = np.logaddexp(0.0, skill[loser] - skill[winner])
        return float(lost_by.sum() + 0.5 * TAU * skill @ skill)

    def gradient(skill: np.ndarray) -> np.ndarray:
        miss = expit(skill[loser] - skill[winner])
        return np.bincount(loser, miss, PLAYERS) - np.bincount(winner, miss, PLAYERS) + TAU * skill

    def hessian_times(skill: np.ndarray, step: np.ndarray) -> np.ndarray:
        difference = skill[winner] - skill[loser]
        pull = expit(difference) * expit(-difference) * (step[winner] - step[loser])
        return np.bincount(winner, pull, PLAYERS) - np.bincount(loser, pull, PLAYERS) + TAU * step

    start = np.zeros(PLAYERS)
    options: dict[str, Any] = {"xtol": 1e-9}
    return minimize(
        cost, start, method="Newton-CG", jac=gradient, hessp=hessian_times, options=options
    ).x


@pytest.mark.parametrize("kind", ["mixed", "divisions"])
def test_fit(beside: Beside, kind: str) -> None:
    results = league(kind)
    a_won = results.score_a > 0
    winner = np.where(a_won, results.player_a, results.player_b)
    loser = np.where(a_won, results.player_b, results.player_a)
    ratings = fit(results, prior_sd=TAU**-0.5)
    assert ratings.gradient <= 1e-8
    skill = ratings.scale.log_odds(ratings.rating - ratings.anchor)
    assert np.abs(skill - bare_fit(winner, loser)).max() < 1e-6
    beside(
        f"fit, {kind} / bare Newton-CG on the games",
        lambda: fit(results, prior_sd=TAU**-0.5),
        lambda: bare_fit(winner, loser),
        rounds=3,
        note=f"gradient {ratings.gradient:.1e}",
    )


@pytest.mark.parametrize("kind", ["mixed", "divisions"])
def test_standard_errors(beside: Beside, kind: str) -> None:
    """The bare side is the whole dense inverse, which only a small league can wait for."""
    ratings = fit(league(kind), prior_sd=TAU**-0.5)
    skill = ratings.scale.log_odds(ratings.rating - ratings.anchor)

    def bare_errors() -> np.ndarray:
        difference = skill[league(kind).player_a] - skill[league(kind).player_b]
        weight = expit(difference) * expit(-difference)
        pair = league(kind).player_a * PLAYERS + league(kind).player_b
        hessian = -np.bincount(pair, weight, PLAYERS**2).reshape(PLAYERS, PLAYERS)
        hessian += hessian.T
        np.fill_diagonal(hessian, TAU - hessian.sum(axis=0))
        return np.sqrt(np.diagonal(np.linalg.inv(hessian)))

    def our_errors() -> np.ndarray:
        for kept in ("standard_error", "_variance"):  # once they were asked for
            ratings.__dict__.pop(kept, None)
        return ratings.standard_error

    worst = np.abs(ratings.scale.log_odds(our_errors()) / bare_errors() - 1.0).max()
    assert worst < 1e-4
    beside(
        f"standard errors, {kind} / bare dense inverse",
        our_errors,
        bare_errors,
        rounds=1,
        note=f"relative error {worst:.1e}",
    )


WIDTH = 0.5
"""The standard deviation of the prior in the federation, in log-odds."""


def by_evalica(results: Results) -> None:
    """Maximum likelihood; keeps a table of all pairs."""
    import evalica

    winner, loser = winners_and_losers(results)
    won = [evalica.Winner.X] * len(winner)
    evalica.bradley_terry(winner.tolist(), loser.tolist(), won, limit=10_000)


def by_choix(results: Results) -> None:
    """The same mode as ours; its Hessian is dense, and made game by game."""
    import choix

    games = list(zip(*map(np.ndarray.tolist, winners_and_losers(results)), strict=True))
    alpha = 0.5 * WIDTH**-2
    choix.opt_pairwise(len(results.players), games, alpha=alpha, method="Newton-CG", tol=1e-9)


def by_glicko(results: Results) -> None:
    """A pass through the weeks, each a rating period."""
    import glicko2

    player = [glicko2.Player() for _ in results.players]
    assert results.date is not None
    for day in np.unique(results.date):
        week = results.select(results.date == day)
        winner, loser = winners_and_losers(week)
        me, other = np.concatenate([winner, loser]), np.concatenate([loser, winner])
        order = np.argsort(me, kind="stable")
        before = np.array([(one.rating, one.rd) for one in player])
        who, first = np.unique(me[order], return_index=True)
        for k, games in zip(who.tolist(), np.split(order, first[1:]), strict=True):
            ratings, deviations = before[other[games]].T.tolist()
            player[k].update_player(ratings, deviations, (games < len(winner)).tolist())


PEERS = {
    "evalica": (by_evalica, 100_000),
    "choix": (by_choix, 10_000),
    "glicko2": (by_glicko, 10**7),
}
"""How each package rates, and the most matches that it is given."""


def winners_and_losers(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Return who won and who lost each game."""
    a, b, won, lost = results.player_a, results.player_b, results.score_a, results.score_b
    winner = np.concatenate([np.repeat(a, won), np.repeat(b, lost)])
    return winner, np.concatenate([np.repeat(b, won), np.repeat(a, lost)])


def processor_seconds(action: Callable[[], Any]) -> float:
    begin = time.process_time()
    action()
    return time.process_time() - begin


@pytest.mark.parametrize("matches", [10_000, 100_000, 1_000_000])
def test_a_federation_by_size(matches: int) -> None:
    results, _ = federation(matches, matches // 10)
    games = int(results.score_a.sum() + results.score_b.sum())
    print(f"\n{matches:,} matches, {len(results.players):,} players, {games:,} games")
    begin = time.process_time()
    ratings = fit(results, prior_sd=WIDTH)
    fitted = time.process_time() - begin
    errors = processor_seconds(lambda: ratings.standard_error)
    sample = np.random.default_rng(1).choice(len(ratings.players), 200, replace=False)
    # Each variance of these is a linear system, solved to 1e-12.
    covariance = ratings.covariance([ratings.players[k] for k in sample])
    off = ratings.standard_error[sample] / np.sqrt(np.diagonal(covariance)) - 1.0
    largest = np.quantile(np.abs(off), 0.95)
    print(f"evenbreak: fit {fitted:.2f} s, standard errors {errors:.2f} s; of 200 of them 95% are")
    print(f"within {largest:.2%}, all from {off.min():+.2%} to {off.max():+.2%}")
    assert largest < 0.03
    assert off.min() > -0.05
    for name, (rate, most) in PEERS.items():
        if importlib.util.find_spec(name) is None:
            print(f"{name}: not installed")
        elif matches > most:
            print(f"{name}: no more than {most:,} matches")
        else:
            try:
                print(f"{name}: {processor_seconds(lambda rate=rate: rate(results)):.2f} s")
            except ArithmeticError as error:  # ratings that run away
                print(f"{name}: {error}")
