"""Match formats in one picture: the chance of winning against p, and where the curves cross."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes

from evenbreak.games.rack import Rack
from evenbreak.matches.crossings import Crossings, rack_along
from evenbreak.matches.formats import MatchFormat
from evenbreak.matches.win import win_probability
from evenbreak.plots.picture import (
    LINES,
    Picture,
    in_our_look,
    new_axes,
    take_names_as_they_are,
    unit_axis,
    write_title,
)

_POINTS = 401


@overload
def plot_formats(
    formats: Sequence[MatchFormat],
    line: Mapping[str, Any],
    pairs: Iterable[Crossings],
    *,
    p1: float,
    title: str = "",
    names: tuple[str, str] = ("A", "B"),
    ax: Axes,
) -> Axes: ...
@overload
def plot_formats(
    formats: Sequence[MatchFormat],
    line: Mapping[str, Any],
    pairs: Iterable[Crossings],
    *,
    p1: float,
    title: str = "",
    names: tuple[str, str] = ("A", "B"),
) -> Picture: ...
@in_our_look
def plot_formats(
    formats: Sequence[MatchFormat],
    line: Mapping[str, Any],
    pairs: Iterable[Crossings],
    *,
    p1: float,
    title: str = "",
    names: tuple[str, str] = ("A", "B"),
    ax: Axes | None = None,
) -> Picture | Axes:
    """Return a figure of player 1's chance in a match against that in a game, a curve per format.

    Parameters
    ----------
    formats
        the matches, seven at most.
    line
        what stays fixed as p1 varies, as options of `evenbreak.matches.crossings`.
    pairs
        the crossings, each marked by a dot.
    p1
        that chance for the two players in question, a vertical line.
    title
        who plays, above the picture.
    names
        of player 1 and player 2.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> from evenbreak.matches import crossings, match_format
    >>> two = [match_format("2:1"), match_format("4:2")]
    >>> figure = plot_formats(two, {}, [crossings(*two)], p1=0.6)
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['2:1', '4:2', 'worth the same', 'A against B']
    """
    fixed = {name: line.get(name) for name in ("p2", "break_odds")}
    matters = any(value is not None for value in fixed.values())
    a, b = names
    x = f"p1 = P({a} wins a game | {a} breaks)" if matters else f"p = P({a} wins a game)"
    figure, axes = new_axes(x, f"P({a} wins the match)", size=(6.4, 5.6), ax=ax)
    chances = np.linspace(0.0, 1.0, _POINTS)[1:-1]
    rack: Rack = rack_along(chances, **fixed)
    axes.axhline(0.5, color="0.7", linewidth=0.8)
    for played, style in zip(formats, LINES, strict=False):
        match = played.match(
            rack, breaks=line.get("breaks"), first_breaker=line.get("first_breaker", 1)
        )
        axes.plot(
            chances,
            win_probability(match),
            label=str(played),
            **style._asdict(),
        )
    points = [point for found in pairs for point in found.points]
    if points:
        axes.plot(
            [point.p1 for point in points],
            [point.p_win_1 for point in points],
            "o",
            color="black",
            mfc="white",
            ms=6,
            zorder=4,
            clip_on=False,
            label="worth the same",
        )
    axes.axvline(p1, color="0.5", linewidth=1.0, zorder=0, label=f"{a} against {b}")
    unit_axis(axes, "x", "y")
    if title and ax is None:
        write_title(figure, title)
    elif title:
        axes.set_title(title)
    axes.legend(frameon=False, loc="best")
    take_names_as_they_are(axes)
    return figure if ax is None else ax
