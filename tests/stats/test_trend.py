import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.stats.trend import trend


def test_slope_and_interval_by_the_normal_equations():
    times, scores = np.array([0.0, 1, 2, 4, 7]), np.array([50.0, 53, 51, 55, 58])
    found = trend(times, scores, 0.9)
    away = times - times.mean()
    slope = away @ scores / (away @ away)
    rest = scores - scores.mean() - slope * away
    error = np.sqrt(rest @ rest / 3 / (away @ away))
    assert found.slope == pytest.approx(slope)
    # The 95th percentile of Student's t with 3 degrees of freedom, from a printed table.
    assert found.high - found.slope == pytest.approx(2.353363 * error, rel=1e-6)
    assert found.slope - found.low == pytest.approx(2.353363 * error, rel=1e-6)


def test_scores_on_a_line():
    assert trend([0, 1, 2], [5, 6, 7]) == pytest.approx((1.0, 1.0, 1.0, 0.0), abs=1e-9)


def test_a_slope_of_chance_is_called_one():
    rng = np.random.default_rng(3)
    times = np.arange(6)
    called = [trend(times, rng.normal(50, 3, 6)).p_value < 0.1 for _ in range(1000)]
    assert 0.07 < np.mean(called) < 0.13


@pytest.mark.parametrize(
    ("times", "scores", "remedy"),
    [
        ([0, 1], [5, 6], "three or more scores; you gave 2"),
        ([0, 1], [5, 6, 7], "times has 2 numbers, but scores has 3"),
        ([1, 1, 1], [5, 6, 7], "times are all 1"),
        ([0, 1, 2], [5, 5, 5], "scores are all 5"),
        (
            [1, 2, np.nan],
            [5, 6, 7],
            r"times must be a list of finite numbers, at most 1e\+09; it holds nan",
        ),
    ],
)
def test_no_trend_without_time(times, scores, remedy):
    with pytest.raises(InputError, match=remedy):
        trend(times, scores)
