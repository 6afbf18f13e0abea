"""Where the tip meets the ball: against the impulse, the slide that follows, and searches."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from evenbreak.errors import InputError
from evenbreak.physics import (
    NATURAL_ROLL_OFFSET,
    Ball,
    Cloth,
    ContactPoint,
    Slide,
    ball_speed_ratio,
    best_lag_offset,
    contact_for_later,
    effective_contact,
    largest_roll_side,
    offset_for,
    roll_side,
    roll_speed_ratio,
    small_circle_point,
    spin_of_offset,
    strike_side,
    stun_offset,
)

BALL, CLOTH = Ball(), Cloth()
across = st.floats(-0.6, 0.6)
heights = st.floats(0.3, 1.6)
ratios = st.floats(0.05, 2.0)


def struck(y: float, z: float, speed: float = 1.0) -> Slide:
    """The ball after an impulse along x at (y, z), by the torque of that impulse."""
    arm = BALL.radius * np.array([0.0, y, z - 1.0])
    spin = np.cross(arm, [BALL.mass * speed, 0.0, 0.0]) / BALL.inertia
    return Slide(BALL, CLOTH, [0.0, 0.0], [speed, 0.0], spin)


@given(across, heights)
def test_spins_are_the_torque_of_the_impulse(y: float, z: float) -> None:
    _, topspin, side = BALL.radius * struck(y, z).spin
    assert spin_of_offset(z - 1.0) == pytest.approx(topspin, abs=1e-12)
    assert strike_side(y) == pytest.approx(side, abs=1e-12)
    assert offset_for(spin_of_offset(z - 1.0)) == pytest.approx(z - 1.0)


def test_signs() -> None:
    assert strike_side(-0.3) > 0.0  # a tip to the right: counterclockwise from above
    assert roll_side(-0.3, 1.0) > 0.0
    assert spin_of_offset(0.2) > 0.0 > spin_of_offset(-0.2)  # above the center: topspin
    assert spin_of_offset(NATURAL_ROLL_OFFSET) == 1.0
    assert small_circle_point(1.0).y < 0.0
    assert stun_offset(2.0, 0.1, CLOTH) < 0.0


@given(across, heights)
def test_sidespin_in_natural_roll_by_the_slide(y: float, z: float) -> None:
    shot = struck(y, z)
    side = BALL.radius * shot.spin[2] / shot.roll_velocity[0]
    assert roll_side(y, z) == pytest.approx(side, abs=1e-9)


@given(across, heights, st.floats(0.5, 5.0), st.floats(0.0, 2.0))
def test_the_effective_contact_by_the_slide(y: float, z: float, speed: float, time: float) -> None:
    shot = struck(y, z, speed)
    # Rolling wears topspin off with the speed, but the sidespin stays; the point is of the slide.
    until = min(time, shot.slide_time)
    ratio = BALL.radius * shot.spin_at(until) / shot.velocity_at(until)[0]
    found = effective_contact(ContactPoint(y, z), speed, time, CLOTH)
    assert -2.5 * found.y == pytest.approx(ratio[2], abs=1e-9)
    assert 2.5 * (found.z - 1.0) == pytest.approx(ratio[1], abs=1e-9)
    back = contact_for_later(found, z)
    assert list(back) == pytest.approx([y, z], abs=1e-12)


@pytest.mark.parametrize("z", [1e-50, 1e-20, 1e-3, 1.4, 2.0])
def test_the_effective_contact_ends_in_natural_roll(z: float) -> None:
    for speed in (1e-50, 1e-20, 1.0, 8.0):
        found = effective_contact(ContactPoint(0.1 * z, z), speed, 1e6, CLOTH)
        assert found == pytest.approx((0.14, 1.4), rel=1e-12)


@given(st.floats(-3.4, 3.4))
def test_the_small_circle_by_search(side: float) -> None:
    def distance(z: float) -> float:
        return math.hypot(side / 3.5 * z, z - 1.0)

    found = minimize_scalar(distance, bounds=(1e-6, 2.0), method="bounded")
    point = small_circle_point(side)
    assert point.z == pytest.approx(found.x, abs=1e-4)
    assert roll_side(*point) == pytest.approx(side, abs=1e-9)
    assert math.hypot(point.y, point.z - 0.5) == pytest.approx(0.5)


@given(st.floats(0.05, 0.9))
def test_the_largest_sidespin_in_roll_by_search(offset: float) -> None:
    turns = np.linspace(0.0, 2.0 * math.pi, 20_001)
    y, z = offset * np.cos(turns), 1.0 + offset * np.sin(turns)
    assert largest_roll_side(offset) == pytest.approx(roll_side(y, z).max(), rel=1e-6)


@given(st.floats(0.5, 6.0), st.floats(0.0, 0.99))
def test_backspin_is_gone_where_it_should_be(speed: float, part: float) -> None:
    distance = part * speed**2 / (2.0 * CLOTH.mu_slide * CLOTH.gravity)
    offset = stun_offset(speed, distance, CLOTH)
    shot = struck(0.0, 1.0 + offset, speed)
    time = -0.4 * spin_of_offset(offset) * speed / (CLOTH.mu_slide * CLOTH.gravity)
    assert BALL.radius * shot.spin_at(time)[1] == pytest.approx(0.0, abs=1e-9)
    assert shot.at(time)[0] == pytest.approx(distance, abs=1e-9)


@given(across, ratios)
def test_an_elastic_hit_off_center_keeps_energy_and_momentum(offset: float, ratio: float) -> None:
    ball = ball_speed_ratio(offset, ratio)
    stick = 1.0 - ratio * ball
    spinning = 0.4 * (spin_of_offset(offset) * ball) ** 2
    assert stick**2 + ratio * (ball**2 + spinning) == pytest.approx(1.0)
    assert ball > 0.0


@given(across, ratios)
def test_the_speed_of_roll_by_the_slide(offset: float, ratio: float) -> None:
    shot = struck(0.0, 1.0 + offset, ball_speed_ratio(offset, ratio))
    assert roll_speed_ratio(offset, ratio) == pytest.approx(shot.roll_velocity[0])


@given(ratios)
def test_the_best_lag_by_search(ratio: float) -> None:
    found = minimize_scalar(
        lambda offset: -roll_speed_ratio(offset, ratio), bounds=(0.0, 1.0), method="bounded"
    )
    assert best_lag_offset(ratio) == pytest.approx(found.x, abs=1e-4)


def test_arrays_broadcast_and_scalars_stay_scalars() -> None:
    y, z = np.linspace(-0.5, 0.5, 4)[:, None], np.linspace(0.5, 1.4, 3)
    assert roll_side(y, z).shape == (4, 3)
    assert type(roll_side(0.1, 1.0)) is float
    assert effective_contact(ContactPoint(y, z), 2.0, 0.1, CLOTH).y.shape == (4, 3)
    assert type(effective_contact(ContactPoint(0.1, 1.0), 2.0, 0.1, CLOTH).y) is float
    assert small_circle_point(z).y.shape == (3,)


def test_refusals() -> None:
    with pytest.raises(InputError, match=r"offset must be a number from -1 to 1; it is 1\.5"):
        spin_of_offset(1.5)
    with pytest.raises(InputError, match=r"z must be a number from 1e-50 to 2; it is 0\.0"):
        roll_side(0.1, 0.0)
    with pytest.raises(InputError, match="distance is farther than a ball slides at this speed"):
        stun_offset(1.0, 5.0, CLOTH)
    with pytest.raises(InputError, match="ball_ratio"):
        ball_speed_ratio(0.1, -1.0)
    assert largest_roll_side(1.0) == math.inf
