"""A hit in the centre keeps momentum and energy, and the break cue is the best there is."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from evenbreak.errors import InputError
from evenbreak.physics import (
    best_stick_ratio,
    break_energy_share,
    centre_hit,
    energy_share,
    stroke_energy,
    stroke_speed,
)

ratios = st.floats(0.01, 100.0)


@given(ratios)
def test_momentum_and_energy_are_kept(ratio: float) -> None:
    ball, stick = centre_hit(ratio)
    assert ratio * stick + ball == pytest.approx(ratio)
    assert ratio * stick**2 + ball**2 == pytest.approx(ratio)
    assert energy_share(ratio) == pytest.approx(ball**2 / ratio)


def test_an_equal_stick_stops() -> None:
    assert centre_hit(1.0) == (1.0, 0.0)
    assert centre_hit(0.5).stick < 0.0


@given(ratios, ratios)
def test_a_break_shares_the_stroke(stick: float, forearm: float) -> None:
    stroke = stroke_energy(1.0, stick, forearm)
    assert break_energy_share(stick, forearm) == pytest.approx(energy_share(stick) / stroke)


@given(st.floats(0.5, 30.0))
def test_the_break_cue_by_search(forearm: float) -> None:
    found = minimize_scalar(
        lambda stick: -break_energy_share(stick, forearm), bounds=(0.1, 20.0), method="bounded"
    )
    best = best_stick_ratio(forearm)
    assert best == pytest.approx(found.x, rel=1e-4)
    assert break_energy_share(best, forearm) >= -found.fun - 1e-12


def test_the_energy_of_a_forearm_by_its_parts() -> None:
    # A rod that turns about one end with its other end at speed 1, cut into short pieces.
    pieces = (np.arange(2000) + 0.5) / 2000.0
    rod = 0.5 * 6.0 * np.mean(pieces**2)
    assert stroke_energy(0.5 * 3.0, 3.0, 6.0) == pytest.approx(0.5 * 3.0 + rod, rel=1e-6)


@given(ratios, ratios, ratios)
def test_the_work_of_a_stroke(force: float, length: float, mass: float) -> None:
    speed = stroke_speed(force, length, mass)
    assert 0.5 * mass * speed**2 == pytest.approx(force * length)


def test_arrays_and_refusals() -> None:
    assert centre_hit(np.ones(3)).ball.shape == energy_share(np.ones(3)).shape == (3,)
    assert best_stick_ratio(np.array([6.0, 25.0])).shape == (2,)
    for refused in (lambda: stroke_speed(1.0, 1.0, 0.0), lambda: centre_hit(-1.0)):
        with pytest.raises(InputError, match=r"is -?[01]"):
            refused()
    assert math.isfinite(break_energy_share(1e-50, 1e50))
