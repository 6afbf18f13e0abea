"""Plots of practice: scores over time, runs with their mean, median and mode, and drills."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from evenbreak.files.practice import ScoresFile, ShotsFile
from evenbreak.matches.straight_pool import StraightPool, even_spot, straight_pool_odds
from evenbreak.plots.picture import LINES, figure_of, in_our_look, legend_below, new_axes
from evenbreak.practice.drills import DrillStatistics
from evenbreak.practice.log_analysis import LogAnalysis
from evenbreak.practice.single_shots import ShotAnalysis, share_intervals
from evenbreak.stats.confidence import MeanInterval
from evenbreak.stats.innings import InningsScore
from evenbreak.stats.runs import RunLength
from evenbreak.stats.trend import TrendLine

BAND = "0.85"
STEP = 0.08
"""The distance between equal scores, where the lists are 1 apart."""

WIDEST = 0.3
"""The largest distance between a score and the middle of its list."""


@in_our_look
def draw_scores(
    file: ScoresFile,
    interval: MeanInterval | None,
    line: TrendLine | None = None,
    *,
    new: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a file's scores by date or order, with their mean and trend and its uncertainty.

    `new` is one more score, drawn after the others.
    """
    axes = new_axes(
        "score number" if file.dates is None else "date",
        "score",
        title=f"Practice scores: {Path(file.source).name}",
        counts="" if file.dates is not None else "x",
        ax=ax,
    )
    if file.dates is None:
        when: NDArray[np.float64] | NDArray[np.datetime64] = np.arange(1.0, len(file.scores) + 1)
        later: float | np.datetime64 = len(file.scores) + 1.0
    else:
        when = file.dates
        # After the last score by the usual distance between scores, or a day.
        apart = (when.max() - when.min()) // max(1, len(when) - 1)
        later = when.max() + max(apart, np.timedelta64(1, "D"))
        if ax is None:
            figure_of(axes).autofmt_xdate()
    mean = float(file.scores.mean())
    if interval is not None:
        share = f"{100 * interval.confidence:g}% interval for the true mean"
        axes.axhspan(interval.low, interval.high, color=BAND, linewidth=0, label=share, zorder=0)
    axes.plot(when, file.scores, "o", color=LINES[0].color, label="scores")
    axes.axhline(mean, **LINES[1]._asdict(), label=f"mean {mean:.2f}", zorder=1)
    if line is not None:
        _draw_trend(axes, when, line)
    if new is not None:
        label = f"new score {new:g}"
        axes.plot(np.array([later]), [new], "D", color=LINES[2].color, markersize=8, label=label)
    legend_below(axes, ax)
    return axes


@in_our_look
def draw_practice_shots(
    file: ShotsFile, found: ShotAnalysis, *, confidence: float = 0.95, ax: Axes | None = None
) -> Axes:
    """Draw the share of single shots made on each day, and in the earlier and the later half.

    Without dates, shots replace days.
    """
    log, title = file.log, f"Practice shots: {Path(file.source).name}"
    axes = new_axes("shot" if log.day is None else "date", "share made", title=title, ax=ax)
    share = f"{100 * confidence:g}% interval"
    if log.day is None:
        at = np.arange(len(found.shots))
        lows, shares, highs = (
            np.array([getattr(one, name) for one in found.shots])
            for name in ("low", "chance", "high")
        )
        axes.vlines(at, lows, highs, color="0.6", label=share)
        axes.plot(at, shares, "o", color=LINES[0].color, label="chance")
        axes.set_xticks(at, [one.name for one in found.shots], rotation=30, ha="right")
    else:
        days, place = np.unique(log.day, return_inverse=True)
        made, tried = (np.bincount(place, each) for each in (log.made, log.tried))
        lows, highs = share_intervals(made, tried, confidence)
        axes.vlines(days, lows, highs, color="0.7", label=f"{share} for that day")
        axes.plot(days, made / tried, "o", color=LINES[0].color, label="share made that day")
        if found.change is not None:
            last = np.array([days[days < found.since].max(), days.max()])
            ends = zip((days.min(), found.since), last, strict=True)
            halves = (found.change.before, found.change.after)
            for (begin, end), level, line in zip(ends, halves, LINES[1:], strict=False):
                name = "since" if begin == found.since else "before"
                label = f"{name} {found.since}: {100 * level:.0f}%"
                axes.plot([begin, end], [level, level], **line._asdict(), label=label)
        if ax is None:
            figure_of(axes).autofmt_xdate()
    axes.set_ylim(-0.02, 1.02)
    legend_below(axes, ax)
    return axes


