"""What every system answers: its moves, its charts."""

from dataclasses import replace

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import chart
from evenbreak.handicaps.systems.by_match import PlayedMatch, points_of
from evenbreak.handicaps.systems.npl import NPL


@pytest.mark.parametrize("points", [(1.5, -1), 1, (1,), "12", None])
def test_a_rule_must_return_two_whole_numbers(points):
    broken = replace(NPL, name="broken", rule=lambda _: points)
    with pytest.raises(InputError, match="broken"):
        broken.moves(PlayedMatch((80, 75), (5, 3), (5, 5)))


def test_the_usual_chart_is_the_systems_own_or_its_first():
    assert NPL.usual_chart().name == "npl_10"
    assert replace(NPL, own_chart=None).usual_chart().name == "npl_8"
    with pytest.raises(InputError, match="npl"):
        replace(NPL, own_chart=None, charts=()).usual_chart()


def test_an_own_chart_is_listed_once():
    assert [one.name for one in NPL.known_charts()] == list(NPL.charts)
    other = replace(NPL, own_chart=chart("fargo_r6_hot"))
    assert [one.name for one in other.known_charts()] == [*NPL.charts, "fargo_r6_hot"]


def test_points_are_whole_and_within_reach():
    assert points_of(7, "up") == 7
    for value in (0, 1001, 1.5, "x"):
        with pytest.raises(InputError, match="up must"):
            points_of(value, "up")
