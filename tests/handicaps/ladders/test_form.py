"""Form: normal deviations in whole points, their differences, and means over them."""

import numpy as np
import pytest
from scipy.stats import norm

from evenbreak.handicaps.ladders.form import averages, deviation_grid, deviations, difference_law
from slow_ladders import rounded_normal


@pytest.mark.parametrize("sd", [0.5, 2.0, 30.0])
def test_deviations_are_a_rounded_normal(sd):
    law = deviations(sd)
    points = np.arange(len(law)) - len(law) // 2
    np.testing.assert_allclose(law, rounded_normal(points, sd), atol=1e-12)
    assert law.sum() == pytest.approx(1.0)
    np.testing.assert_array_equal(law, law[::-1])


def test_a_difference_has_the_variances_of_all_four_deviations():
    law = difference_law(3.0, 4.0)
    points = np.arange(len(law)) - len(law) // 2
    # Each deviation is rounded, which adds 1/12.
    assert law @ points**2 == pytest.approx(2 * (9.0 + 16.0) + 4 / 12, abs=1e-9)


@pytest.mark.parametrize("sd", [1.0, 8.0, 70.0])
def test_a_mean_over_the_grid_is_that_over_every_point(sd):
    law = deviations(sd)
    every = np.arange(len(law)) - len(law) // 2
    points, weights = deviation_grid(law, 30.0)
    assert len(points) <= len(every)

    def chance(x):
        return 1.0 / (1.0 + 2.0 ** (-(x + 11.0) / 30.0))

    assert weights @ chance(points) == pytest.approx(law @ chance(every), abs=1e-11)


@pytest.mark.parametrize("few", [0, 1 << 40])
def test_averages_by_sums_and_by_transforms(monkeypatch, few):
    monkeypatch.setitem(averages.__globals__, "_FEW", few)
    values, law = norm.cdf(np.linspace(-3, 3, 200)), difference_law(2.0)
    found = averages(values, law)
    assert len(found) == len(values) - len(law) + 1
    by_hand = [law @ values[k : k + len(law)] for k in range(len(found))]
    np.testing.assert_allclose(found, by_hand, atol=1e-14)
