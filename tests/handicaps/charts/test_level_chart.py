from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import LEVEL_CHARTS, LevelChart, level_chart
from places import SHARED

CHARTS = SHARED / "data" / "charts"
TWO = LevelChart("two", [3, 4], [[2, 2], [3, 3]])


@pytest.mark.parametrize(
    ("levels", "race"),
    [((2, 2), (2, 2)), ((7, 2), (7, 2)), ((2, 7), (2, 7)), ((5, 3), (4, 2)), ((6, 5), (5, 4))],
)
def test_races_of_the_printed_chart(levels, race):
    assert level_chart("apa_8ball").race(*levels) == race


def test_the_chart_is_that_of_the_sheet():
    if not CHARTS.is_dir():
        pytest.skip("the sheets lie beside some checkouts only")
    header, *lines = (CHARTS / "apa_8ball.csv").read_text(encoding="utf-8").splitlines()
    assert header == "level,opponent_level,needs,opponent_needs"
    assert len(lines) == 36
    for line in lines:
        own, other, needs, theirs = map(int, line.split(","))
        assert level_chart("apa_8ball").race(own, other) == (needs, theirs)


@pytest.mark.parametrize("name", LEVEL_CHARTS)
def test_many_races_at_once_are_those_one_by_one(name):
    chart = level_chart(name)
    m, n = chart.races(np.array(chart.levels)[:, None], chart.levels)
    for i, own in enumerate(chart.levels):
        for j, other in enumerate(chart.levels):
            assert (m[i, j], n[i, j]) == chart.race(own, other)
            assert chart.race(other, own) == chart.race(own, other)[::-1]


def test_a_chart_is_a_frozen_value():
    assert hash(TWO) == hash(LevelChart("two", (3, 4), ((2, 2), (3, 3))))
    with pytest.raises(FrozenInstanceError):
        TWO.name = "other"


@pytest.mark.parametrize("level", [2, 5, 3.5, "3", None, [3], np.array([3, 4])])
def test_a_level_that_the_chart_lacks_lists_those_it_has(level):
    with pytest.raises(InputError, match="3, 4"):
        TWO.race(3, level)


@pytest.mark.parametrize(
    "levels", [[3, 5], [2], [3.5], [np.nan], ["3"], "3", None, 10**6, [[3], [3, 4]]]
)
def test_levels_that_the_chart_lacks_in_an_array(levels):
    with pytest.raises(InputError, match="3, 4"):
        TWO.races(levels, 3)


def test_shapes_that_do_not_go_together():
    with pytest.raises(InputError, match="shapes"):
        TWO.races([3, 4, 3], [3, 4])


@pytest.mark.parametrize(
    ("levels", "needs", "message"),
    [
        ([], [], "levels must not be empty"),
        ([4, 3], [[2, 2], [3, 3]], "level must increase; 3 comes after 4"),
        ([3, 3], [[2, 2], [3, 3]], "level must increase; 3 comes after 3"),
        ([3.5, 4], [[2, 2], [3, 3]], r"level 1 must be a whole number, 0 or more; you gave 3\.5"),
        ([3, 4], [[2, 2]], "must be a square table for 2 levels"),
        ([3, 4], [[2, 2], [3]], "must be a square table for 2 levels"),
        ([3, 4], [2, 3], "must be a square table for 2 levels"),
        ([3, 4], [[2, 2], [0, 3]], "needs of level 4 against 3 must be .* 1 or more"),
        ([3, 4], [[2, 3], [2, 3]], "level 4 needs 2 games against level 3, which needs 3"),
    ],
)
def test_numbers_that_make_no_chart_are_refused(levels, needs, message):
    with pytest.raises(InputError, match=message):
        LevelChart("mine", levels, needs)


@pytest.mark.parametrize("name", ["npl_8", "", None])
def test_an_unknown_chart_lists_the_known(name):
    with pytest.raises(InputError, match="apa_8ball"):
        level_chart(name)
