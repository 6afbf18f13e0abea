import math

import pytest

from evenbreak.physics import ContactPoint, small_circle_point
from evenbreak.plots.picture import new_axes
from evenbreak.source_text.physics.tip_figures import angle_arc, ball_view, name_point, roll_chord


@pytest.fixture
def axes():
    _, axes = new_axes("", "")
    ball_view(axes, "a ball")
    return axes


@pytest.mark.parametrize("side", [-2.0, 0.5, 3.5])
def test_a_chord_from_the_cloth_ends_on_the_outline(side):
    end = roll_chord(small_circle_point(side))
    assert math.hypot(end.y, end.z - 1.0) == pytest.approx(1.0)


def test_the_ball_is_round_and_left_is_left(axes):
    assert axes.get_aspect() == 1.0
    assert axes.get_xlim()[0] > axes.get_xlim()[1]
    assert axes.patches[0].center == (0.0, 1.0)


def test_a_point_is_marked_and_named(axes):
    name_point(axes, ContactPoint(0.2, 1.4), "here", (6, 0), "left")
    assert axes.lines[-1].get_xydata().tolist() == [[0.2, 1.4]]
    assert axes.texts[-1].get_text() == "here"


def test_an_arc_runs_from_the_upright_to_the_point(axes):
    angle_arc(axes, ContactPoint(0.5, 0.5), 0.3, "a")
    arc = axes.lines[-1].get_xydata()
    assert arc[0] == pytest.approx((0.0, 0.3))
    assert arc[-1] == pytest.approx((0.3 * math.sqrt(0.5), 0.3 * math.sqrt(0.5)))
