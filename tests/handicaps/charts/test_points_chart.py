import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import PointsChart, points_chart


def test_the_points_that_leagues_print():
    chart = points_chart("apa_9ball")
    assert dict(zip(chart.levels, chart.points, strict=True)) == {
        1: 14, 2: 19, 3: 25, 4: 31, 5: 38, 6: 46, 7: 55, 8: 65, 9: 75
    }  # fmt: skip
    assert chart.race(9, 1) == (75, 14)


@pytest.mark.parametrize("level", [0, 10, 4.5, None, "5"])
def test_a_level_that_the_chart_lacks(level):
    with pytest.raises(InputError, match="level_2"):
        points_chart("apa_9ball").race(5, level)


@pytest.mark.parametrize(
    ("levels", "points"), [([], []), ([1, 2], [5]), ([2, 1], [5, 6]), ([1, 2], [6, 6]), ([1], [0])]
)
def test_what_is_no_chart_of_points(levels, points):
    with pytest.raises(InputError):
        PointsChart("wrong", levels, points)


def test_an_unknown_name():
    with pytest.raises(InputError, match="apa_9ball"):
        points_chart("npl_8")
