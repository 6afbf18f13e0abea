"""The curves pass through the exact values, and show what the text says of its figures."""

from __future__ import annotations

import functools
import math
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from evenbreak.plots.diagram import image_bytes
from evenbreak.source_text.physics.chosen import CAPTIONS
from evenbreak.source_text.physics.figure_frames import figure_frames
from evenbreak.source_text.physics.figures import figures

NAMES = tuple(f"figure_{n}" for n in ("3_1", "3_2", "3_3", "3_4", "4_4", "4_5", "4_7", "4_8"))
RATIOS = (1.0, 1 / 2, 1 / 3, 1 / 4)
SIN, COS = 0.5, math.sqrt(0.75)


@functools.cache
def figure(name: str) -> Any:
    return figures()[name]()


def curves(axes: Any) -> list[Any]:
    """Return the points of every curve: not of single marks, nor of lines across the axes."""
    drawn = [np.array(line.get_xydata(), float) for line in axes.lines]
    return [points for points in drawn if len(points) > 2]


def marks(axes: Any) -> Any:
    return np.array([line.get_xydata()[0] for line in axes.lines if len(line.get_xdata()) == 1])


def at(curve: Any, x: float) -> float:
    return float(np.interp(x, *curve.T))


def marked(axes: Any, x: float, y: float, tolerance: float = 1e-9) -> bool:
    """Return whether a mark stands at (x, y)."""
    return bool((np.abs(marks(axes) - (x, y)) < tolerance).all(axis=1).any())


def lines_of_ball(axes: Any) -> list[Any]:
    """Return the straight lines within a ball: black, and of two points."""
    drawn = [line for line in axes.lines if line.get_color() == "black"]
    ends = [np.array(line.get_xydata(), float) for line in drawn]
    return [points for points in ends if len(points) == 2]


def test_the_figures_are_named_by_their_numbers() -> None:
    assert tuple(figures()) == tuple(CAPTIONS) == tuple(sorted(figures()))
    assert set(NAMES) <= set(figures())


@pytest.mark.parametrize("name", NAMES)
def test_every_panel_says_what_its_axes_measure(name: str) -> None:
    for axes in figure(name).axes:
        # The second scale of Fig. 4.7 shares the cut angles of the first.
        shares = name == "figure_4_7" and axes is figure(name).axes[1]
        assert shares or axes.get_xlabel()
        assert axes.get_ylabel()


@pytest.mark.parametrize("name", [name for name in NAMES if name != "figure_4_7"])
def test_what_is_chosen_is_said_in_the_picture_and_beside_it(name: str) -> None:
    drawn = figure(name)
    texts = [axes.get_title() for axes in drawn.axes]
    if drawn.get_suptitle():
        texts.append(drawn.get_suptitle())
    assert any("chosen" in text for text in texts)
    assert "chosen" in CAPTIONS[name]


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


def test_a_ball_is_fastest_struck_in_the_centre() -> None:
    drawn = curves(figure("figure_3_3").axes[0])
    assert [at(curve, 0.0) for curve in drawn] == pytest.approx([1, 4 / 3, 3 / 2, 8 / 5])
    for curve, m in zip(drawn, RATIOS, strict=True):
        offset, speed = curve.T
        assert speed == pytest.approx(2 / (1 + m + 2.5 * offset**2))
        assert (offset[0], offset[-1]) == pytest.approx((-0.7, 0.7))


def test_a_lag_is_longest_a_little_above_the_centre() -> None:
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
def test_curves_differ_without_colour(name: str) -> None:
    axes = figure(name).axes[0]
    named = [line for line in axes.lines if not line.get_label().startswith("_")]
    assert len({str(line._unscaled_dash_pattern) for line in named}) == len(named) >= 4


def test_the_legend_says_the_mass_ratios() -> None:
    for name in ("figure_3_3", "figure_3_4"):
        legend = figure(name).axes[0].get_legend()
        texts = [text.get_text() for text in legend.get_texts()]
        assert texts == ["$m$ = 1", "$m$ = 1/2", "$m$ = 1/3", "$m$ = 1/4"]


# Fig. 4.4


