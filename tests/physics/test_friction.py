"""Friction by what it does."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.physics import (
    friction_of_incline,
    friction_of_pull,
    friction_of_speeds,
    friction_of_stop,
    friction_of_throw,
    miscue_offset,
    sliding_distance,
    sliding_power,
    sliding_speed,
    throw_angle,
    tip_friction_of,
)

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
    with pytest.raises(InputError, match=r"time is -1\.0"):
        sliding_speed(1.0, 0.1, -1.0)
    with pytest.raises(InputError, match=r"mass is -1\.0"):
        sliding_power(1.0, 0.1, -1.0)
    with pytest.raises(InputError, match=r"offset is 1\.1"):
        tip_friction_of(1.1)
    assert tip_friction_of(1.0) == math.inf
