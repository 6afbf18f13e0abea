"""Dots with names beside them, on a plot of pairs of probabilities."""

from collections.abc import Iterable

from matplotlib.axes import Axes

from evenbreak.plots.style import LINES


def mark_points(axes: Axes, points: Iterable[tuple[float, float, str]]) -> None:
    """Mark points of the unit square by dots, each with its name on the side that has room.

    Points in the same place share a dot and a label. A point whose name is "" has no label.

    >>> from evenbreak.plots.style import new_axes
    >>> _, axes = new_axes("p1", "p2")
    >>> mark_points(axes, [(0.4, 0.8, "1"), (0.4, 0.8, "2"), (1, 1, "3")])
    >>> [text.get_text() for text in axes.texts]
    ['1, 2', '3']
    """
    names: dict[tuple[float, float], list[str]] = {}
    for x, y, name in points:
        names.setdefault((x, y), []).append(name)
    for (x, y), together in names.items():
        right, above = x <= 0.5, y <= 0.5
        axes.plot([x], [y], "o", color=LINES[2].color, mec="white", ms=9, clip_on=False, zorder=5)
        label = ", ".join(filter(None, together))
        if not label:
            continue
        axes.annotate(
            label,
            (x, y),
            xytext=(7 if right else -7, 7 if above else -7),
            textcoords="offset points",
            ha="left" if right else "right",
            va="bottom" if above else "top",
            weight="bold",
            bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none"},
            zorder=6,
        )
