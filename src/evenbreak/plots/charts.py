"""The plot of an audit: the stronger player's chance by rating difference."""

import numpy as np
from matplotlib.axes import Axes

from evenbreak.handicaps.charts.audit import AuditRow, ChartAudit
from evenbreak.matches.win import race_win_probability
from evenbreak.plots.picture import LINES, in_our_look, new_axes

_STEPS = 25  # of the curve over one band
_NARROW = 0.05
"""A race is written vertically if its band takes up less than this share of the width."""


@in_our_look
def draw_chart(
    report: ChartAudit, beside: ChartAudit | None = None, *, ax: Axes | None = None
) -> Axes:
    """Draw the stronger player's chance by rating difference, race by race.

    The curve rises within each band and drops where the next race starts; it has a gap where no row
    gives a race. The last race is drawn for as many points as the widest band before it. A second
    chart, `beside`, is converted to the first chart's points if it is on another scale.
    """
    points = report.scale.points_per_doubling
    axes = new_axes(
        f"rating difference ({points:.4g} points double the odds)",
        "stronger player's chance of winning",
        size=(6.4, 4.2),
        ax=ax,
    )
    axes.axhline(0.5, color="0.5", lw=0.8)
    if beside is not None:
        _draw(axes, beside, points / beside.scale.points_per_doubling, 1)
    _draw(axes, report, 1.0, 0)
    axes.set_xlim(left=0.0)
    axes.margins(x=0.0, y=0.08)
    upright = _name_races(axes, report)
    title = (
        report.name
        if beside is None
        else f"{report.name} (races above) compared with {beside.name}"
    )
    axes.set_title(title, pad=36 if upright else 18, parse_math=False)
    if beside is not None:
        handles, names = axes.get_legend_handles_labels()
        axes.legend(handles[::-1], names[::-1], loc="best")
    return axes


def _draw(axes: Axes, report: ChartAudit, factor: float, line: int) -> None:
    """Draw one chart's saw-tooth curve, its points multiplied by `factor`."""
    differences, wins = [], []
    before = None
    for row in report.rows:
        first, last = _ends(report, row)
        if before is not None and before != first:
            differences.append(np.array([np.nan]))
            wins.append(np.array([np.nan]))
        inside = np.linspace(first, last, _STEPS)
        differences.append(factor * inside)
        p = report.scale.win_probability(inside)
        wins.append(race_win_probability(p, row.stronger_needs, row.weaker_needs))
        before = last
    style = LINES[line]._asdict()
    axes.plot(np.concatenate(differences), np.concatenate(wins), label=_label(report.name), **style)


def _label(name: str) -> str:
    """Return a name that matplotlib does not treat as a formula or a hidden label."""
    return "chart " + name.replace("$", r"\$")


def _ends(report: ChartAudit, row: AuditRow) -> tuple[float, float]:
    """Return where a row's tooth starts and ends: halfway to the next whole points outside it."""
    first = row.difference_from - 0.5 if row.difference_from else 0.0
    if row.difference_to is not None:
        return first, row.difference_to + 0.5
    widest = max(
        (
            wider.difference_to - wider.difference_from + 1
            for wider in report.rows
            if wider.difference_to is not None
        ),
        default=report.scale.points_per_doubling,
    )
    return first, first + widest


def _name_races(axes: Axes, report: ChartAudit) -> bool:
    """Write each of a chart's races above its tooth; return whether vertically, to save room."""
    ends = [_ends(report, row) for row in report.rows]
    upright = min(last - first for first, last in ends) < _NARROW * max(last for _, last in ends)
    for (first, last), row in zip(ends, report.rows, strict=True):
        axes.text(
            (first + last) / 2.0,
            1.015,
            f"{row.stronger_needs}:{row.weaker_needs}",
            transform=axes.get_xaxis_transform(),
            ha="center",
            va="bottom",
            fontsize=8,
            rotation=90 if upright else 0,
        )
    return upright
