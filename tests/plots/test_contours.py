"""Contour lines lie where the function has their level, and read without color."""

from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes

from evenbreak import InputError
from evenbreak.games import Rack
from evenbreak.plots.contours import TENTHS, breaks_figure, contour_axes, draw_shots
from evenbreak.plots.picture import image_bytes, new_axes
from evenbreak.practice import ShotChoice


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


def test_every_line_is_labeled_with_its_level_off_the_edge() -> None:
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


def titles(figure):
    return [axes.get_title() for axes in figure.axes]


@pytest.mark.slow
def test_titles_have_the_shares_and_every_panel_the_dot():
    figure = breaks_figure(Rack(0.5, 0.1))
    assert titles(figure) == [
        "Winner breaks: A wins 64.3%",
        "Loser breaks: A wins 83.3%",
        "Alternate breaks: A wins 70.0%",
        "Winner minus loser breaks: \N{MINUS SIGN}19.0%",
    ]
    for axes in figure.axes:
        assert [(line.get_xdata()[0], line.get_ydata()[0]) for line in axes.lines] == [(0.5, 0.1)]


def test_the_first_breaker_counts_where_the_break_never_passes_on():
    assert titles(breaks_figure(Rack(1, 1)))[0] == "Winner breaks: A wins 100.0%"
    assert titles(breaks_figure(Rack(1, 1), first_breaker=2))[0] == "Winner breaks: A wins 0.0%"


def test_a_rack_whose_break_does_not_matter_is_on_the_diagonal():
    (dot,) = breaks_figure(Rack(0.6)).axes[0].lines
    assert (dot.get_xdata()[0], dot.get_ydata()[0]) == (0.6, 0.4)


def test_arrays_are_refused():
    with pytest.raises(InputError, match="one number"):
        breaks_figure(Rack([0.5, 0.6], 0.5))


def test_the_picture_says_what_it_shows():
    title, dot = breaks_figure(Rack(0.62, 0.55)).get_suptitle().splitlines()
    assert "long-run" in title
    assert "62%" in dot
    assert "55%" in dot


SHOTS = [ShotChoice("bank", 0.4, 0.8), ShotChoice("safety", 0.3, 0.3)]


@pytest.mark.parametrize("look_ahead", ["infinite", "two shots"])
def test_shots_stand_at_their_chances_by_name(look_ahead):
    axes = draw_shots(SHOTS, look_ahead=look_ahead)
    dots = [(line.get_xdata()[0], line.get_ydata()[0]) for line in axes.lines]
    assert dots == [(0.4, 0.8), (0.3, 0.3)]
    names = {note.get_text(): note.xy for note in axes.texts if hasattr(note, "xy")}
    assert names == {"bank": (0.4, 0.8), "safety": (0.3, 0.3)}


@pytest.mark.slow
def test_the_look_aheads_look_different_and_each_the_same_every_time():
    pictures = [
        image_bytes(draw_shots(SHOTS, look_ahead=look_ahead), "svg")
        for look_ahead in ("infinite", "infinite", "two shots")
    ]
    assert pictures[0] == pictures[1] != pictures[2]


def test_an_unknown_look_ahead_is_refused():
    with pytest.raises(InputError, match="'infinite' or 'two shots'"):
        draw_shots(SHOTS, look_ahead="three shots")
