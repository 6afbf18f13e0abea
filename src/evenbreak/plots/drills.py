"""Plots of a drill: the attempts at each level, in the long run and in a log."""

from collections.abc import Sequence
from typing import overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from evenbreak.plots.picture import Picture, in_our_look, new_axes
from evenbreak.practice.drills import DrillStatistics
from evenbreak.practice.log_analysis import LogAnalysis

_LEVEL = "level"
_FRACTION = "fraction of the attempts"
_TICKS = 20
"""Up to this many levels, each one has its own tick."""


@overload
def drill_figure(statistics: DrillStatistics, *, ax: Axes) -> Axes: ...
@overload
def drill_figure(statistics: DrillStatistics) -> Picture: ...
@in_our_look
def drill_figure(statistics: DrillStatistics, *, ax: Axes | None = None) -> Picture | Axes:
    """Draw the fraction of attempts at each level of a drill in the long run.

    It is drawn on the axes `ax`, which are returned, or else in a new figure, which is.

    Notes
    -----
    Source: Table 5.5.

    >>> from evenbreak.games import Drill
    >>> from evenbreak.practice import drill_statistics
    >>> figure = drill_figure(drill_statistics(Drill.progressive(0.8)))
    >>> len(figure.axes[0].patches)
    9
    """
    law = statistics.distribution
    figure, axes = new_axes(_LEVEL, _FRACTION, title="Where the drill settles", ax=ax)
    levels = np.arange(1, len(law.values) + 1)
    axes.bar(levels, [float(p) for p in law.probability], 0.8, color="0.75", edgecolor="black")
    _mark_mean(axes, law.mean, f"mean {law.mean:.2f}", "0.75")
    _finish(axes, levels.tolist())
    return figure if ax is None else ax


@overload
def log_figure(analysis: LogAnalysis, *, ax: Axes) -> Axes: ...
@overload
def log_figure(analysis: LogAnalysis) -> Picture: ...
@in_our_look
def log_figure(analysis: LogAnalysis, *, ax: Axes | None = None) -> Picture | Axes:
    """Draw the levels of a log beside those of the long run with its success rates.

    It is drawn on the axes `ax`, which are returned, or else in a new figure, which is.

    Notes
    -----
    Source: exercise 5.1.
    """
    figure, axes = new_axes(_LEVEL, _FRACTION, title="Your drill so far and in the long run", ax=ax)
    levels = np.array([report.level for report in analysis.levels])
    visited, implied = (
        [getattr(report, name) for report in analysis.levels] for name in ("visited", "implied")
    )
    axes.bar(levels - 0.2, visited, 0.4, color="0.35", edgecolor="black", label="so far")
    axes.bar(
        levels + 0.2,
        implied,
        0.4,
        color="white",
        edgecolor="black",
        hatch="////",
        label="long run",
    )
    _mark_mean(axes, analysis.visited.mean, f"mean so far {analysis.visited.mean:.2f}", "0.35")
    mean, low, high = analysis.implied.mean, analysis.mean_low, analysis.mean_high
    height = _mark_mean(axes, mean, f"mean in the long run {mean:.2f}", "white", above=0.13)
    axes.plot(
        [low, high],
        [height, height],
        "|-",
        color="black",
        ms=9,
        zorder=1,
        label="its 95% interval",
    )
    _finish(axes, levels.tolist())
    return figure if ax is None else ax


def _mark_mean(axes: Axes, mean: float, label: str, color: str, *, above: float = 0.06) -> float:
    """Draw a triangle above the highest bar, in the colour of the bars it belongs to."""
    height = (1.0 + above) * max(
        bar.get_height() for bar in axes.patches if isinstance(bar, Rectangle)
    )
    axes.plot(
        [mean], [height], "v", ms=9, label=label, markerfacecolor=color, markeredgecolor="black"
    )
    return height


def _finish(axes: Axes, levels: Sequence[int]) -> None:
    if len(levels) <= _TICKS:
        axes.set_xticks(levels)
    axes.set_xlim(0.4, len(levels) + 0.6)
    # Leave room above the bars for the legend.
    axes.set_ylim(0.0, 1.24 * axes.get_ylim()[1])
    axes.legend(loc="upper right", frameon=False, ncols=2)