def test_throw_factors_follow_the_formula_and_cross_where_nothing_slips_sideways() -> None:
    stun, *others = curves(figure("figure_4_4").axes[0])
    for curve, topspin in zip(others, (0.1, 0.25, 0.5, 1.0), strict=True):
        side, factor = curve.T
        assert factor == pytest.approx((SIN + side) / np.hypot(SIN + side, topspin * COS))
        assert at(curve, -0.5) == pytest.approx(0, abs=1e-6)
        slope = (at(curve, -0.499) - at(curve, -0.501)) / 0.002
        assert slope == pytest.approx(1 / (topspin * COS), rel=0.01)
    assert at(others[-1], 0.0) == pytest.approx(0.5)
    side, factor = stun.T
    assert (factor[side < -0.5] == -1).all()
    assert (factor[side > -0.5] == 1).all()
    assert not (side == -0.5).any()
    # The step is drawn upright.
    assert np.diff(side[np.abs(side + 0.5) < 1e-6]) == pytest.approx(0, abs=1e-8)


# Fig. 4.5


def contours(axes: Any) -> Any:
    return next(lines for lines in axes.collections if hasattr(lines, "levels"))


def sensitivity(side: Any, topspin: Any) -> Any:
    """Return F by the two derivatives as P4.5 prints them, with the lost power 3/2."""
    u, w = SIN + side, topspin * COS
    by_topspin = -u * w * COS / (u**2 + w**2) ** 1.5
    by_side = w**2 / (u**2 + w**2) ** 1.5
    return np.hypot(by_topspin, by_side)


def test_adjacent_contours_differ_by_a_factor_of_two() -> None:
    whole, inset = (2.0 ** contours(axes).levels for axes in figure("figure_4_5").axes)
    assert whole.tolist() == [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8]
    assert inset.tolist() == [2, 4, 8, 16, 32, 64]


@pytest.mark.parametrize("panel", [0, 1])
def test_contours_run_where_the_sensitivity_is_theirs(panel: int) -> None:
    axes = figure("figure_4_5").axes[panel]
    lines = contours(axes)
    for level, pieces in zip(2.0**lines.levels, lines.allsegs, strict=True):
        side, topspin = np.vstack(pieces).T
        far = np.hypot(side + 0.5, topspin) > 0.1 * np.abs(axes.get_ylim()).max()
        if far.any():
            assert sensitivity(side, topspin)[far] == pytest.approx(level, rel=0.02)
        # It is 1 / |J_y cos(a)| above and below the point where nothing slips. Below, no label
        # cuts the line.
        below = -topspin[np.abs(side + 0.5) < 0.02 * axes.get_ylim()[1]]
        if level * axes.get_ylim()[1] * COS > 1:
            assert below.max() == pytest.approx(1 / (level * COS), rel=0.01)


def test_the_inset_enlarges_the_point_where_nothing_slips() -> None:
    whole, inset = figure("figure_4_5").axes
    assert whole.get_xlim() == whole.get_ylim() == (-2, 2)
    assert inset.get_xlim() == pytest.approx((-0.6, -0.4))
    assert inset.get_ylim() == pytest.approx((-0.1, 0.1))


def test_contours_are_labelled_with_their_sensitivity() -> None:
    whole, inset = (
        [text.get_text() for text in contours(axes).labelTexts]
        for axes in figure("figure_4_5").axes
    )
    assert sorted(whole) == ["1", "1/16", "1/2", "1/4", "1/8", "2", "4"]
    assert sorted(inset, key=int) == ["2", "4", "8", "16", "32", "64"]


# Fig. 4.7


def test_deflections_pass_through_the_points_of_the_text() -> None:
    axes, slope = figure("figure_4_7").axes
    roll, stun, draw = curves(axes)
    cut = np.radians(roll[:, 0])
    inner = (cut > 0) & (cut < math.pi / 2)
    product, square = np.sin(cut) * np.cos(cut), np.sin(cut) ** 2
    for curve, extra in ((roll, 0.4), (draw, -0.4)):
        exact = np.degrees(np.arctan2(product, square + extra))
        assert curve[inner, 1] == pytest.approx(exact[inner], abs=1e-9)
    assert stun[:, 1] == pytest.approx(90 - stun[:, 0], abs=1e-9)
    assert at(roll, 30.0) == pytest.approx(33.67, abs=0.005)
    assert at(roll, 26.0) == pytest.approx(33.64, abs=0.005)
    assert roll[:, 1].max() == pytest.approx(33.749, abs=5e-4)
    assert (draw[0, 1], draw[-1, 1]) == pytest.approx((180, 0), abs=1e-9)
    (falling,) = curves(slope)
    assert falling[:, 1] == pytest.approx(14 / (4 + 45 * square) - 1)
    assert falling[[0, -1], 1] == pytest.approx([5 / 2, -5 / 7])
    assert (np.diff(falling[:, 1]) <= 0).all()


