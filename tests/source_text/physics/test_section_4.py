"""Section 4 to P4.12, P4.26 and P4.27, beside numbers worked out by hand."""

import math

import pytest

from evenbreak.source_text.answers import compute
from evenbreak.source_text.physics.section_4 import ANSWERS

MU = 4 / 72


def test_section_4_and_nothing_else_is_answered_here():
    problems = {"Section 4", *(f"P4.{n}" for n in range(1, 28))}
    assert {problem for problem, _ in ANSWERS} == problems


def test_the_factor_is_the_share_of_the_slip_that_is_level():
    left, up = math.sin(0.3) + 0.4, 0.5 * math.cos(0.3)
    factor = compute("P4.2", "cos(gamma)", "alpha=0.3 Jy=0.5 Jz=0.4")
    assert factor == pytest.approx(left / math.hypot(left, up))


def test_slopes_by_differences_are_those_of_the_formula():
    side, up = math.sin(math.pi / 6) + 0.1, 0.5 * math.cos(math.pi / 6)
    inputs = "alpha=30deg Jy=0.5 Jz=0.1"
    slope = compute("P4.5", "dcos(gamma)/dJ_0z", inputs)
    assert slope == pytest.approx(up**2 / math.hypot(side, up) ** 3, rel=1e-9)


def test_momentum_is_kept_in_the_plane():
    inputs = "alpha=0.5 Jy=0.8 Jz=0.3"
    gained = compute("Section 4", "momentum gained in the plane over M V_0", inputs)
    assert gained == pytest.approx(0.0, abs=1e-15)


def test_the_law_of_the_text_makes_energy_in_full_stun_shots():
    quantity = "stun cut below which the text's law makes energy, deg"
    assert compute("P4.10", quantity, "") == pytest.approx(math.degrees(math.atan(3.5 * MU)))


def test_the_tip_that_leaves_no_throw():
    at_once = compute("P4.27", "y_tip/R just after the tip", "alpha=90deg")
    assert at_once == pytest.approx(0.4)


# P4.13 to P4.25, beside numbers worked out by hand.


def test_the_deflection_of_a_half_ball_hit():
    angle = compute("P4.17", "theta, deg", "alpha=30deg")
    assert math.tan(math.radians(angle)) == pytest.approx(0.5 * math.sqrt(0.75) / (0.25 + 0.4))


def test_the_largest_deflection_is_where_its_sine_says_and_a_search_finds_it():
    exact = math.asin(math.sqrt(2) / 3)
    assert compute("P4.15", "alpha_max, rad", "") == pytest.approx(exact)
    assert compute("P4.15", "alpha_max, by search, rad", "") == pytest.approx(exact)


def test_energy_is_split_at_one_cut_for_two_spins():
    low = compute("P4.22", "least J at which one cut splits both", "")
    high = compute("P4.22", "largest J at which one cut splits both", "")
    # 1/2 + J^2/5 just after the hit, 1/2 + J/5 in natural roll.
    assert (low, high) == (pytest.approx(0.0, abs=1e-12), pytest.approx(1.0))


def test_reverse_natural_roll_comes_back_at_a_right_angle():
    cut = compute("P4.25", "cut of a right angle, rad", "Jy=-1")
    assert math.tan(cut) == pytest.approx(math.sqrt(2 / 3))