def _draw_trend(axes: Axes, when: NDArray[Any], line: TrendLine) -> None:
    """Draw a trend line, and the band that contains the true line."""
    order = np.argsort(when, kind="stable")
    dates, (at, low, high) = when[order], (column[order] for column in line)
    style = LINES[2]
    axes.fill_between(
        dates, low, high, color=style.color, alpha=0.15, linewidth=0, label="interval for the trend"
    )
    axes.plot(dates, at, **style._asdict(), label="trend")


@in_our_look
def draw_two_lists(
    before: NDArray[np.float64],
    after: NDArray[np.float64],
    names: tuple[str, str],
    intervals: tuple[MeanInterval | None, MeanInterval | None],
    *,
    ax: Axes | None = None,
) -> Axes:
    r"""Draw two lists of scores side by side, each with its mean and interval.

    The plot is drawn on the axes `ax`, or else in a new figure.

    >>> import numpy as np
    >>> axes = draw_two_lists(
    ...     np.array([50.0, 44.0]), np.array([53.0]), ("before", "after"), (None, None)
    ... )
    >>> [text.get_text() for text in axes.get_xticklabels()]
    ['before\n2 scores', 'after\n1 score']
    """
    shares = {f"{100 * interval.confidence:g}" for interval in intervals if interval is not None}
    with_interval = f" and {shares.pop()}% intervals" if shares else ""
    axes = new_axes("", "score", title=f"Practice scores, with their means{with_interval}", ax=ax)
    for place, (scores, interval) in enumerate(zip((before, after), intervals, strict=True)):
        _strip(axes, place, scores, interval)
    labels = [
        f"{name}\n{len(scores)} score{'s' if len(scores) > 1 else ''}"
        for name, scores in zip(names, (before, after), strict=True)
    ]
    axes.set_xticks([0, 1], labels)
    axes.set_xlim(-0.5, 1.75)
    return axes


def _strip(
    axes: Axes, place: int, scores: NDArray[np.float64], interval: MeanInterval | None
) -> None:
    """Draw one list, with equal scores side by side and the mean to their right."""
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


_SHOWN = (0.001, 0.995)
"""The quantiles between which scores are drawn."""

_COLORS = ("#CC79A7", "#009E73", "#E69F00")
_HATCHES = ("////", "\\\\\\\\", "....")
"""The shading of the requested spans of scores."""

_POINTS = 150
"""The most points used to draw a curve."""


@in_our_look
def draw_score(
    law: RunLength | InningsScore,
    innings: int = 1,
    *,
    asked: Sequence[tuple[str, int, int | None]] = (),
    ax: Axes | None = None,
) -> Axes:
    """Draw the probability of each score, with its mean, median and mode.

    `asked` spans, which are shaded, have a name, the smallest number of balls, and the largest or
    None.
    """
    low, high = (law.quantile(q) for q in _SHOWN)
    scores = np.arange(low, high + 1)
    chances = law.probability(scores)
    played = "an inning" if innings == 1 else f"{innings} innings"
    axes = new_axes(f"balls made in {played}", "probability", counts="x", ax=ax)
    axes.fill_between(scores, chances, step="mid", color="0.85", linewidth=0)
    axes.step(scores, chances, where="mid", color="0.45", linewidth=1.0)
    for color, hatch, (name, least, most) in zip(_COLORS, _HATCHES, asked, strict=False):
        inside = (scores >= least) & (scores <= (high if most is None else most))
        p = float(law.at_least(least) if most is None else law.between(least, most))
        sides = np.add.outer(scores[inside], [-0.5, 0.5]).ravel()
        axes.fill_between(
            sides,
            np.repeat(chances[inside], 2),
            facecolor="none",
            edgecolor=color,
            hatch=hatch,
            linewidth=0.0,
            label=f"{name}: {100 * p:.1f}%",
        )
    for line, (name, at) in zip(LINES, law.fair_line._asdict().items(), strict=False):
        axes.axvline(at, **line._asdict(), linewidth=1.6, label=f"{name} {at:.4g}")
    axes.set_ylim(0.0)
    axes.margins(x=0.02)
    axes.legend(frameon=False)
    return axes


