"""Section 1, beside numbers worked out by hand."""

import math

import pytest

from evenbreak.source_text.answers import compute
from evenbreak.source_text.physics.equipment import ANSWERS


def test_section_1_and_nothing_else_is_answered_here():
    assert {problem.split(".")[0] for problem, _ in ANSWERS} == {"Section 1", "P1"}


def test_the_moment_of_inertia_of_a_ball_is_two_fifths():
    assert compute("P1.3", "I/(M R^2)", "") == pytest.approx(0.4)
    assert compute("P1.3", "S_zz/(M R^2), integrated", "") == pytest.approx(0.4 / 2.0)
    assert compute("P1.3", "I_xy/(M R^2), integrated", "") == pytest.approx(0.0, abs=1e-12)


def test_a_block_stops_after_the_square_of_its_speed():
    quantity = "distance, when the velocity doubles, over the one before"
    assert compute("Section 1", quantity, "V_0=50in/s mu=0.2") == pytest.approx(4.0)


def test_table_speed_is_nearly_twice_the_square_of_the_seconds():
    assert compute("P1.5", "table speed", "t=7.00s") == pytest.approx(386 * 49 / (2 * 97.75))


def test_a_tip_slips_where_the_angle_of_its_force_is_too_flat():
    assert compute("P1.7", "b_max/R", "mu=1") == pytest.approx(math.sqrt(0.5))
    assert compute("P1.7", "mu of a tip that slips at b/R", "b/R=1/2") == pytest.approx(3**-0.5)