@pytest.mark.parametrize(
    ("cut", "deflection"),
    [
        (14.963, 28.126),
        (28.126, 33.749),
        (30.0, 33.670),
        (33.211, 33.211),
        (45.0, 45.0),
        (56.789, 56.789),
        (39.232, 90.0),
    ],
)
def test_the_points_of_the_text_are_marked(cut: float, deflection: float) -> None:
    assert marked(figure("figure_4_7").axes[0], cut, deflection, 6e-4)


@pytest.mark.parametrize(
    ("cut", "slope"),
    [(0, 5 / 2), (14.963, 1), (28.126, 0), (30, -5 / 61), (33.211, -1 / 5), (90, -5 / 7)],
)
def test_the_points_of_the_slope_are_marked(cut: float, slope: float) -> None:
    assert marked(figure("figure_4_7").axes[1], cut, slope, 6e-4)


def test_energies_are_even_where_the_line_of_equal_angles_crosses() -> None:
    axes, slope = figure("figure_4_7").axes
    (straight,) = [line for line in axes.lines if list(line.get_xdata()) == [0, 90]]
    assert list(straight.get_ydata()) == [0, 90]
    assert slope.lines[0].get_linestyle() == "--"


def test_every_letter_has_its_line_in_the_key() -> None:
    axes, slope = figure("figure_4_7").axes
    letters, names, cuts, *_ = [
        text.get_text().split("\n") for text in axes.texts if "\n" in text.get_text()
    ]
    assert letters[1:] == list("ABCDEFGHI")
    assert len(names) == len(cuts) == len(letters)
    beside = [text.get_text() for panel in (axes, slope) for text in panel.texts]
    assert set(letters[1:]) <= set(beside)


# Fig. 4.8


def test_the_tips_without_throw_lie_on_a_line_from_the_cloth() -> None:
    axes = figure("figure_4_8").axes[0]
    line = next(points for points in lines_of_ball(axes) if points[1, 0] != 0)
    y, z = line.T
    assert y == pytest.approx(z / 7, abs=1e-12)  # y = -(2 y_cp / 7R) z with y_cp = -R/2
    assert z[0] == pytest.approx(0, abs=1e-8)
    for point in ((0.2, 1.4), (-0.5, 1.0), (0.14, 0.98)):
        assert marked(axes, *point)
    assert math.hypot(0.14, 0.98 - 0.5) == pytest.approx(0.5)


# All


@pytest.mark.parametrize("name", ["figure_3_1", "figure_4_5"])
def test_a_plot_drawn_again_is_the_same_to_the_byte(name: str) -> None:
    draw = figures()[name]
    assert image_bytes(draw(), "svg") == image_bytes(draw(), "svg")


def test_a_readers_own_settings_do_not_change_a_plot() -> None:
    draw = figures()["figure_3_3"]
    usual = image_bytes(draw(), "svg")
    with mpl.rc_context({"font.size": 20, "axes.linewidth": 3, "savefig.bbox": "tight"}):
        assert image_bytes(draw(), "svg") == usual


@pytest.mark.parametrize("name", NAMES)
def test_pictures_are_of_moderate_size(name: str) -> None:
    assert 900 <= figure(name).get_size_inches()[0] * 150 <= 1400
    assert len(image_bytes(figure(name), "svg")) < 200_000


@pytest.mark.parametrize("name", NAMES)
def test_no_two_names_overlap(name: str) -> None:
    drawn = figure(name)
    canvas: Any = FigureCanvasAgg(drawn)
    canvas.draw()
    for axes in drawn.axes:
        boxes = [text.get_window_extent() for text in axes.texts if text.get_text()]
        for here, box in enumerate(boxes):
            assert not any(box.overlaps(other) for other in boxes[here + 1 :])


def test_every_plot_has_its_numbers() -> None:
    frames = figure_frames()
    assert set(NAMES) <= set(frames)
    lags = frames["figure_3_4"].set_index("offset").astype(float)
    assert list(lags.loc[0.0]) == pytest.approx([5 / 7, 20 / 21, 15 / 14, 8 / 7], abs=1e-6)
    throws = frames["figure_4_4"].set_index("sidespin")
    assert throws["topspin_0"].isna().sum() == 1
    assert float(throws["topspin_1"].loc[0.0]) == 0.5
    for row in frames["figure_4_5"].astype(float).itertuples():
        exact = float(sensitivity(row.sidespin, row.topspin))
        assert row.sensitivity == pytest.approx(exact, abs=1e-6)
