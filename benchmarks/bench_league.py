"""Simulated leagues, each beside the bare loop over the same lookups that counts nothing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from evenbreak.handicaps import chart, system_of
from evenbreak.league import (
    LeaguePlayers,
    RandomPairing,
    Season,
    World,
    play_systems,
    run_chunk,
    simulate,
)
from evenbreak.matches import race_win_probability
from evenbreak.ratings.scale import SCALES, scale_of

Beside = Callable[..., float]

WEEKS = 30
WIDEST = 120


def skills(players: int) -> Any:
    return np.clip(np.random.default_rng(1).normal(75.0, 20.0, players), 20, 130).round()


def season_of(players: int, *, by_lot: bool = True) -> Season:
    skill = skills(players)
    club = LeaguePlayers.of(skill + np.arange(players) % 2, skill=skill)
    schedule = RandomPairing() if by_lot else None
    return Season(club, "npl", chart("npl_10"), schedule, WEEKS)


def win_table() -> Any:
    """Return P(player 1 wins) by skill difference and rating difference."""
    differences = np.arange(-WIDEST, WIDEST + 1)
    m, n = chart("npl_10").races(differences)
    p = scale_of("npl").win_probability(differences.astype(float))
    return race_win_probability(p[:, None], m[None, :], n[None, :])


def bare_league(players: int) -> Callable[[], Any]:
    """Return what plays a season of one league: as one would write it in numpy."""
    skill = skills(players).astype(np.int64)
    flat, width = win_table().ravel(), 2 * WIDEST + 1

    def play() -> Any:
        rng = np.random.default_rng(1)
        rating = skill + np.arange(players) % 2
        half = players // 2
        for _ in range(WEEKS):
            order = rng.permutation(players)
            a, b = order[:half], order[half:]
            apart = rating[a] - rating[b] + WIDEST
            gap = skill[a] - skill[b] + WIDEST
            won = rng.random(half) < flat.take(gap * width + apart)
            move = 2 * won - 1
            rating[a] += move
            rating[b] -= move
        return rating

    return play


def bare_replicas(replicas: int, players: int) -> Callable[[], Any]:
    """Return what plays replicas of a small league, all at once, replicas down."""
    skill = skills(players).astype(np.int64)
    flat, width = win_table().ravel(), 2 * WIDEST + 1

    def play() -> Any:
        rng = np.random.default_rng(1)
        rating = np.tile(skill + np.arange(players) % 2, (replicas, 1))
        half = players // 2
        for _ in range(WEEKS):
            order = rng.permutation(players)
            a, b = order[:half], order[half:]
            apart = rating[:, a] - rating[:, b] + WIDEST
            gap = skill[a] - skill[b] + WIDEST
            won = rng.random((replicas, half)) < flat.take(gap * width + apart)
            move = 2 * won - 1
            rating[:, a] += move
            rating[:, b] -= move
        return rating

    return play


def speed(matches: float, seconds: float) -> str:
    return f"{matches / seconds / 1e6:.0f} million matches a second"


@pytest.mark.parametrize("players", [100_000])
def test_one_league(beside: Beside, benchmark: Any, players: int) -> None:
    season = season_of(players)
    season.lookup.expected  # noqa: B018 (tables are made once a season, not once a chunk)
    ratio = beside(
        f"{players:,} players, {WEEKS} weeks / bare loop",
        lambda: run_chunk(season, 1, np.random.SeedSequence(1)),
        bare_league(players),
        note="statistics in ours",
    )
    print(ratio, speed(players / 2 * WEEKS, benchmark.extra_info["ours"]))


@pytest.mark.parametrize("schedule", ["by lot", "round robin"])
def test_replicas(beside: Beside, benchmark: Any, schedule: str) -> None:
    season = season_of(64, by_lot=schedule == "by lot")
    season.lookup.expected  # noqa: B018
    ratio = beside(
        f"2,000 replicas of 64 players, {WEEKS} weeks, {schedule} / bare loop, replicas down",
        lambda: simulate(season, replicas=2000, seed=1),
        bare_replicas(2000, 64),
        rounds=31,
        note="statistics in ours",
    )
    print(ratio, speed(2000 * 32 * WEEKS, benchmark.extra_info["ours"]))


@pytest.mark.parametrize(("players", "replicas"), [(1000, 1), (64, 16)])
def test_a_thousand_player_seasons(beside: Beside, players: int, replicas: int) -> None:
    """What a season costs whatever its size: the statistics, and numpy's calls."""
    season = season_of(players)
    season.lookup.expected  # noqa: B018
    bare = bare_league(players) if replicas == 1 else bare_replicas(replicas, players)
    beside(
        f"{replicas} replicas of {players:,} players, {WEEKS} weeks / bare loop",
        lambda: simulate(season, replicas=replicas, seed=1),
        bare,
        rounds=31,
        note="statistics in ours",
    )


@pytest.mark.parametrize("name", ["step 1", "fargo-like", "level-review"])
def test_systems_compared(beside: Beside, name: str) -> None:
    """Any system, with newcomers, sandbaggers and final scores, beside bare steps without them."""
    system = system_of(name)
    rating = skills(24)
    world = World(LeaguePlayers.of(rating, skill=rating), SCALES["npl"], weeks=WEEKS)
    beside(
        f"{name} in a contest, 500 replicas of 24 players / bare loop of steps",
        lambda: play_systems(world, [system], replicas=500, seed=1),
        bare_replicas(500, 24),
        rounds=5,
        note="all measures in ours",
    )
