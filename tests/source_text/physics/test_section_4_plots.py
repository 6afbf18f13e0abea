"""Figs. 4.4, 4.5 and 4.8: throw, its sensitivity, and the tips that cancel it."""

import math
from typing import Any

import numpy as np
import pytest

from drawings import at, contours, curves, figure, lines_of_ball, marked

SIN, COS = 0.5, math.sqrt(0.75)


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


def test_contours_are_labeled_with_their_sensitivity() -> None:
    whole, inset = (
        [text.get_text() for text in contours(axes).labelTexts]
        for axes in figure("figure_4_5").axes
    )
    assert sorted(whole) == ["1", "1/16", "1/2", "1/4", "1/8", "2", "4"]
    assert sorted(inset, key=int) == ["2", "4", "8", "16", "32", "64"]


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


# Fig. 4.7: where the cue ball goes, by the cut angle.


@pytest.mark.slow
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
