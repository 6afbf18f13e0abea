"""Plots of practice scores: one list over time, or two side by side."""

from collections import Counter
from pathlib import Path
from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from evenbreak.files.practice import ScoresFile
from evenbreak.plots.picture import LINES, Picture, in_our_look, legend_below, new_axes
from evenbreak.stats.confidence import MeanInterval
from evenbreak.stats.trend import TrendLine

BAND = "0.85"
STEP = 0.08
"""The distance between equal scores, where the lists are 1 apart."""

WIDEST = 0.3
"""The largest distance of a score from the middle of its list."""


@overload
def plot_scores(
    file: ScoresFile,
    interval: MeanInterval | None,
    line: TrendLine | None = None,
    *,
    new: float | None = None,
    ax: Axes,
) -> Axes: ...
@overload
def plot_scores(
    file: ScoresFile,
    interval: MeanInterval | None,
    line: TrendLine | None = None,
    *,
    new: float | None = None,
) -> Picture: ...
@in_our_look
def plot_scores(
    file: ScoresFile,
    interval: MeanInterval | None,
    line: TrendLine | None = None,
    *,
    new: float | None = None,
    ax: Axes | None = None,
) -> Picture | Axes:
    """Return a figure of the scores of a file, their mean and trend, and how sure these are.

    Parameters
    ----------
    file
        the scores, drawn over their dates, or in the order of the file if it has no dates.
    interval
        of the true mean; None draws no band.
    line
        of the trend on the date of each score; None draws none.
    new
        one more score, drawn after the others.
    ax
        the axes to draw on, which are returned; None: those of a new figure, which is.

    >>> import numpy as np
    >>> from evenbreak.files.practice import ScoresFile
    >>> figure = plot_scores(ScoresFile(np.array([50.0, 44.0]), None, "scores.csv", ()), None)
    >>> [text.get_text() for text in figure.legends[0].get_texts()]
    ['scores', 'mean 47.00']
    """
    figure, axes = new_axes(
        "number of the score" if file.dates is None else "date",
        "score",
        title=f"Practice scores of {Path(file.source).name}",
        ax=ax,
    )
    if file.dates is None:
        when: NDArray[np.float64] | NDArray[np.datetime64] = np.arange(1.0, len(file.scores) + 1)
        later: float | np.datetime64 = len(file.scores) + 1.0
        axes.locator_params(axis="x", integer=True)
    else:
        when = file.dates
        # After the last score by the usual distance between scores, or a day.
        apart = (when.max() - when.min()) // max(1, len(when) - 1)
        later = when.max() + max(apart, np.timedelta64(1, "D"))
        if ax is None:
            figure.autofmt_xdate()
    mean = float(file.scores.mean())
    if interval is not None:
        share = f"{100 * interval.confidence:g}% interval of the true mean"
        axes.axhspan(interval.low, interval.high, color=BAND, linewidth=0, label=share, zorder=0)
    axes.plot(when, file.scores, "o", color=LINES[0].color, label="scores")
    axes.axhline(mean, **LINES[1]._asdict(), label=f"mean {mean:.2f}", zorder=1)
    if line is not None:
        _draw_trend(axes, when, line)
    if new is not None:
        label = f"new score {new:g}"
        axes.plot(np.array([later]), [new], "D", color=LINES[2].color, markersize=8, label=label)
    legend_below(figure, ax)
    return figure if ax is None else ax


def _draw_trend(axes: Axes, when: NDArray[Any], line: TrendLine) -> None:
    """Draw the line of a trend, and the band in which the true one lies."""
    order = np.argsort(when, kind="stable")
    dates, (at, low, high) = when[order], (column[order] for column in line)
    style = LINES[2]
    axes.fill_between(
        dates, low, high, color=style.color, alpha=0.15, linewidth=0, label="interval of the trend"
    )
    axes.plot(dates, at, **style._asdict(), label="trend")


@overload
def plot_two_lists(
    before: NDArray[np.float64],
    after: NDArray[np.float64],
    names: tuple[str, str],
    intervals: tuple[MeanInterval | None, MeanInterval | None],
    *,
    ax: Axes,
) -> Axes: ...
@overload
def plot_two_lists(
    before: NDArray[np.float64],
    after: NDArray[np.float64],
    names: tuple[str, str],
    intervals: tuple[MeanInterval | None, MeanInterval | None],
) -> Picture: ...
@in_our_look
def plot_two_lists(
    before: NDArray[np.float64],
    after: NDArray[np.float64],
    names: tuple[str, str],
    intervals: tuple[MeanInterval | None, MeanInterval | None],
    *,
    ax: Axes | None = None,
) -> Picture | Axes:
    r"""Return a figure of two lists of scores side by side, each with its mean and interval.

    It is drawn on the axes `ax`, which are returned, or else in a new figure, which is.

    >>> import numpy as np
    >>> figure = plot_two_lists(
    ...     np.array([50.0, 44.0]), np.array([53.0]), ("before", "after"), (None, None)
    ... )
    >>> [text.get_text() for text in figure.axes[0].get_xticklabels()]
    ['before\n2 scores', 'after\n1 score']
    """
    shares = {f"{100 * interval.confidence:g}" for interval in intervals if interval is not None}
    with_interval = f" with its {shares.pop()}% interval" if shares else ""
    figure, axes = new_axes(
        "", "score", title=f"Practice scores, and their mean{with_interval}", ax=ax
    )
    for place, (scores, interval) in enumerate(zip((before, after), intervals, strict=True)):
        _strip(axes, place, scores, interval)
    labels = [
        f"{name}\n{len(scores)} score{'s' if len(scores) > 1 else ''}"
        for name, scores in zip(names, (before, after), strict=True)
    ]
    axes.set_xticks([0, 1], labels)
    axes.set_xlim(-0.5, 1.75)
    return figure if ax is None else ax


def _strip(
    axes: Axes, place: int, scores: NDArray[np.float64], interval: MeanInterval | None
) -> None:
    """Draw one list, with equal scores beside one another and the mean to their right."""
    line = LINES[place]
    values = scores.tolist()
    counts, seen = Counter(values), Counter[float]()
    step = min(STEP, 2 * WIDEST / max(counts.values()))
    across = []
    for value in values:
        across.append(place + step * (seen[value] - (counts[value] - 1) / 2))
        seen[value] += 1
    axes.plot(across, scores, "os"[place], color=line.color, alpha=0.75)
    mean = float(np.mean(scores))
    beside = place + WIDEST + 0.1
    if interval is not None:
        away = [[mean - interval.low], [interval.high - mean]]
        axes.errorbar([beside], [mean], yerr=away, color=line.color, capsize=5)
    axes.plot([beside], [mean], "D", color=line.color, markersize=8)
    axes.annotate(f"{mean:.2f}", (beside, mean), (9, -3), textcoords="offset points")
