"""One look for all plots: readable in black and white, and by the colour-blind."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["LINES", "LineStyle", "new_axes"]


class LineStyle(NamedTuple):
    """A line that is told from the others by its colour and by its dashes."""

    color: str
    linestyle: str | tuple[int, tuple[float, ...]]


LINES = (
    LineStyle("#000000", "-"),
    LineStyle("#0072B2", (0, (6, 2))),
    LineStyle("#D55E00", (0, (6, 2, 1, 2))),
    LineStyle("#009E73", (0, (2, 1.5))),
    LineStyle("#CC79A7", (0, (8, 2, 1, 2, 1, 2))),
    LineStyle("#56B4E9", (0, (3, 1, 3, 4))),
    LineStyle("#E69F00", (0, (1, 1))),
)
"""The lines of a plot in their order; the colours are those of Okabe and Ito (2008)."""


def new_axes(
    x: str, y: str, *, title: str | None = None, size: tuple[float, float] = (6.0, 4.2)
) -> tuple[Figure, Axes]:
    """Return a figure with one pair of axes, labelled.

    Parameters
    ----------
    x, y
        what the axes measure, with the unit.
    title
        written above.
    size
        width and height in inches.

    >>> figure, axes = new_axes("level", "probability")
    >>> axes.get_xlabel()
    'level'
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    axes = figure.add_subplot()
    axes.set(xlabel=x, ylabel=y)
    axes.tick_params(direction="in", top=True, right=True)
    if title:
        axes.set_title(title)
    return figure, axes
