"""P4.13 to P4.25, beside numbers worked out by hand."""

import math

import pytest

from evenbreak.source_text.answers import compute
from evenbreak.source_text.physics.deflections import ANSWERS


def test_the_path_of_the_cue_ball_is_answered_here():
    assert {problem for problem, _ in ANSWERS} == {f"P4.{n}" for n in range(13, 26)}


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
