"""Dots stand at their points, and names where the square has room."""

import pytest

from evenbreak.plots.picture import mark_points, new_axes, unit_axis


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("x", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("y", [0.0, 0.5, 1.0])
def test_a_name_stays_inside_the_square(x: float, y: float) -> None:
    axes = new_axes("", "")
    unit_axis(axes, "x", "y")
    mark_points(axes, [(x, y, "1")])
    axes.figure.canvas.draw()
    square, name = axes.get_window_extent(), axes.texts[0].get_window_extent()
    assert square.x0 < name.x0 < name.x1 < square.x1
    assert square.y0 < name.y0 < name.y1 < square.y1


def test_points_in_one_place_share_a_dot_and_a_bare_dot_has_no_name() -> None:
    axes = new_axes("", "")
    mark_points(axes, [(0.2, 0.3, "1"), (0.2, 0.3, "2"), (0.7, 0.3, "")])
    assert [tuple(line.get_xydata()[0]) for line in axes.lines] == [(0.2, 0.3), (0.7, 0.3)]
    assert [text.get_text() for text in axes.texts] == ["1, 2"]
