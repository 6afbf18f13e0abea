"""The figures of the source text, each drawn once, and what is read off them."""

import functools
from typing import Any

import numpy as np

from evenbreak.source_text.reproduce import figures


@functools.cache
def figure(name: str) -> Any:
    return figures()[name]()


def curves(axes: Any) -> list[Any]:
    """Return the points of every curve: not of single marks, nor of straight lines."""
    drawn = [np.array(line.get_xydata(), float) for line in axes.lines]
    return [points for points in drawn if len(points) > 2]


def at(curve: Any, x: float) -> float:
    return float(np.interp(x, *curve.T))


def marked(axes: Any, x: float, y: float, tolerance: float = 1e-9) -> bool:
    """Return whether a mark stands at (x, y)."""
    marks = [line.get_xydata()[0] for line in axes.lines if len(line.get_xdata()) == 1]
    return bool((np.abs(np.array(marks) - (x, y)) < tolerance).all(axis=1).any())


def lines_of_ball(axes: Any) -> list[Any]:
    """Return the straight lines within a ball: black, and of two points."""
    drawn = [line for line in axes.lines if line.get_color() == "black"]
    ends = [np.array(line.get_xydata(), float) for line in drawn]
    return [points for points in ends if len(points) == 2]


def contours(axes: Any) -> Any:
    """Return the contour lines of a panel."""
    return next(lines for lines in axes.collections if hasattr(lines, "levels"))


def line_at(axes: Any, level: float) -> Any:
    """Return the points of the contour line of a level."""
    lines = contours(axes)
    return np.vstack(lines.allsegs[list(lines.levels).index(level)])
