"""Figures as image files: one style, the same bytes for everyone, and what a notebook shows.

The style is readable in black and white and for the color-blind.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from functools import wraps
from textwrap import fill
from typing import Any, Literal, NamedTuple, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator

from evenbreak.checks import one_of
from evenbreak.errors import InputError

Asked = ParamSpec("Asked")
Drawn = TypeVar("Drawn")


_LOOK: Any = {
    "axes.titlesize": 11,
    "xtick.major.pad": 6,  # the zeros of two axes are apart
    "ytick.major.pad": 5,
}


@contextmanager
def our_look() -> Iterator[None]:
    """Set the user's own matplotlib settings aside, so that everyone gets the same image.

    >>> import matplotlib as mpl
    >>> with mpl.rc_context({"font.size": 30}), our_look():
    ...     mpl.rcParams["font.size"]
    10.0
    """
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_LOOK)
        yield


def in_our_look(draw: Callable[Asked, Drawn]) -> Callable[Asked, Drawn]:
    """Make a function that draws a new figure use our style; axes given as `ax` keep theirs.

    >>> from evenbreak.plots.picture import new_axes
    >>> import matplotlib as mpl
    >>> with mpl.rc_context({"axes.labelsize": 30}):
    ...     axes = in_our_look(new_axes)("p", "W")
    >>> axes.xaxis.label.get_fontsize()
    10.0
    """

    @wraps(draw)
    def drawn(*args: Asked.args, **kwargs: Asked.kwargs) -> Drawn:
        ax = kwargs.get("ax")
        if ax is not None and (not isinstance(ax, Axes) or ax.name != "rectilinear"):
            raise InputError(
                f"ax must be plain axes, such as figure.subplots() returns; you gave {ax!r:.60}"
            )
        with our_look() if ax is None else nullcontext():
            return draw(*args, **kwargs)

    return drawn


class _Shown:
    """Base of objects that a notebook displays, whether or not pyplot has been imported."""

    def _repr_png_(self) -> bytes:
        return image_bytes(self, "png")  # type: ignore[arg-type]  # a figure or axes

    def _repr_svg_(self) -> str:
        return image_bytes(self, "svg").decode()  # type: ignore[arg-type]


class Picture(_Shown, Figure):
    """A figure with several plots, which a notebook displays."""


class Plot(_Shown, Axes):
    """The axes of a new figure with a single plot: a notebook displays the figure."""


def image_bytes(figure: Figure | Axes, kind: Literal["png", "svg"] = "svg") -> bytes:
    """Return a figure, or the figure of some axes, as the bytes of a PNG or SVG file.

    They are always the same bytes.

    Raises
    ------
    InputError
        if `kind` is neither 'svg' nor 'png'.

    >>> from evenbreak.games import OneBall
    >>> from evenbreak.plots import draw
    >>> image_bytes(draw(OneBall(0.4, 0.8)), "png")[1:4]
    b'PNG'
    """
    one_of(kind, "kind", ("svg", "png"))
    whole = figure_of(figure) if isinstance(figure, Axes) else figure
    out = io.BytesIO()
    # A salt instead of random ids, and no date or program version.
    metadata: dict[str, Any] = {"Date": None, "Creator": None} if kind == "svg" else {}
    with our_look(), mpl.rc_context({"svg.hashsalt": "evenbreak"}):
        whole.savefig(out, format=kind, dpi=150, metadata=metadata or {"Software": None})
    return small_svg(out.getvalue().decode()).encode() if kind == "svg" else out.getvalue()


def image_files(figures: Mapping[str, Figure | Axes]) -> dict[str, bytes]:
    """Return figures as files, by name: each as a PNG and as an SVG."""
    return {
        f"{name}.{kind}": image_bytes(figure, kind)
        for name, figure in figures.items()
        for kind in _KINDS
    }


_KINDS: tuple[Literal["png", "svg"], ...] = ("png", "svg")


class LineStyle(NamedTuple):
    """A line that differs from the others in color and in dashes."""

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
"""The lines of a plot, in order; the first seven colors are those of Okabe and Ito (2008)."""

_LABEL = 10
"""The font size of a curve's name, and of a title of several lines."""
_LETTERS_AN_INCH = 11.5
"""The minimum number of letters of that size that fit into an inch."""
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
    size: tuple[float, float] = (5.4, 3.8),
    counts: str = "",
    ax: Axes | None = None,
) -> Axes:
    """Return labeled axes, in a new figure (size in inches) unless `ax` is given.

    `counts`, "x", "y" or "xy", are axes for counts, with ticks only at whole numbers.

    >>> axes = new_axes("level", "probability")
    >>> axes.get_xlabel()
    'level'
    """
    axes = ax or new_plot(size)
    axes.set(xlabel=x, ylabel=y)
    axes.tick_params(direction="in", top=True, right=True)
    for name in counts:
        axis = {"x": axes.xaxis, "y": axes.yaxis}[name]
        axis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 5, 10], integer=True))
    if title:
        axes.set_title(title)
    return axes


