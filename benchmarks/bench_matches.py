"""Match kernels, each beside the bare code that answers the same question and no more."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.special import betainc

from evenbreak.games import Race, Rack, winner_breaks
from evenbreak.matches import race_win_probability, win_probability

Beside = Callable[..., float]


def bare_slices(race_to: int, p1: Any, p2: Any) -> Any:
    """Return the chance of an even race, winner breaks, by slices of antidiagonals.

    p1 and p2 are numbers or arrays of one shape.
    """
    p1, p2 = np.asarray(p1), np.asarray(p2)
    breaks_1 = np.zeros((race_to + 1, *p1.shape))
    breaks_2 = np.zeros((race_to + 1, *p1.shape))
    breaks_1[0] = 1.0
    chance = 0.0
    for k in range(2 * race_to - 1):
        low, high = max(0, k - race_to + 1), min(k, race_to - 1) + 1
        one, two = breaks_1[low:high], breaks_2[low:high]
        won = p1 * one + (1.0 - p2) * two
        lost = (1.0 - p1) * one + p2 * two
        if high == race_to:
            chance = chance + won[-1]
        breaks_2[low:high] = lost
        breaks_1[low + 1 : high + 1] = won
        breaks_1[low] = 0.0
    return chance


def test_race_win_probability(beside: Beside) -> None:
    rng = np.random.default_rng(1)
    size = 10**6
    p, m, n = rng.random(size), rng.integers(1, 26, size), rng.integers(1, 26, size)
    assert np.array_equal(race_win_probability(p, m, n), betainc(m, n, p))
    beside(
        "W(p; m, n), 10^6 triples / bare betainc",
        lambda: race_win_probability(p, m, n),
        lambda: betainc(m, n, p),
    )


def test_a_long_race(beside: Beside) -> None:
    race = Race(300, 300, Rack(0.6, 0.55), breaks=winner_breaks)
    assert win_probability(race) == pytest.approx(bare_slices(300, 0.6, 0.55), rel=1e-12)
    beside(
        "race 300:300, winner breaks, kernel / bare slices",
        lambda: win_probability(race),
        lambda: bare_slices(300, 0.6, 0.55),
        rounds=41,
        note="with the whole distribution of the length",
    )


def test_many_races(beside: Beside) -> None:
    p1, p2 = np.random.default_rng(1).random((2, 10**5))
    race = Race(7, 7, Rack(p1, p2), breaks=winner_breaks)
    assert win_probability(race) == pytest.approx(bare_slices(7, p1, p2), rel=1e-12)
    beside(
        "race 7:7, winner breaks, 10^5 pairs of chances / bare slices",
        lambda: win_probability(race),
        lambda: bare_slices(7, p1, p2),
    )
