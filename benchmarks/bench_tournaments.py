"""Exact title odds beside 10,000 evenings of dice, and the rest of a tournament's questions."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from evenbreak.tournaments import (
    blind_draw_odds,
    double_elimination,
    play_chips,
    single_elimination,
    title_odds,
)

Beside = Callable[..., float]
EVENINGS = 10_000


def strengths(players: int) -> np.ndarray:
    strength = np.geomspace(4.0, 1.0, players)
    return np.asarray(strength[:, None] / (strength[:, None] + strength))


def names(players: int) -> list[str]:
    return [f"P{k}" for k in range(players)]


def dice(matches: int) -> Callable[[], float]:
    """Return the floor: what the random numbers of so many played-out evenings take."""
    return lambda: float(np.random.default_rng(1).random((matches, EVENINGS)).sum())


@pytest.mark.parametrize(
    ("players", "drops"),
    [
        (8, "fewest rematches"),
        (16, "fewest rematches"),
        (16, "usual"),
        (16, "straight"),
        (32, "straight"),
    ],
)
def test_a_double_elimination(beside: Beside, players: int, drops: str) -> None:
    bracket, win = double_elimination(names(players), drops=drops), strengths(players)
    assert title_odds(bracket, win).exact
    beside(
        f"double of {players}, {drops} drops, exact / the dice of {EVENINGS:,} evenings",
        lambda: title_odds(bracket, win),
        dice(2 * players - 1),
    )


def test_a_large_single_elimination(beside: Beside) -> None:
    bracket, win = single_elimination(names(256)), strengths(256)
    beside("single of 256 / dice", lambda: title_odds(bracket, win), dice(255))


def test_a_double_of_32_with_the_default_drops(beside: Beside) -> None:
    bracket, win = double_elimination(names(32)), strengths(32)
    found = title_odds(bracket, win)
    beside(
        "double of 32, default drops, sampled / dice",
        lambda: title_odds(bracket, win),
        dice(63),
        rounds=1,
        note=f"largest standard error of a title {found.error[:, 0].max():.0e}",
    )


def test_a_blind_draw_of_sixteen(beside: Beside) -> None:
    bracket, win = single_elimination(names(16)), strengths(16)
    beside(
        "400 blind draws of a single of 16 / dice", lambda: blind_draw_odds(bracket, win), dice(15)
    )


def test_ten_thousand_chip_tournaments(beside: Beside) -> None:
    win, chips = strengths(16), [3] * 16
    beside(
        "10,000 chip tournaments of 16 on 4 tables / their racks' dice",
        lambda: play_chips(chips, win, tables=4, runs=EVENINGS),
        dice(48),
        rounds=3,
    )
