"""Section 2, beside numbers worked out by hand."""

import math

import pytest

from evenbreak.source_text.answers import compute
from evenbreak.source_text.physics.natural_roll import ANSWERS


def test_section_2_and_nothing_else_is_answered_here():
    problems = {problem for problem, _ in ANSWERS}
    assert problems == {"Section 2", "Exercise 2.1", *(f"P2.{n}" for n in range(1, 7))}


def test_natural_roll_takes_five_sevenths_of_the_speed_and_two_of_the_spin():
    assert compute("P2.2", "V_NR/V_0", "J=-1") == pytest.approx(3 / 7)
    assert compute("P2.2", "J at which V_NR is 0", "") == pytest.approx(-5 / 2)


def test_a_drag_shot_goes_at_the_mean_of_its_two_speeds():
    mean = compute("Exercise 2.1", "mean speed of a drag shot over V_0", "J=-1")
    assert mean == pytest.approx((1 + 3 / 7) / 2)


def test_a_sliding_ball_slips_one_way_and_so_draws_a_parabola():
    inputs = "V_x=60in/s V_y=10in/s w_x=25 w_y=-40 w_z=3"
    spread = compute("P2.3", "spread of the direction of friction during a slide, rad", inputs)
    assert spread == pytest.approx(0.0, abs=1e-12)


def test_on_the_moon_a_lag_takes_the_root_of_the_gravities_longer():
    assert compute("P2.5", "sqrt(g/g on the moon)", "") == pytest.approx(math.sqrt(386 / 63.8))
