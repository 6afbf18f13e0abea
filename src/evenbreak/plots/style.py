"""One style for all plots: readable in black and white and for the colour-blind."""

from textwrap import fill
from typing import Any, Literal, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text

from evenbreak.plots.picture import Picture


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
"""The font size of a curve's name, and of a title of several lines."""
_LETTERS_AN_INCH = 11.5
"""How many letters of that size fit into an inch, at least."""
_BESIDE = {
    "left": ((-6, 0), "right", "center"),
    "right": ((6, -1), "left", "center"),
    "above": ((0, 4), "center", "bottom"),
    "below": ((4, -5), "center", "top"),
}


def new_axes(
    x: str,
    y: str,
    *,
    title: str | None = None,
    size: tuple[float, float] = (6.0, 4.2),
    ax: Axes | None = None,
) -> tuple[Picture, Axes]:
    """Return a figure with one pair of axes, labelled.

    Parameters
    ----------
    x, y
        the labels of the axes, with units.
    title
        text above the axes.
    size
        width and height of a new figure in inches.
    ax
        the axes to use; None: those of a new figure.

    >>> figure, axes = new_axes("level", "probability")
    >>> axes.get_xlabel()
    'level'
    """
    figure: Any = Picture(figsize=size, layout="constrained") if ax is None else ax.figure
    axes = figure.add_subplot() if ax is None else ax
    axes.set(xlabel=x, ylabel=y)
    axes.tick_params(direction="in", top=True, right=True)
    if title:
        axes.set_title(title)
    return figure, axes


def legend_below(figure: Picture, ax: Axes | None) -> None:
    """Write the legend below the axes of a new figure, or inside the axes given.

    >>> figure, axes = new_axes("p", "W")
    >>> _ = axes.plot([0, 1], label="3:3")
    >>> legend_below(figure, None)
    >>> len(figure.legends)
    1
    """
    if ax is None:
        figure.legend(frameon=False, loc="outside lower center", ncols=2)
    else:
        ax.legend(frameon=False)


def write_title(figure: Figure, text: str) -> None:
    """Write what is drawn above all panels of a figure, in lines that fit its width.

    >>> figure, axes = new_axes("p", "W")
    >>> write_title(figure, "Race 7:5, score 2:3")
    >>> figure.get_suptitle()
    'Race 7:5, score 2:3'
    """
    width = int(_LETTERS_AN_INCH * figure.get_figwidth())
    lines = [fill(line, width) for line in text.splitlines()]
    figure.suptitle("\n".join(lines), fontsize=_LABEL, parse_math=False)


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
    axes: Axes, x: float, y: float, text: str, side: Literal["left", "right", "above", "below"]
) -> Text:
    """Write a curve's name beside the point (x, y), in the units of the axes.

    >>> figure, axes = new_axes("p", "W")
    >>> label_beside(axes, 0.5, 0.5, "3:3", "left").get_horizontalalignment()
    'right'
    """
    offset, ha, va = _BESIDE[side]
    return note(axes, text, (x, y), offset, fontsize=_LABEL, ha=ha, va=va)


def note(
    axes: Axes, text: str, place: tuple[float, float], beside: tuple[float, float], **style: Any
) -> Text:
    """Write a text beside a place, in the units of the axes, by so many points of the page.

    >>> figure, axes = new_axes("p", "W")
    >>> note(axes, "even", (0.5, 0.5), (6, 0), ha="left").get_text()
    'even'
    """
    return axes.annotate(text, place, beside, textcoords="offset points", **style)


def take_names_as_they_are(axes: Axes) -> None:
    """Show labels and legend without reading a $ in a player's name as mathematics."""
    legend = axes.get_legend()
    for text in (axes.xaxis.label, axes.yaxis.label, *(legend.get_texts() if legend else ())):
        text.set_parse_math(False)