def new_plot(size: tuple[float, float]) -> Axes:
    """Return the axes of a new figure with the given size in inches."""
    return Figure(figsize=size, layout="constrained").add_subplot(axes_class=Plot)


def legend_below(axes: Axes, ax: Axes | None) -> None:
    """Write the legend below the axes in a new figure, or inside given axes.

    >>> axes = new_axes("p", "W")
    >>> _ = axes.plot([0, 1], label="3:3")
    >>> legend_below(axes, None)
    >>> len(figure_of(axes).legends)
    1
    """
    if ax is None:
        figure_of(axes).legend(frameon=False, loc="outside lower center", ncols=2)
    else:
        ax.legend(frameon=False)


def figure_of(axes: Axes) -> Figure:
    """Return the figure that axes are in."""
    figure: Any = axes.get_figure(root=True)
    return figure  # type: ignore[no-any-return]


def write_title(figure: Figure, text: str) -> None:
    """Write a heading above all panels of a figure, in lines that fit its width.

    >>> axes = new_axes("p", "W")
    >>> write_title(figure_of(axes), "Race 7:5, score 2-3")
    >>> figure_of(axes).get_suptitle()
    'Race 7:5, score 2-3'
    """
    width = int(_LETTERS_AN_INCH * figure.get_figwidth())
    lines = [fill(line, width) for line in text.splitlines()]
    figure.suptitle("\n".join(lines), fontsize=_LABEL, parse_math=False)


def unit_axis(axes: Axes, *which: str) -> None:
    """Make the given axes, "x" or "y", run from 0 to 1, with a tick at every tenth.

    >>> axes = new_axes("p", "W")
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

    >>> axes = new_axes("p", "W")
    >>> label_on(axes, 0.5, 0.5, "3:3").get_text()
    '3:3'
    """
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.2}
    return axes.text(x, y, text, fontsize=_LABEL, ha="center", va="center", bbox=box)


def label_beside(
    axes: Axes, x: float, y: float, text: str, side: Literal["left", "right", "above", "below"]
) -> Text:
    """Write a curve's name next to the point (x, y), in the units of the axes.

    >>> axes = new_axes("p", "W")
    >>> label_beside(axes, 0.5, 0.5, "3:3", "left").get_horizontalalignment()
    'right'
    """
    offset, ha, va = _BESIDE[side]
    return note(axes, text, (x, y), offset, fontsize=_LABEL, ha=ha, va=va)


def note(
    axes: Axes, text: str, place: tuple[float, float], beside: tuple[float, float], **style: Any
) -> Text:
    """Write a label next to a position in axes units, offset by the given points of the page.

    >>> axes = new_axes("p", "W")
    >>> note(axes, "even", (0.5, 0.5), (6, 0), ha="left").get_text()
    'even'
    """
    return axes.annotate(text, place, beside, textcoords="offset points", **style)


def take_names_as_they_are(axes: Axes) -> None:
    """Show labels and legend without treating a $ in a player's name as mathematics."""
    legend = axes.get_legend()
    for text in (axes.xaxis.label, axes.yaxis.label, *(legend.get_texts() if legend else ())):
        text.set_parse_math(False)


_DECIMAL = re.compile(r"-?\d+\.\d+")
_PLACES = re.compile(r'( (?:d|x|y|points)="|translate\()([^")]*)')
_SHAPE = re.compile(r'<path id="([\w.-]+)" d="[^"]*" (style="[^"]*")')
_USE = re.compile(r'(<use href="#([\w.-]+)"[^>]*?) (style="[^"]*")')


def small_svg(svg: str) -> str:
    """Return matplotlib's SVG with coordinates to a twentieth of a point, without unused names.

    >>> small_svg('<path id="a" d="M 0.04 1.2345"/>  <!-- axis -->')
    '<path d="M 0 1.2"/>  '
    """
    svg = re.sub(r"<metadata>.*?</metadata>\n?|<!--.*?-->\n?", "", svg, flags=re.DOTALL)
    used = set(re.findall(r"#([\w.-]+)", svg))
    svg = re.sub(r' id="([\w.-]+)"', lambda name: name[0] if name[1] in used else "", svg)
    svg = _PLACES.sub(lambda place: place[1] + _DECIMAL.sub(_rounded, place[2]), svg)
    svg = svg.replace("DejaVuSans-", "f").replace("xlink:href", "href")
    # A tick looks like the shape that it uses; it need not say so again.
    style = dict(_SHAPE.findall(svg))
    svg = _USE.sub(lambda use: use[1] if style.get(use[2]) == use[3] else use[0], svg)
    return re.sub(r"\s*\n\s*", "\n", svg)


def _rounded(number: re.Match[str]) -> str:
    return f"{round(float(number[0]), 1) + 0.0:.1f}".removesuffix(".0")


def mark_points(axes: Axes, points: Iterable[tuple[float, float, str]]) -> None:
    """Mark points in the unit square with dots, each with its name on the side that has room.

    Points in the same place share a dot and a label. A point whose name is "" has no label.

    >>> from evenbreak.plots.picture import new_axes
    >>> axes = new_axes("p1", "p2")
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
