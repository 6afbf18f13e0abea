"""The scale that fits a league, in leagues whose scale is known."""

import numpy as np
import pytest

from evenbreak.handicaps import league_chart
from evenbreak.handicaps.charts.fair_scale import fair_scale
from evenbreak.handicaps.charts.played_chart import played_chart
from handicapped import by_chart, by_class


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("levels", [True, False], ids=["ratings", "races alone"])
def test_intervals_hold_the_true_scale(levels):
    held, values = 0, []
    for seed in range(20):
        found = league_chart(by_chart(seed, doubling=25.8, levels=levels, matches=1000)).scale
        held += found.points.low < 25.8 < found.points.high
        values.append(found.points.value)
        assert found.assumed == 30.0
    assert held >= 16
    assert np.mean(values) == pytest.approx(25.8, abs=3 * np.std(values) / 20**0.5)


def test_the_limits_of_a_new_chart_are_those_of_the_old_one():
    found = league_chart(by_chart(1)).scale
    assert (found.games, found.least) == ((7, 9), (5, 2))


def test_without_a_known_chart_the_races_say_what_is_assumed():
    season = by_chart(1, doubling=25.8)
    found = fair_scale(season, None)
    assert found.assumed == pytest.approx(30.0, abs=1.0)
    assert found.points == fair_scale(season, played_chart(season)).points


def test_races_alone_of_an_unknown_chart_say_nothing():
    assert fair_scale(by_class(1, named=False), None) is None
    assert fair_scale(by_class(1), None) is None
