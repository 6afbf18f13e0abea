"""What makes a picture hard to read: texts over one another, small letters, half counts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

SMALLEST = 8.0
"""Points, as a picture is drawn."""

TOUCHING = 0.7
"""Points by which two boxes may overlap: a box has room for letters that the text has not."""

MARKS = ("o", "s", "D", "d", "v", "^")

COUNTS = (
    "week",
    "night",
    "match",
    "shot",
    "score",
    "level",
    "points ",
    "matches ",
    "number of",
    "balls",
)
"""How the label of an axis of counts begins."""


class Placed(NamedTuple):
    """A text that is drawn, and the corners of its box in points, one after the other."""

    text: Text
    corners: Any


def faults(figure: Figure, *, smallest: float = SMALLEST) -> list[str]:
    """Return what is hard to read in a picture.

    >>> figure = Figure()
    >>> _ = figure.text(0.5, 0.5, "over"), figure.text(0.5, 0.5, "under", size=5)
    >>> faults(figure)
    ["'under' has letters of 5 points", "'over' and 'under' overlap"]
    """
    shown = list(_shown(figure))
    small = [
        f"{one.text.get_text()!r} has letters of {one.text.get_fontsize():g} points"
        for one in shown
        if one.text.get_fontsize() < smallest - 1e-6
    ]
    over = [
        f"{one.text.get_text()!r} and {other.text.get_text()!r} overlap"
        for one, other in combinations(shown, 2)
        if _overlap(one.corners, other.corners)
    ]
    return [*small, *over, *_off(figure, shown), *_on_marks(figure, shown), *_half_counts(figure)]


def _shown(figure: Figure) -> Iterator[Placed]:
    """Yield the texts that are drawn."""
    FigureCanvasAgg(figure).draw()  # lays it out, and chooses the ticks
    scale = 72.0 / figure.dpi
    hidden = {id(text) for axis in _axes_of(figure) for text in _hidden_ticks(axis)}
    for text in figure.findobj(Text):
        assert isinstance(text, Text)
        if not text.get_text().strip() or not text.get_visible() or id(text) in hidden:
            continue
        bounds = text.get_window_extent()
        middle = np.array([bounds.x0 + bounds.x1, bounds.y0 + bounds.y1]) / 2.0
        turned = math.radians(text.get_rotation())
        angle, transform = text.get_rotation(), text.get_transform_rotates_text()
        text.set_transform_rotates_text(False)
        text.set_rotation(0.0)
        level = text.get_window_extent()
        text.set_rotation(angle)
        text.set_transform_rotates_text(transform)
        half = np.array([level.width, level.height]) / 2.0 - TOUCHING / 2.0 / scale
        turn = np.array(
            [[math.cos(turned), -math.sin(turned)], [math.sin(turned), math.cos(turned)]]
        )
        signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        yield Placed(text, (middle + (signs * half) @ turn.T) * scale)


def _axes_of(figure: Figure) -> Iterator[Axis]:
    for axes in figure.axes:
        yield from (axes.xaxis, axes.yaxis)


def _hidden_ticks(axis: Axis) -> Iterator[Text]:
    """Yield the labels of ticks that are off the axis, or of an axis that is not drawn."""
    low, high = sorted(axis.get_view_interval())
    edge = 1e-9 * (high - low)
    on = axis.axes.axison and axis.get_visible()
    for minor in (False, True):
        ticks = axis.get_minor_ticks() if minor else axis.get_major_ticks()
        for tick in ticks:
            inside = low - edge <= tick.get_loc() <= high + edge
            for label in (tick.label1, tick.label2):
                if not on or not inside or not label.get_visible():
                    yield label
    if not on:
        yield from (axis.label, axis.offsetText)


def _overlap(one: Any, other: Any) -> bool:
    """Return whether two rectangles have a place in common: no line keeps them apart."""
    for corners in (one, other):
        for first, second in ((0, 1), (1, 2)):
            along = corners[second] - corners[first]
            a, b = one @ along, other @ along
            if a.max() <= b.min() or b.max() <= a.min():
                return False
    return True


def _on_marks(figure: Figure, shown: Sequence[Placed]) -> Iterator[str]:
    """Yield the texts that cover the middle of a dot, square or triangle."""
    lines = [line for axes in figure.axes for line in axes.lines if line.get_marker() in MARKS]
    for line in lines:
        at = np.atleast_2d(line.get_transform().transform(line.get_xydata())) * 72.0 / figure.dpi
        for text, corners in shown:
            if text.axes is None and text.get_figure() is figure:
                continue
            sides = np.roll(corners, -1, axis=0) - corners
            away = at[:, None, :] - corners[None]
            turned = sides[:, 0] * away[..., 1] - sides[:, 1] * away[..., 0]
            if ((turned > 0.0).all(axis=1) | (turned < 0.0).all(axis=1)).any():
                yield f"{text.get_text()!r} covers a mark"


def _off(figure: Figure, shown: Sequence[Placed]) -> Iterator[str]:
    """Yield the texts that run off the picture."""
    wide, high = 72.0 * figure.get_size_inches()
    for text, corners in shown:
        (left, low), (right, top) = corners.min(axis=0), corners.max(axis=0)
        if left < -1.0 or low < -1.0 or right > wide + 1.0 or top > high + 1.0:
            yield f"{text.get_text()!r} runs off the picture"


def _half_counts(figure: Figure) -> Iterator[str]:
    """Yield the axes of counts with a tick between whole numbers."""
    for axis in _axes_of(figure):
        label = axis.label.get_text()
        if label.startswith(COUNTS) and any(
            "." in tick.get_text() for tick in axis.get_ticklabels()
        ):
            yield f"{label!r} has ticks between whole numbers"
