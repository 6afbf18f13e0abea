"""Table speed: the lag that it comes from."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.physics import (
    TABLE_SPEEDS,
    Ball,
    Cloth,
    PoolTable,
    Slide,
    lag_distance,
    lag_speed,
    roll_distance,
    roll_time,
    table_speed,
)


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
    with pytest.raises(InputError, match=r"lag_time is 0\.0"):
        table_speed(0.0)
    with pytest.raises(InputError, match=r"distance is 0\.0"):
        table_speed(7.0, distance=0.0)
    with pytest.raises(InputError, match=r"speed is -1\.0"):
        roll_time(-1.0, Cloth())
