"""One style for all plots: readable in black and white and for the colour-blind."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.text import Text


class LineStyle(NamedTuple):
    """A line that differs from the others in colour and in dashes."""

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
    LineStyle("#882255", (0, (13, 3))),
    LineStyle("#555555", (0, (1, 3))),
)
"""The lines of a plot, in order; the first seven colours are those of Okabe and Ito (2008)."""

_LABEL = 10
"""The font size of a curve's name."""
_BESIDE = {
    "left": ((-6, 0), "right", "center"),
    "right": ((6, -1), "left", "center"),
    "above": ((0, 4), "center", "bottom"),
}


@contextmanager
def our_look() -> Iterator[None]:
    """Set the reader's own matplotlib settings aside, so that everybody gets the same picture.

    >>> import matplotlib as mpl
    >>> with mpl.rc_context({"font.size": 30}), our_look():
    ...     mpl.rcParams["font.size"]
    10.0
    """
    import matplotlib as mpl

    with mpl.rc_context():
        mpl.rcdefaults()
        yield


def new_axes(
    x: str, y: str, *, title: str | None = None, size: tuple[float, float] = (6.0, 4.2)
) -> tuple[Figure, Axes]:
    """Return a figure with one pair of axes, labelled.

    Parameters
    ----------
    x, y
        the labels of the axes, with units.
    title
        text above the axes.
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


def unit_axis(axes: Axes, *which: str) -> None:
    """Let the axes given, "x" or "y", run from 0 to 1, with a tick at every tenth.

    >>> figure, axes = new_axes("p", "W")
    >>> unit_axis(axes, "x", "y")
    >>> axes.get_xticks().round(1).tolist()
    [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
    """
    for name in which:
        axis = {"x": axes.xaxis, "y": axes.yaxis}[name]
        axes.set(**{f"{name}lim": (0.0, 1.0)})
        axis.set_ticks([tenth / 10 for tenth in range(0, 11, 2)])
        axis.set_ticks([tenth / 10 for tenth in range(1, 10, 2)], minor=True)
    axes.tick_params(which="both", direction="in", top=True, right=True)


def label_on(axes: Axes, x: float, y: float, text: str) -> Text:
    """Write a curve's name on the curve, at (x, y) in the units of the axes.

    >>> figure, axes = new_axes("p", "W")
    >>> label_on(axes, 0.5, 0.5, "3:3").get_text()
    '3:3'
    """
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.2}
    return axes.text(x, y, text, fontsize=_LABEL, ha="center", va="center", bbox=box)


def label_beside(
    axes: Axes, x: float, y: float, text: str, side: Literal["left", "right", "above"]
) -> Text:
    """Write a curve's name beside the point (x, y), in the units of the axes.

    >>> figure, axes = new_axes("p", "W")
    >>> label_beside(axes, 0.5, 0.5, "3:3", "left").get_horizontalalignment()
    'right'
    """
    offset, ha, va = _BESIDE[side]
    return axes.annotate(
        text, (x, y), offset, textcoords="offset points", fontsize=_LABEL, ha=ha, va=va
    )