@in_our_look
def draw_spot(match: StraightPool, *, ax: Axes | None = None) -> Axes:
    """Draw A's chance in straight pool against the weaker player's points; A is player 1.

    The current match is a dot on the curve. If any number of points makes it even (see
    `even_spot`), a dashed line marks the one closest to even.
    """
    weaker, even, _ = even_spot(match)
    name = f"points_{weaker}"
    now = getattr(match, name)
    most = max(now, min(2 * (even or now), match.points_1 + match.points_2 - now))
    points = np.unique(np.linspace(1, most, _POINTS).round().astype(int)).tolist()
    wins = [straight_pool_odds(replace(match, **{name: n})).p_win_1 for n in points]
    shots = f"A makes {100 * float(match.p1):.4g}% of shots, B {100 * float(match.p2):.4g}%"
    axes = new_axes(
        f"points {' AB'[weaker]} needs",
        "chance that A wins the match",
        title=shots,
        counts="x",
        ax=ax,
    )
    curve, half = LINES[:2]
    axes.plot(points, wins, **curve._asdict())
    axes.plot(
        [now],
        [straight_pool_odds(match).p_win_1],
        "o",
        color=curve.color,
        label=f"{match.points_1} points to {match.points_2}",
    )
    axes.axhline(0.5, color="0.7", linewidth=0.8)
    if even is not None:
        name = f"closest to even: {even}"
        axes.axvline(even, **half._asdict(), label=name)
    axes.set_ylim(-0.02, 1.02)
    axes.margins(x=0.02)
    axes.legend(frameon=False)
    return axes


_LEVEL = "level"
_FRACTION = "share of attempts"
_TICKS = 20
"""Number of levels up to which each has its own tick."""


@in_our_look
def draw_drill(statistics: DrillStatistics, *, ax: Axes | None = None) -> Axes:
    """Draw the fraction of attempts at each level of a drill in the long run.

    Source: Table 5.5.
    """
    law = statistics.distribution
    axes = new_axes(
        _LEVEL, _FRACTION, counts="x", title="Where the drill settles in the long run", ax=ax
    )
    levels = np.arange(1, len(law.values) + 1)
    axes.bar(levels, [float(p) for p in law.probability], 0.8, color="0.75", edgecolor="black")
    _mark_mean(axes, law.mean, f"mean {law.mean:.2f}", "0.75")
    _finish(axes, levels.tolist())
    return axes


@in_our_look
def draw_log(analysis: LogAnalysis, *, ax: Axes | None = None) -> Axes:
    """Draw a log's levels next to their long-run distribution with its success rates.

    Source: exercise 5.1.
    """
    axes = new_axes(
        _LEVEL, _FRACTION, counts="x", title="Your drill so far and in the long run", ax=ax
    )
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
    _finish(axes, levels.tolist(), room=0.46)
    return axes


def _mark_mean(axes: Axes, mean: float, label: str, color: str, *, above: float = 0.06) -> float:
    """Draw a triangle above the highest bar, in the bars' color."""
    height = (1.0 + above) * max(
        bar.get_height() for bar in axes.patches if isinstance(bar, Rectangle)
    )
    axes.plot(
        [mean], [height], "v", ms=9, label=label, markerfacecolor=color, markeredgecolor="black"
    )
    return height


def _finish(axes: Axes, levels: Sequence[int], *, room: float = 0.24) -> None:
    if len(levels) <= _TICKS:
        axes.set_xticks(levels)
    axes.set_xlim(0.4, len(levels) + 0.6)
    # Leave room above the bars for the legend.
    axes.set_ylim(0.0, (1.0 + room) * axes.get_ylim()[1])
    axes.legend(loc="upper right", frameon=False, ncols=2)
