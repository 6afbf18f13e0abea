"""Contour lines over the unit square: the value of a pair of probabilities (p1, p2)."""

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from numpy.typing import NDArray

Surface: TypeAlias = Callable[[Any, Any], Any]

TENTHS = tuple(tenth / 10 for tenth in range(1, 10))
"""The levels 0.1, 0.2, ..., 0.9 of a probability."""

_POINTS = 201
"""Of the grid along each side."""
_INSIDE = 1e-6
"""The distance of the grid from the edges: at a corner a limit may depend on the direction."""
_CLEAR = 0.06
"""The distance of a label from the edge and from other lines; half of it is still enough."""
_NOISE = 12
"""Digits kept, so that a line along which two formulas agree is straight."""


def contour_axes(
    axes: Axes,
    function: Surface,
    *,
    x: str,
    y: str,
    levels: Sequence[float] = TENTHS,
    main: float = 0.5,
) -> QuadContourSet:
    """Draw the contour lines of a function of two probabilities, each labelled with its level.

    Negative levels are dashed, the `main` one is thick. All lines are black, so the figure reads
    the same in black and white.

    Parameters
    ----------
    axes
        the axes to draw on; they become a square of side 1.
    function
        takes two arrays p1 and p2 of the same shape, in (0, 1), and returns an array of that
        shape. p1 and p2 are never exactly 0 or 1.
    x, y
        what p1 and p2 are the probabilities of.
    levels
        the levels of the lines, increasing.
    main
        the level of the thick line, usually the even chance.

    Returns
    -------
    matplotlib.contour.QuadContourSet
        the lines; `.levels` are their levels.

    Notes
    -----
    Source: the style of Figs. 5.3 and 5.6.

    >>> from evenbreak.plots.style import new_axes
    >>> figure, axes = new_axes("", "")
    >>> lines = contour_axes(axes, lambda p1, p2: p1 - p2, x="p1", y="p2", levels=[-0.5, 0, 0.5])
    >>> [text.get_text() for text in lines.labelTexts]
    ['−0.5', '0', '0.5']
    """
    side = np.clip(np.linspace(0.0, 1.0, _POINTS), _INSIDE, 1.0 - _INSIDE)
    p1, p2 = np.meshgrid(side, side)
    values = np.round(function(p1, p2), _NOISE)
    lines = axes.contour(
        p1,
        p2,
        values,
        levels=list(levels),
        colors="black",
        linewidths=[2.0 if level == main else 0.9 for level in levels],
        negative_linestyles="dashed",
    )
    ticks = np.linspace(0.0, 1.0, 6)
    axes.set(xlim=(0, 1), ylim=(0, 1), xticks=ticks, yticks=ticks, aspect="equal")
    axes.clabel(lines, fmt=_level, fontsize=9, manual=_label_places(lines))
    axes.set(xlabel=x, ylabel=y)
    axes.tick_params(direction="in", top=True, right=True)
    return lines


def _label_places(lines: QuadContourSet) -> list[tuple[float, float]]:
    """Return a point on every line: off the edge, clear of other lines, near the centre."""
    pieces = [piece for level in lines.allsegs for piece in level if len(piece) > 1]
    places = []
    for here, piece in enumerate(pieces):
        from_edge = np.minimum(piece, 1.0 - piece).min(axis=1)
        if from_edge.max() < _CLEAR / 2:
            continue
        inner = piece[from_edge >= min(_CLEAR, from_edge.max())]
        others = [other for there, other in enumerate(pieces) if there != here]
        tightness = -np.minimum(_distance(inner, others), _CLEAR)
        off_centre = np.hypot(*(inner - 0.5).T)
        # Rounded, so that of two equally good places the first one is taken.
        best = np.lexsort((np.round(off_centre, 6), np.round(tightness, 6)))[0]
        places.append((float(inner[best, 0]), float(inner[best, 1])))
    return places


def _distance(points: NDArray[np.float64], lines: list[NDArray[np.float64]]) -> Any:
    """Return each point's distance from the nearest vertex of the lines."""
    from scipy.spatial import KDTree

    if not lines:
        return np.full(len(points), np.inf)
    return KDTree(np.vstack(lines)).query(points)[0]


def _level(level: Any) -> str:
    """Return a level with as few digits as possible and a true minus sign."""
    return f"{level:.4g}".replace("-", "\N{MINUS SIGN}")
