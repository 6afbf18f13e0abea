"""Section 4 to P4.12, P4.26 and P4.27, beside numbers worked out by hand."""

import math

import pytest

from evenbreak.source_text.answers import compute
from evenbreak.source_text.physics.collisions import ANSWERS

MU = 4 / 72


def test_throw_is_answered_here():
    problems = {"Section 4", "P4.26", "P4.27", *(f"P4.{n}" for n in range(1, 13))}
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
