"""Match formats in one picture: the chance of winning against p, and where the curves cross."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.games.rack import Rack
from evenbreak.matches.crossings import rack_along
from evenbreak.matches.win import win_probability
from evenbreak.plots.style import LINES, new_axes, unit_axis

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from evenbreak.matches.crossings import Crossings
    from evenbreak.matches.formats import MatchFormat

_POINTS = 401


def plot_formats(
    formats: Sequence[MatchFormat],
    line: Mapping[str, Any],
    pairs: Iterable[Crossings],
    *,
    p1: float,
) -> Figure:
    """Return a figure of P(A wins the match) against A's chance in a game, a curve per format.

    Parameters
    ----------
    formats
        the matches, seven at most.
    line
        what stays fixed as p1 varies, as options of `evenbreak.matches.crossings`.
    pairs
        the crossings, each marked by a dot.
    p1
        A's chance for the two players in question, a vertical line.

    >>> from evenbreak.matches import crossings, match_format
    >>> two = [match_format("2:1"), match_format("4:2")]
    >>> figure = plot_formats(two, {}, [crossings(*two)], p1=0.6)
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['2:1', '4:2', 'worth the same']
    """
    fixed = {name: line.get(name) for name in ("p2", "break_odds")}
    matters = any(value is not None for value in fixed.values())
    x = "p1 = P(A wins a game | A breaks)" if matters else "p = P(A wins a game)"
    figure, axes = new_axes(x, "P(A wins the match)", size=(6.4, 5.2))
    chances = np.linspace(0.0, 1.0, _POINTS)[1:-1]
    rack: Rack = rack_along(chances, **fixed)
    axes.axhline(0.5, color="0.7", linewidth=0.8)
    axes.axvline(p1, color="0.7", linewidth=0.8)
    for played, style in zip(formats, LINES, strict=False):
        match = played.match(
            rack, breaks=line.get("breaks"), first_breaker=line.get("first_breaker", 1)
        )
        axes.plot(
            chances,
            win_probability(match),
            color=style.color,
            linestyle=style.linestyle,
            label=str(played),
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
    unit_axis(axes, "x", "y")
    axes.legend(frameon=False, loc="best")
    return figure
