"""Figs. 3.1 to 3.4: where the tip hits, and how fast the ball gets."""

import math

import numpy as np
import pytest

from drawings import at, curves, figure, lines_of_ball, marked
from evenbreak.physics import ContactPoint, small_circle_point
from evenbreak.plots.picture import new_axes
from evenbreak.source_text.physics.section_3_plots import (
    angle_arc,
    ball_view,
    name_point,
    roll_chord,
)

RATIOS = (1.0, 1 / 2, 1 / 3, 1 / 4)


# Fig. 3.1


def test_upright_lines_have_the_sidespin_of_the_tip() -> None:
    lines = lines_of_ball(figure("figure_3_1").axes[0])
    assert len(lines) == 11
    for line, side in zip(lines, np.arange(-1.25, 1.5, 0.25), strict=True):
        # J = 5 y / 2R by its size; the tip is to the right, y < 0, for right english.
        assert line[:, 0] == pytest.approx(-2 * side / 5, abs=1e-12)
        assert np.hypot(line[:, 0], line[:, 1] - 1) == pytest.approx(1, abs=1e-12)


def test_lines_of_natural_roll_meet_where_the_ball_stands() -> None:
    lines = lines_of_ball(figure("figure_3_1").axes[1])
    assert len(lines) == 15
    for line, side in zip(lines, np.arange(-3.5, 4, 0.5), strict=True):
        assert line[0].tolist() == [0, 0]
        y, z = line[1]
        assert -7 * y / (2 * z) == pytest.approx(side, abs=1e-12)
        assert math.hypot(y, z - 1) == pytest.approx(1, abs=1e-12)


def test_the_height_of_natural_roll_is_seven_fifths_of_the_radius() -> None:
    for name, panel in (("figure_3_1", 1), ("figure_4_8", 0)):
        level = [
            line for line in figure(name).axes[panel].lines if list(line.get_ydata()) == [1.4, 1.4]
        ]
        assert len(level) == 1


def test_sidespins_are_written_at_their_lines() -> None:
    after_tip, in_roll = figure("figure_3_1").axes
    for axes, count in ((after_tip, 11), (in_roll, 15)):
        texts = [text.get_text() for text in axes.texts]
        assert len(set(texts)) == count
    place = {text.get_text(): text.get_position()[0] for text in after_tip.texts}
    assert place["1"] == pytest.approx(-0.4)
    assert place["−1¼"] == pytest.approx(0.5)


# Fig. 3.2


def test_the_small_circle_is_half_as_wide_as_the_ball() -> None:
    circle, touching, *_ = sorted(curves(figure("figure_3_2").axes[0]), key=lambda c: -len(c))
    assert np.hypot(circle[:, 0], circle[:, 1] - 0.5) == pytest.approx(0.5, abs=1e-12)
    assert np.abs(circle[:, 0]).max() == pytest.approx(0.5, abs=1e-4)
    # The point (R/2, R/2) of P3.8 lies between two points of it.
    assert np.hypot(*(circle - (0.5, 0.5)).T).min() < 0.01
    # J_z = 2: tan(a) = 2 * 2/7, and the other circle touches the line.
    sine = (4 / 7) / math.hypot(1, 4 / 7)
    assert np.hypot(touching[:, 0], touching[:, 1] - 1) == pytest.approx(sine, abs=1e-12)
    z = 1 / (1 + (4 / 7) ** 2)
    assert marked(figure("figure_3_2").axes[0], -4 / 7 * z, z)


def test_the_triangle_has_a_right_angle_at_the_nearest_point() -> None:
    axes = figure("figure_3_2").axes[0]
    triangle = next(points for points in curves(axes) if points[:2].tolist() == [[0, 0], [0, 1]])
    corner = triangle[2]
    assert np.dot(corner, corner - (0, 1)) == pytest.approx(0, abs=1e-12)
    (line,) = [points for points in lines_of_ball(axes) if abs(points[1, 0]) > 0]
    assert line[1, 0] / line[1, 1] == pytest.approx(corner[0] / corner[1])


# Figs. 3.3 and 3.4


def test_a_ball_is_fastest_struck_in_the_center() -> None:
    drawn = curves(figure("figure_3_3").axes[0])
    assert [at(curve, 0.0) for curve in drawn] == pytest.approx([1, 4 / 3, 3 / 2, 8 / 5])
    for curve, m in zip(drawn, RATIOS, strict=True):
        offset, speed = curve.T
        assert speed == pytest.approx(2 / (1 + m + 2.5 * offset**2))
        assert (offset[0], offset[-1]) == pytest.approx((-0.7, 0.7))


def test_a_lag_is_longest_a_little_above_the_center() -> None:
    axes = figure("figure_3_4").axes[0]
    for curve, m in zip(curves(axes), RATIOS, strict=True):
        offset, speed = curve.T
        assert speed == pytest.approx(10 / 7 * (1 + offset) / (1 + m + 2.5 * offset**2))
        best = math.sqrt(7 / 5 + 2 * m / 5) - 1
        assert offset[np.argmax(speed)] == pytest.approx(best, abs=0.005)
        assert marked(axes, best, 10 / 7 * (1 + best) / (1 + m + 2.5 * best**2))
    upright = [line.get_xdata()[0] for line in axes.lines if len(line.get_xdata()) == 2]
    assert upright == [0.0, 0.4]
    texts = [text.get_text() for text in axes.texts]
    assert {"0.238", "0.225"} <= set(texts)


@pytest.mark.parametrize("name", ["figure_3_3", "figure_3_4", "figure_4_4"])
def test_curves_differ_without_color(name: str) -> None:
    axes = figure(name).axes[0]
    named = [line for line in axes.lines if not line.get_label().startswith("_")]
    assert len({str(line._unscaled_dash_pattern) for line in named}) == len(named) >= 4


def test_the_legend_says_the_mass_ratios() -> None:
    for name in ("figure_3_3", "figure_3_4"):
        legend = figure(name).axes[0].get_legend()
        texts = [text.get_text() for text in legend.get_texts()]
        assert texts == ["$m$ = 1", "$m$ = 1/2", "$m$ = 1/3", "$m$ = 1/4"]


@pytest.fixture
def axes():
    axes = new_axes("", "")
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
