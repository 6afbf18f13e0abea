"""Fig. 4.7: where the cue ball goes, by the cut angle."""

import math

import numpy as np
import pytest

from drawings import at, curves, figure, marked


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
