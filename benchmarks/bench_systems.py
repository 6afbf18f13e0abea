"""Handicap systems that refit all results every night, beside a bare refit by scipy."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from scipy.linalg import solve
from scipy.special import expit

from evenbreak.handicaps import FargoLike
from evenbreak.handicaps.systems.history import Entries, History, Matches

Beside = Callable[..., float]

WEEKS = 30
UNIT = 100.0 / np.log(2.0)


def histories(players: int, replicas: int) -> list[Matches]:
    """Return the matches up to each night, opponents by lot for each replica."""
    rng = np.random.default_rng(1)
    skill = rng.normal(0.0, 0.7, (players, replicas))
    half, parts = players // 2, []
    for _ in range(WEEKS):
        order = rng.permuted(np.tile(np.arange(players)[:, None], replicas), axis=0)
        a, b = order[:half], order[half:]
        apart = np.take_along_axis(skill, a, 0) - np.take_along_axis(skill, b, 0)
        won = rng.binomial(9, expit(apart))
        parts.append((a, b, won, 9 - won))
    night = np.repeat(np.arange(1, WEEKS + 1), half)
    a, b, won, lost = (np.concatenate(column) for column in zip(*parts, strict=True))
    zero, rating = np.zeros_like(a), np.full(a.shape, 525.0)
    matches = Matches(night, a, b, won, lost, zero, zero, rating, rating)
    return [matches[: half * (week + 1)] for week in range(WEEKS)]


def ours(players: int, replicas: int, nights: list[Matches]) -> Any:
    system = FargoLike(half_life=1e6, established=0)
    initial = ratings = np.full((players, replicas), 525.0)
    entries, kept = Entries.of(initial, games=np.full(initial.shape, 50)), {}  # type: ignore[var-annotated]
    for week, matches in enumerate(nights, 1):
        ratings = system.update(History(entries, initial, ratings, week, matches, kept=kept))
    return ratings


def bare_refits(players: int, matches: Matches, replica: int) -> Iterator[Any]:
    """Yield the ratings of one league after each night: Newton's method by a dense solve."""
    half = players // 2
    won, at = np.zeros((players, players)), np.zeros(players)
    for week in range(WEEKS):
        rows = slice(half * week, half * (week + 1))
        a, b = matches.a[rows, replica], matches.b[rows, replica]
        won[a, b] += matches.score_a[rows, replica]
        won[b, a] += matches.score_b[rows, replica]
        games = won + won.T
        for _ in range(50):
            p = expit(at[:, None] - at)
            q = expit(at)
            slope = (won - games * p).sum(axis=1) + 52.0 * (0.5 - q)
            hessian = -games * p * (1.0 - p)
            hessian[np.diag_indices(players)] = 52.0 * q * (1.0 - q) - hessian.sum(axis=1)
            step = solve(hessian, slope, assume_a="pos")
            at = at + step
            if np.abs(step).max() < 1e-8:
                break
        yield 525.0 + UNIT * at


def bare(players: int, replicas: int, nights: list[Matches]) -> Any:
    every = [list(bare_refits(players, nights[-1], replica))[-1] for replica in range(replicas)]
    return np.stack(every, axis=1)


@pytest.mark.parametrize(
    ("players", "replicas"), [(32, 1), (16, 200), (32, 100), (128, 8), (300, 4)]
)
def test_refits_of_a_season(beside: Beside, players: int, replicas: int) -> None:
    nights = histories(players, replicas)
    np.testing.assert_allclose(
        ours(players, replicas, nights), bare(players, replicas, nights), atol=1e-3
    )
    ratio = beside(
        f"{replicas} leagues of {players}, refitted on {WEEKS} nights / scipy, league by league",
        lambda: ours(players, replicas, nights),
        lambda: bare(players, replicas, nights),
        rounds=3,
    )
    print(f"{ratio:.2f}")
