"""The loop that all fits share."""

import numpy as np
import pytest

from evenbreak.errors import AccuracyError
from evenbreak.ratings.posterior import MOST_STEPS, damped, find_zero, tolerance


def test_newton_steps_find_the_root_of_a_cube():
    def gradient_at(x):
        return x**3 - 8.0, lambda: (8.0 - x**3) / (3.0 * x**2)

    mode = find_zero(np.array([1.0, 5.0]), gradient_at, 1e-10)
    np.testing.assert_allclose(mode.point, 2.0, rtol=1e-11)
    assert mode.gradient <= 1e-10
    assert 0 < mode.iterations < 15


def test_a_start_at_the_mode_takes_no_step():
    mode = find_zero(np.zeros(3), lambda x: (x, lambda: -x), 0.0)
    assert (mode.gradient, mode.iterations) == (0.0, 0)


def test_giving_up_is_said():
    with pytest.raises(AccuracyError, match=f"after {MOST_STEPS} Newton steps"):
        find_zero(np.ones(1), lambda x: (x, lambda: 0.0 * x), 1e-8)


def test_short_steps_are_taken_whole_and_long_ones_shortened():
    low, high = np.array([0]), np.array([1])
    short, long = np.array([0.8, -0.8]), np.array([50.0, -50.0])
    assert damped(short, low, high) is short
    np.testing.assert_allclose(damped(long, low, high), long * np.log(101.0) / 100.0)


def test_a_weak_prior_needs_a_smaller_gradient_until_rounding_limits_it():
    assert tolerance(4.0, 100.0) == 1e-8
    assert tolerance(0.01, 100.0) == 1e-10
    assert tolerance(1e-6, 1e4) == pytest.approx(1e-10)
