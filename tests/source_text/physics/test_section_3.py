"""Section 3, beside numbers worked out by hand."""

import math

import pytest

from evenbreak.source_text.answers import compute
from evenbreak.source_text.physics.section_3 import ANSWERS


def test_section_3_and_nothing_else_is_answered_here():
    assert {problem for problem, _ in ANSWERS} == {f"P3.{n}" for n in range(1, 12)}


def test_a_hit_in_the_center_keeps_momentum_and_energy():
    inputs = "M_s=18oz M_b=6oz"
    ball, stick = (compute("P3.2", f"V_{one}/V_0", inputs) for one in "bs")
    assert 3 * stick + ball == pytest.approx(3)
    assert 3 * stick**2 + ball**2 == pytest.approx(3)


def test_the_cue_that_breaks_best_solves_a_quadratic():
    best = compute("P3.3", "alpha_s(opt), exact", "M_f=36oz M_b=6oz")
    assert best**2 - best - 2 / 3 * 6 == pytest.approx(0.0, abs=1e-12)


def test_points_of_equal_sidespin_lie_on_the_small_circle():
    assert compute("P3.7", "(y_0^2 + (z_0 - R/2)^2)/R^2", "z_0/R=0.3") == pytest.approx(1 / 4)
    inputs = "y/R=0.35 z/R=0.65"
    spread = compute("P3.9", "spread of z/y of the effective contact points", inputs)
    assert spread == pytest.approx(0.0, abs=1e-9)


def test_a_lag_rolls_farthest_where_the_derivative_is_nothing():
    best = compute("P3.11", "(b/R)_opt, exact", "M_s/M_b=3")
    assert best == pytest.approx(math.sqrt(7 / 5 + 2 / 15) - 1)
