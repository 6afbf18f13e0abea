"""Energy of rolling, and rolling elsewhere, by the roads that lead there."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.physics import (
    MOON_GRAVITY,
    SHAPES,
    TABLE_SPEEDS,
    Ball,
    Cloth,
    PoolTable,
    Slide,
    kinetic_energy,
    lag_distance,
    lag_speed,
    roll_distance,
    roll_time,
    rolling_friction,
    rolling_time,
    spin_stop,
    table_speed,
)
from evenbreak.physics.units import GRAVITY


@given(st.floats(-20.0, 20.0))
def test_a_spinning_ball_goes_as_far_as_its_slide_and_roll(rim: float) -> None:
    ball, cloth = Ball(), Cloth()
    shot = Slide(ball, cloth, [0.0, 0.0], [0.0, 0.0], [0.0, rim / ball.radius, 0.0])
    stop = spin_stop(rim, cloth)
    assert stop.distance == pytest.approx(abs(shot.stop_position[0]), abs=1e-12)
    assert stop.slide_distance == pytest.approx(abs(shot.at(shot.slide_time)[0]), abs=1e-12)
    assert stop.slide_time == pytest.approx(shot.slide_time)
    assert stop.slide_time + stop.roll_time == pytest.approx(shot.stop_time)
    assert stop.roll_speed == pytest.approx(abs(shot.roll_velocity[0]))


@given(st.floats(0.005, 0.02), st.floats(0.1, 5.0), st.sampled_from(sorted(SHAPES)))
def test_a_round_body_rolls_as_long_as_its_slowing_says(
    mu: float, distance: float, shape: str
) -> None:
    inertia = SHAPES[shape]
    friction = rolling_friction(mu, shape=inertia)
    for gravity in (GRAVITY, MOON_GRAVITY):
        time = rolling_time(distance, friction, shape=inertia, gravity=gravity)
        assert 0.5 * mu * gravity * time**2 == pytest.approx(distance)


@pytest.mark.parametrize("shape", sorted(SHAPES))
def test_the_inertia_of_a_shape_by_its_points(shape: str) -> None:
    rng = np.random.default_rng(1)
    points = rng.normal(size=(400_000, 3))
    if shape == "ring":
        square = np.ones(10)
    elif shape == "cylinder":
        square = rng.uniform(size=400_000)  # r^2 of points of a disc
    else:
        points /= np.linalg.norm(points, axis=1)[:, None]
        radius = rng.uniform(size=400_000) ** (1 / 3) if shape == "ball" else 1.0
        square = (points[:, 0] ** 2 + points[:, 1] ** 2) * radius**2
    bound = 5.0 * float(square.std()) / math.sqrt(square.size) + 1e-12
    assert SHAPES[shape] == pytest.approx(float(square.mean()), abs=bound)


@given(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))
def test_energy_by_inertia(speed: float, rim: float) -> None:
    ball = Ball()
    energy = kinetic_energy(ball, speed, rim)
    assert energy.translational == pytest.approx(0.5 * ball.mass * speed**2)
    assert energy.rotational == pytest.approx(0.5 * ball.inertia * (rim / ball.radius) ** 2)
    assert energy.total == energy.translational + energy.rotational


# Table speed: the lag that it comes from.


@given(st.floats(3.0, 12.0))
def test_a_lag_of_that_time_stops_at_the_cushion(lag_time: float) -> None:
    cloth = Cloth(mu_roll=1.0 / table_speed(lag_time))
    speed = lag_speed(lag_time)
    length = lag_distance(PoolTable(), Ball())
    assert cloth.table_speed == pytest.approx(table_speed(lag_time))
    assert roll_time(speed, cloth) == pytest.approx(lag_time)
    assert roll_distance(speed, cloth) == pytest.approx(length)
    ball = Ball()
    rolled = Slide(ball, cloth, [0.0, 0.0], [speed, 0.0], [0.0, speed / ball.radius, 0.0])
    assert rolled.stop_position == pytest.approx([length, 0.0], abs=1e-9)
    assert rolled.stop_time == pytest.approx(lag_time)


def test_two_times_the_square_of_the_time() -> None:
    times = np.array([5.0, 7.0, 8.0])
    assert table_speed(times) == pytest.approx(2.0 * times**2, rel=0.02)
    assert type(table_speed(7.0)) is float


def test_the_names_of_speeds_go_up() -> None:
    ends = [end for low_high in TABLE_SPEEDS.values() for end in low_high]
    assert ends == sorted(ends)
    assert ends[-1] == math.inf


def test_refusals() -> None:
    with pytest.raises(
        InputError, match=r"lag_time must be a number from 1e-50 to 1e\+50; it is 0\.0"
    ):
        table_speed(0.0)
    with pytest.raises(
        InputError, match=r"distance must be a number from 1e-50 to 1e\+50; it is 0\.0"
    ):
        table_speed(7.0, distance=0.0)
    with pytest.raises(InputError, match=r"speed must be a number from 0 to 1e\+50; it is -1\.0"):
        roll_time(-1.0, Cloth())
