import math

import pytest

from evenbreak.physics.units import (
    CENTIMETER,
    DEGREE,
    FOOT,
    GRAM,
    GRAVITY,
    INCH,
    OUNCE,
)


def test_lengths():
    assert pytest.approx(2.54) == INCH / CENTIMETER
    assert pytest.approx(12.0) == FOOT / INCH
    assert pytest.approx(2.7432) == 9.0 * FOOT


def test_sixteen_ounces_are_a_pound():
    assert pytest.approx(0.45359237) == 16.0 * OUNCE
    assert pytest.approx(28.349523125) == OUNCE / GRAM


def test_a_turn_has_360_degrees():
    assert pytest.approx(2.0 * math.pi) == 360.0 * DEGREE


def test_gravity_is_near_that_of_the_earth():
    assert pytest.approx(9.80665, rel=3e-4) == GRAVITY
