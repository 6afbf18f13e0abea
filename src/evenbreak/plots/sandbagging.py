"""Pictures of sandbagging: what it pays, and the evidence for it."""

import math
from collections.abc import Sequence
from typing import overload

from matplotlib.axes import Axes

from evenbreak.league.sandbag_pay import Sandbagging
from evenbreak.league.sandbag_watch import Watched
from evenbreak.plots.picture import LINES, Picture, in_our_look, new_axes

MOST_NAMED = 6
"""How many players of a league are named; the others are thin lines."""


@overload
def pay_figure(pays: Sandbagging, *, ax: Axes) -> Axes: ...
@overload
def pay_figure(pays: Sandbagging) -> Picture: ...
@in_our_look
def pay_figure(pays: Sandbagging, *, ax: Axes | None = None) -> Picture | Axes:
    """Draw the chance to win each match in earnest, for several numbers of dumped matches.

    Parameters
    ----------
    pays
        what `sandbagging` returned.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> from evenbreak.handicaps import Ladder
    >>> from evenbreak.league import sandbagging
    >>> figure = pay_figure(sandbagging(Ladder("npl"), dumped=8))
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['honest', '2 dumped', '4 dumped', '6 dumped', '8 dumped']
    """
    figure, axes = new_axes(
        "match in earnest",
        "chance to win it",
        title="What dumped matches bring",
        ax=ax,
    )
    most, many = len(pays.rows) - 1, pays.p_win.shape[1]
    shown = sorted({round(most * part / 4) for part in range(5)})
    matches = range(1, many + 1)
    for dumped, line in zip(shown, LINES, strict=False):
        label = f"{dumped} dumped" if dumped else "honest"
        axes.plot(matches, pays.p_win[dumped], **line._asdict(), label=label)
    axes.set_xlim(1, max(many, 2))
    axes.locator_params(axis="x", integer=True)
    # Room above the lines for their names.
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.25 * (high - low))
    axes.legend(loc="upper center", fontsize=9, ncols=3)
    return figure if ax is None else ax


@overload
def watch_figure(watched: Sequence[Watched], *, alpha: float, ax: Axes) -> Axes: ...
@overload
def watch_figure(watched: Sequence[Watched], *, alpha: float) -> Picture: ...
@in_our_look
def watch_figure(
    watched: Sequence[Watched], *, alpha: float, ax: Axes | None = None
) -> Picture | Axes:
    """Draw the evidence against each player, match by match, on a logarithmic axis.

    Parameters
    ----------
    watched
        what `watch` returned.
    alpha
        the alarm is at 1 / alpha.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> import numpy as np
    >>> from evenbreak.league import Watched
    >>> rows, e = np.arange(3), np.log([1.0, 8.0, 200.0])
    >>> figure = watch_figure([Watched("Ann", rows, rows > 0, e, e, "any", 0.01)], alpha=0.01)
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['alarm', 'Ann']
    """
    figure, axes = new_axes(
        "match of the player",
        "evidence",
        title="Evidence for sandbagging",
        size=(7.4, 4.2),
        ax=ax,
    )
    named = sorted(watched, key=lambda one: -float(one.log_e.max()))[:MOST_NAMED]
    axes.axhline(1.0 / alpha, color="#555555", linewidth=0.8, linestyle=":", label="alarm")
    for one in watched:
        if one not in named:
            axes.plot(*_curve(one), color="#bbbbbb", linewidth=0.6)
    for one, line in zip(named, LINES, strict=False):
        axes.plot(*_curve(one), **line._asdict(), label=one.player)
    axes.set_yscale("log")
    axes.set_xlim(left=0)
    axes.locator_params(axis="x", integer=True)
    legend = axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=9)
    for text in legend.get_texts():
        text.set_parse_math(False)
    return figure if ax is None else ax


def _curve(one: Watched) -> tuple[range, list[float]]:
    values = [1.0, *(math.exp(min(max(value, -300.0), 300.0)) for value in one.log_e)]
    return range(len(values)), values
