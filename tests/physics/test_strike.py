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
    center_hit,
    energy_share,
    stroke_energy,
    stroke_speed,
)
from evenbreak.physics.objects import Ball, Cue
from evenbreak.physics.strike import strike, strike_for_speed
from evenbreak.physics.units import OUNCE

OFFSETS = st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 2.0 * math.pi)).map(
    lambda polar: (polar[0] * math.sin(polar[1]), polar[0] * math.cos(polar[1]))
)


@given(OFFSETS, st.floats(0.01, 20.0), st.floats(1.0, 30.0))
def test_the_hit_keeps_momentum_and_energy(offsets, speed, ounces):
    cue = Cue(mass=ounces * OUNCE)
    hit = strike(speed, *offsets, cue=cue)
    momentum = cue.mass * hit.stick_speed_after + hit.ball.mass * hit.speed
    assert momentum == pytest.approx(cue.mass * speed)
    after = 0.5 * cue.mass * hit.stick_speed_after**2 + hit.energy.total
    assert after == pytest.approx(0.5 * cue.mass * speed**2)
    # The spin is what the blow b p gives the ball: I omega = b p.
    blow = hit.off_center * hit.ball.radius * hit.ball.mass * hit.speed
    assert hit.ball.inertia * np.linalg.norm(hit.spin) == pytest.approx(blow)


def test_signs_of_the_spin():
    follow_right = strike(1.0, 0.2, 0.1)
    assert follow_right.spin[1] > 0.0 < follow_right.spin[2]
    assert (follow_right.topspin, follow_right.side) == (0.5, 0.25)
    assert strike(1.0, -0.2, -0.1).spin[1:].tolist() == (-follow_right.spin[1:]).tolist()


def test_in_the_center_it_is_the_center_hit_of_p3_2():
    hit = strike(2.0)
    assert (hit.speed, hit.stick_speed_after) == (pytest.approx(3.0), pytest.approx(1.0))


@given(OFFSETS, st.floats(0.01, 20.0))
def test_the_stick_for_a_speed_gives_that_speed(offsets, speed):
    assert strike_for_speed(speed, *offsets).speed == pytest.approx(speed)


def test_the_miscue_limit_is_that_of_the_tip():
    assert not strike(1.0, 0.3, 0.39).miscue
    assert strike(1.0, -0.31, 0.4).miscue
    assert not strike(1.0, -0.31, 0.4, cue=Cue(tip_friction=1.0)).miscue


def test_strikes_as_arrays():
    hits = strike(np.array([1.0, 2.0]), -0.4, [0.0, 0.4])
    assert hits.miscue.tolist() == [False, True]
    assert hits.spin.shape == (2, 3)
    assert hits.velocity.shape == (2, 2)
    for index, single in enumerate((strike(1.0, -0.4, 0.0), strike(2.0, -0.4, 0.4))):
        assert hits.spin[index] == pytest.approx(single.spin)
        assert hits.stick_speed_after[index] == pytest.approx(single.stick_speed_after)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((-1.0,), r"stick_speed must be a number from 0 to 1e\+50; it is -1\.0"),
        ((1.0, 1.2), r"offset must be a number from -1 to 1; it is 1\.2"),
        ((1.0, 0.8, 0.8), "miss the ball"),
        ((math.nan,), "stick_speed"),
    ],
)
def test_what_cannot_be_is_refused(words, message):
    with pytest.raises(InputError, match=message):
        strike(*words)


def test_other_balls_and_cues():
    light = strike(1.0, ball=Ball(mass=3.0 * OUNCE), cue=Cue(mass=3.0 * OUNCE))
    assert (light.speed, light.stick_speed_after) == (pytest.approx(1.0), pytest.approx(0.0))


# A hit in the center keeps momentum and energy, and the break cue is the best there is.


ratios = st.floats(0.01, 100.0)


@given(ratios)
def test_momentum_and_energy_are_kept(ratio: float) -> None:
    ball, stick = center_hit(ratio)
    assert ratio * stick + ball == pytest.approx(ratio)
    assert ratio * stick**2 + ball**2 == pytest.approx(ratio)
    assert energy_share(ratio) == pytest.approx(ball**2 / ratio)


def test_an_equal_stick_stops() -> None:
    assert center_hit(1.0) == (1.0, 0.0)
    assert center_hit(0.5).stick < 0.0


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
    assert center_hit(np.ones(3)).ball.shape == energy_share(np.ones(3)).shape == (3,)
    assert best_stick_ratio(np.array([6.0, 25.0])).shape == (2,)
    for refused in (lambda: stroke_speed(1.0, 1.0, 0.0), lambda: center_hit(-1.0)):
        with pytest.raises(InputError, match=r"is -?[01]"):
            refused()
    assert math.isfinite(break_energy_share(1e-50, 1e50))
