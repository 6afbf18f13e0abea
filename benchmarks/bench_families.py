"""A family of games at once, beside a batched solve of numpy and beside a loop over single chains.

The batched solve gets finished matrices and checks nothing; it loses digits where ours does not.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from evenbreak.chains import chain_of, limits_over, stochastic_limit
from evenbreak.chains.family_elimination import family_limits
from evenbreak.chains.family_numbers import Numbers
from evenbreak.games import Ahead, OneBall, Rack, winner_breaks

Beside = Callable[..., float]
DRAW = np.random.default_rng(1)


def batched_solve(tables: np.ndarray) -> np.ndarray:
    """Return the stationary laws of row-stochastic tables (k, n, n) by LU factorization."""
    count, n = tables.shape[:2]
    equations = np.swapaxes(tables, 1, 2) - np.eye(n)
    equations[:, -1, :] = 1.0
    right = np.zeros((count, n, 1))
    right[:, -1] = 1.0
    return np.linalg.solve(equations, right)[..., 0]


def test_a_million_one_ball_games(beside: Beside) -> None:
    p1, p2 = DRAW.random((2, 10**6))

    def bare() -> Any:  # the four states as a transient part of two
        equations = np.empty((10**6, 2, 2))
        equations[:, 0, 0] = equations[:, 1, 1] = 1.0
        equations[:, 0, 1], equations[:, 1, 0] = p2 - 1.0, p1 - 1.0
        right = np.zeros((10**6, 2, 1))
        right[:, 0] = 1.0
        visits = np.linalg.solve(equations, right)[..., 0]
        return visits * np.stack([p1, p2], axis=1)

    found = limits_over(OneBall, p1=p1, p2=p2)
    off = np.abs(bare()[:, 0] / found["W"] - 1.0).max()
    beside(
        "1,000,000 one-ball games / numpy.linalg.solve",
        lambda: limits_over(OneBall, p1=p1, p2=p2),
        bare,
        rounds=5,
        note=f"difference {off:.0e}",
    )


def test_300_games_beside_a_loop(beside: Beside) -> None:
    p1, p2 = DRAW.random((2, 300))

    def match(p1: Any, p2: Any) -> Ahead:
        return Ahead(5, 3, Rack(p1, p2), breaks=winner_breaks)

    def loop() -> Any:
        pairs = zip(p1.tolist(), p2.tolist(), strict=True)
        return [stochastic_limit(chain_of(match(*pair))) for pair in pairs]

    beside(
        "300 matches 5:3 ahead / a loop over stochastic_limit",
        lambda: limits_over(match, p1=p1, p2=p2),
        loop,
        rounds=5,
    )


def table_limits(tables: np.ndarray) -> Callable[[], Any]:
    """Return a call for the stationary laws (k, n) of tables, of which the arcs are listed."""
    count, n = tables.shape[:2]
    sources, targets = (places.ravel().tolist() for places in np.indices((n, n)))
    structure = chain_of(tables[0], rows="from").structure
    chances = [Numbers(p) for p in np.ascontiguousarray(tables.reshape(count, -1).T)]

    def laws() -> Any:
        limits, _ = family_limits(structure, sources, targets, chances, count)
        return np.array([limits[k].values for k in range(n)]).T

    return laws


def test_8192_chains_of_30_dense_states(beside: Beside) -> None:
    tables = DRAW.random((8192, 30, 30)) + 0.1
    tables /= tables.sum(axis=2, keepdims=True)
    ours = table_limits(tables)
    off = np.abs(ours() / batched_solve(tables) - 1.0).max()
    beside(
        "8,192 chains of 30 dense states, elimination / numpy.linalg.solve",
        ours,
        lambda: batched_solve(tables),
        rounds=7,
        note=f"difference {off:.0e}",
    )


class Mixed:
    """A dense game of 30 states without an end: with q to odd or even states by p, else to any."""

    start = 0

    def __init__(self, p: Any, q: Any) -> None:
        self.odd, self.even = q * p / 15 + (1 - q) / 30, q * (1 - p) / 15 + (1 - q) / 30

    def moves(self, state: int) -> dict[int, Any]:
        return {i: self.odd if (i + state) % 2 else self.even for i in range(30)}

    def winner(self, state: int) -> None:  # noqa: ARG002
        return None


def test_8192_dense_games_from_two_chances(beside: Beside) -> None:
    count = 8192
    p, q = DRAW.random((2, count))

    def bare() -> Any:
        odd, even = q * p / 15 + (1 - q) / 30, q * (1 - p) / 15 + (1 - q) / 30
        places = (np.add.outer(np.arange(30), np.arange(30)) % 2).astype(bool)
        return batched_solve(np.where(places, odd[:, None, None], even[:, None, None]))

    beside(
        "8,192 games of 30 dense states, game to limit / numpy.linalg.solve",
        lambda: limits_over(Mixed, p=p, q=q),
        bare,
        rounds=7,
    )
