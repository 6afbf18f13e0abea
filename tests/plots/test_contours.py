"""Contour lines lie where the function has their level, and read without colour."""

from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes

from evenbreak.plots.contours import TENTHS, contour_axes
from evenbreak.plots.picture import new_axes


def drawn(function: Any, **options: Any) -> tuple[Axes, Any]:
    axes = new_axes("", "")
    return axes, contour_axes(axes, function, x="P(one)", y="P(two)", **options)


def share(p1: Any, p2: Any) -> Any:
    """Player 1's share of the racks that the loser breaks: no limit at (0, 0)."""
    return p1 / (p1 + p2)


def test_a_line_lies_where_the_function_has_its_level() -> None:
    _, lines = drawn(share)
    assert tuple(lines.levels) == TENTHS
    for level, pieces in zip(lines.levels, lines.allsegs, strict=True):
        points = np.vstack(pieces)
        p1, p2 = points[np.hypot(*points.T) > 0.1].T
        assert share(p1, p2) == pytest.approx(level, abs=1e-3)


def test_the_function_is_asked_only_for_chances_strictly_between_0_and_1() -> None:
    seen: list[Any] = []

    def asked(p1: Any, p2: Any) -> Any:
        seen.extend((p1, p2))
        return p1 * p2

    drawn(asked)
    assert all(0 < p.min() < 1e-3 and 1 - 1e-3 < p.max() < 1 for p in seen)


def test_p1_runs_along_x() -> None:
    axes, lines = drawn(lambda p1, p2: p1 + 0 * p2, levels=[0.25])
    assert lines.allsegs[0][0][:, 0] == pytest.approx(0.25)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("P(one)", "P(two)")


@pytest.mark.slow
def test_the_main_line_alone_is_thick() -> None:
    assert [width > 1.5 for width in drawn(share)[1].get_linewidths()] == [
        level == 0.5 for level in TENTHS
    ]


def test_negative_lines_alone_are_dashed() -> None:
    _, lines = drawn(lambda p1, p2: p1 - p2, levels=[-0.5, -0.2, 0, 0.2], main=0)
    dashed = [pattern is not None for _, pattern in lines.get_linestyles()]
    assert dashed == [True, True, False, False]
    assert {tuple(color) for color in lines.get_edgecolors()} == {(0, 0, 0, 1)}


def test_every_line_is_labelled_with_its_level_off_the_edge() -> None:
    _, lines = drawn(lambda p1, p2: p1 - p2, levels=[-0.25, 0, 0.25])
    assert [text.get_text() for text in lines.labelTexts] == ["−0.25", "0", "0.25"]
    for text in lines.labelTexts:
        p1, p2 = text.get_position()
        assert p1 - p2 == pytest.approx(float(text.get_text().replace("−", "-")), abs=0.01)
        assert 0.05 < p1 < 0.95
        assert 0.05 < p2 < 0.95


def test_labels_keep_away_from_each_other() -> None:
    spots = [text.get_position() for text in drawn(share)[1].labelTexts]
    apart = [np.hypot(a[0] - b[0], a[1] - b[1]) for a in spots for b in spots if a is not b]
    assert len(spots) == 9
    assert min(apart) > 0.08


def test_a_line_too_near_the_edge_for_a_label_is_drawn_without() -> None:
    _, lines = drawn(lambda p1, p2: p1 + 0 * p2, levels=[0.01, 0.5])
    assert [text.get_text() for text in lines.labelTexts] == ["0.5"]
