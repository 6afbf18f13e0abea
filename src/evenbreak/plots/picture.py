"""Figures as pictures: the same bytes for everybody, and what a notebook shows."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from functools import wraps
from typing import Any, Literal, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from evenbreak.checks import one_of
from evenbreak.errors import InputError
from evenbreak.plots.small_svg import small_svg

Asked = ParamSpec("Asked")
Drawn = TypeVar("Drawn")


@contextmanager
def our_look() -> Iterator[None]:
    """Set the reader's own matplotlib settings aside, so that everybody gets the same picture.

    >>> import matplotlib as mpl
    >>> with mpl.rc_context({"font.size": 30}), our_look():
    ...     mpl.rcParams["font.size"]
    10.0
    """
    with mpl.rc_context():
        mpl.rcdefaults()
        yield


def in_our_look(draw: Callable[Asked, Drawn]) -> Callable[Asked, Drawn]:
    """Let a function that draws a new figure do so in our look; axes given as `ax` keep theirs.

    >>> from evenbreak.plots.style import new_axes
    >>> import matplotlib as mpl
    >>> with mpl.rc_context({"axes.labelsize": 30}):
    ...     figure, axes = in_our_look(new_axes)("p", "W")
    >>> axes.xaxis.label.get_fontsize()
    10.0
    """

    @wraps(draw)
    def drawn(*args: Asked.args, **kwargs: Asked.kwargs) -> Drawn:
        ax = kwargs.get("ax")
        if ax is not None and (not isinstance(ax, Axes) or ax.name != "rectilinear"):
            raise InputError(
                f"ax is {ax!r:.60}; give plain axes, such as one of those of figure.subplots()"
            )
        with our_look() if ax is None else nullcontext():
            return draw(*args, **kwargs)

    return drawn


class Picture(Figure):
    """A figure that a notebook shows by itself, whether or not pyplot has been imported."""

    def _repr_png_(self) -> bytes:
        return image_bytes(self, "png")

    def _repr_svg_(self) -> str:
        return image_bytes(self, "svg").decode()


def image_bytes(figure: Figure | Axes, kind: Literal["png", "svg"] = "svg") -> bytes:
    """Return a figure, or the one that some axes are in, as the bytes of a PNG or SVG file.

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
    whole: Any = figure.get_figure(root=True) if isinstance(figure, Axes) else figure
    out = io.BytesIO()
    # A salt instead of random ids, and no date or program version.
    metadata: dict[str, Any] = {"Date": None, "Creator": None} if kind == "svg" else {}
    with our_look(), mpl.rc_context({"svg.hashsalt": "evenbreak"}):
        whole.savefig(out, format=kind, dpi=150, metadata=metadata or {"Software": None})
    return small_svg(out.getvalue().decode()).encode() if kind == "svg" else out.getvalue()
