"""Friction by what it does."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.physics import (
    BALL_FRICTION,
    Cloth,
    SlipFriction,
    aim,
    aimed_shot,
    collide,
    friction_of_incline,
    friction_of_pull,
    friction_of_speeds,
    friction_of_stop,
    friction_of_throw,
    miscue_offset,
    pocketed_shot,
    pockets,
    shot,
    sliding_distance,
    sliding_power,
    sliding_speed,
    strike_for_speed,
    throw_angle,
    tip_friction_of,
)
from evenbreak.physics.objects import PoolTable

speeds = st.floats(0.1, 10.0)
frictions = st.floats(0.05, 1.0)


@given(speeds, frictions, st.floats(0.0, 3.0))
def test_distance_is_the_sum_of_speed(speed: float, friction: float, time: float) -> None:
    times = np.linspace(0.0, time, 2001)
    found = sliding_speed(speed, friction, times)
    assert sliding_distance(speed, friction, time) == pytest.approx(
        float(np.trapezoid(found, times)), rel=1e-4, abs=1e-5
    )
    assert (np.diff(found) <= 0.0).all()


@given(speeds, frictions, st.floats(0.05, 0.95))
def test_each_way_to_measure_it_finds_the_friction(
    speed: float, friction: float, share: float
) -> None:
    gravity, mass = 9.81, 0.17
    stop = speed / (friction * gravity)
    time = share * stop
    way = sliding_distance(speed, friction, time, gravity=gravity)
    later = sliding_speed(speed, friction, time, gravity=gravity)
    lost = mass * (speed**2 - later**2) / 2
    assert friction_of_speeds(speed, later, way, gravity=gravity) == pytest.approx(friction)
    assert friction_of_pull(lost / way, mass * gravity) == pytest.approx(friction)
    whole = sliding_distance(speed, friction, stop, gravity=gravity)
    assert friction_of_stop(whole, stop, gravity=gravity) == pytest.approx(friction)


def test_a_block_that_gains_speed_is_refused() -> None:
    with pytest.raises(InputError, match="second"):
        friction_of_speeds(1.0, [0.5, 1.5], 1.0)


@given(speeds, frictions)
def test_power_is_the_rate_of_energy(speed: float, friction: float) -> None:
    step, mass = 1e-6, 0.2
    later = sliding_speed(speed, friction, step)
    rate = 0.5 * mass * (later**2 - speed**2) / step
    assert sliding_power(speed, friction, mass) == pytest.approx(rate, rel=1e-3)


@given(speeds, frictions)
def test_the_stop_of_a_block_gives_its_friction(speed: float, friction: float) -> None:
    gravity = 9.81
    time = speed / (friction * gravity)
    distance = sliding_distance(speed, friction, 2.0 * time, gravity=gravity)
    assert sliding_speed(speed, friction, 2.0 * time, gravity=gravity) == 0.0
    assert friction_of_stop(distance, time, gravity=gravity) == pytest.approx(friction)


@given(st.floats(0.0, 5.0))
def test_a_tip_slips_where_its_friction_ends(friction: float) -> None:
    offset = miscue_offset(friction)
    assert tip_friction_of(offset) == pytest.approx(friction, abs=1e-12)
    # The tip pushes along x on a surface whose normal is at asin(b/R) to that.
    assert friction_of_incline(math.asin(offset)) == pytest.approx(friction, abs=1e-9)


def test_the_throw_of_a_stun_shot_gives_its_friction() -> None:
    angle = throw_angle(0.6, 0.0, mu=0.05)
    assert friction_of_throw(72.0 * math.tan(angle), 72.0) == pytest.approx(0.05)


def test_refusals() -> None:
    with pytest.raises(InputError, match=r"time must be a number from 0 to 1e\+50; it is -1\.0"):
        sliding_speed(1.0, 0.1, -1.0)
    with pytest.raises(InputError, match=r"mass must be a number from 0 to 1e\+50; it is -1\.0"):
        sliding_power(1.0, 0.1, -1.0)
    with pytest.raises(InputError, match=r"offset must be a number from 0 to 1; it is 1\.1"):
        tip_friction_of(1.1)
    assert tip_friction_of(1.0) == math.inf


# Friction between balls that falls with the speed of the slip.


FIT = SlipFriction()
HALF_BALL = math.radians(30.0)


def test_the_fit_is_the_published_one() -> None:
    assert (FIT.fast, FIT.more, FIT.decay) == (9.951e-3, 0.108, 1.088)
    assert FIT.at(0.0) == FIT.slow == 0.117951
    assert FIT.at([0.5, 2.0]) == pytest.approx(
        [0.009951 + 0.108 * math.exp(-0.544), 0.009951 + 0.108 * math.exp(-2.176)]
    )
    assert FIT.at(1e50) == FIT.fast


@pytest.mark.parametrize(("speed", "degrees"), [(0.5, 4.7), (2.0, 2.7), (4.0, 1.3)])
def test_a_half_ball_stun_shot_by_hand(speed: float, degrees: float) -> None:
    slip = 0.5 * speed
    mu = 0.009951 + 0.108 * math.exp(-1.088 * slip)
    # Slip takes friction along only up to a seventh of itself.
    sideways = min(mu * math.cos(HALF_BALL), 0.5 / 7.0)
    thrown = throw_angle(HALF_BALL, 0.0, mu=FIT, speed=speed)
    assert thrown == pytest.approx(math.atan2(sideways, math.cos(HALF_BALL)))
    assert math.degrees(thrown) == pytest.approx(degrees, abs=0.05)


@given(st.floats(-1.57, 1.57), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(0.0, 20.0))
def test_it_is_the_constant_friction_of_that_slip(
    cut: float, topspin: float, side: float, speed: float
) -> None:
    by_slip = collide(cut, topspin, side, speed=speed, mu=FIT)
    assert by_slip.mu == pytest.approx(FIT.at(math.hypot(*by_slip.slip)))
    constant = collide(cut, topspin, side, speed=speed, mu=by_slip.mu)
    assert by_slip.object_velocity.tolist() == constant.object_velocity.tolist()
    # A ball that does not move has no direction; `throw_angle` is the limit of slow shots.
    if speed > 1e-6:
        angle = throw_angle(cut, topspin, side, mu=FIT, speed=speed)
        assert by_slip.throw == pytest.approx(angle, abs=1e-12)


def test_a_curve_that_is_flat_is_a_constant() -> None:
    flat = SlipFriction(BALL_FRICTION, 0.0, 1.0)
    cuts = np.linspace(-1.5, 1.5, 7)
    assert throw_angle(cuts, mu=flat, speed=3.0).tolist() == throw_angle(cuts).tolist()
    assert aim(0.3, 1.0, mu=flat, speed=3.0) == aim(0.3, 1.0)


@given(st.floats(-1.4, 1.4), st.floats(-1.5, 1.5), st.floats(-1.0, 1.0), st.floats(0.01, 10.0))
def test_a_shot_aimed_so_goes_to_its_target(
    cut: float, topspin: float, side: float, speed: float
) -> None:
    found = aim(cut, 1.0, topspin, side, mu=FIT, speed=speed)
    hit = collide(found.cut, topspin, side, mu=FIT, speed=speed)
    x, y, _ = hit.object_velocity
    assert -math.atan2(y, x) == pytest.approx(cut, abs=1e-8)


def test_arrays_of_speeds() -> None:
    speeds = np.array([0.5, 2.0, 4.0])
    many = throw_angle([[0.2], [0.5]], 0.0, mu=FIT, speed=speeds)
    assert many.shape == (2, 3)
    assert many[1, 2] == throw_angle(0.5, 0.0, mu=FIT, speed=4.0)
    assert (np.diff(many[1]) < 0.0).all()


def test_a_traced_shot_takes_the_friction_of_its_hit() -> None:
    slow, fast = (
        shot(strike_for_speed(speed, -0.2), 0.5, 0.3, mu=FIT).collision for speed in (0.6, 4.0)
    )
    assert slow is not None
    assert fast is not None
    assert fast.mu < slow.mu == FIT.at(math.hypot(*slow.slip))
    fixed = shot(strike_for_speed(4.0, -0.2), 0.5, 0.3, mu=fast.mu)
    assert fixed.throw == fast.throw


def test_a_pot_allows_for_it() -> None:
    pocket = pockets(PoolTable())[3]
    balls = (0.7, 0.4), (1.2, 0.4)
    for speed in (3.0, 5.0):
        found = pocketed_shot(strike_for_speed(speed, -0.2), *balls, pocket, mu=FIT)
        assert found.shot.object_leg is not None
        assert found.shot.object_leg.pocket == pocket.name
    one = aimed_shot(strike_for_speed(5.0, -0.2), *balls, (pocket.x, pocket.y), mu=FIT)
    assert one.turn == pytest.approx(found.turn)
    other = aimed_shot(strike_for_speed(5.0, -0.2), *balls, (pocket.x, pocket.y), cloth=Cloth())
    assert one.turn < other.turn  # so fast, the balls have less friction than 4/72


def test_refusals_between_balls() -> None:
    with pytest.raises(InputError, match=r"how fast the balls slip\. Give the"):
        throw_angle(0.3, mu=FIT)
    with pytest.raises(InputError, match=r"how fast the balls slip\. Give the"):
        aim(0.3, 1.0, mu=FIT)
    with pytest.raises(InputError, match=r"speed must be a number from 0 to 1e\+50; it is -1"):
        throw_angle(0.3, mu=FIT, speed=-1.0)
    with pytest.raises(InputError, match=r"decay must be .*; you gave -0\.1"):
        SlipFriction(decay=-0.1)
    with pytest.raises(InputError, match="slip must be a finite number, 0 or more; it is -1"):
        FIT.at(-1.0)
    with pytest.raises(InputError, match="is 'low'"):
        throw_angle(0.3, mu="low")
