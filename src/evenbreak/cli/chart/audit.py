"""`evenbreak chart audit`: how fair a chart is, and which scale it was made for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.chart.show import span_text
from evenbreak.cli.kit.callbacks import refuse, wants_json
from evenbreak.cli.kit.output import SCHEMA_VERSION, aligned, csv_text, print_json, to_terminal
from evenbreak.cli.kit.plot import plot_option_for, write_plot

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.audit import AuditRow, ChartAudit
    from evenbreak.handicaps.charts.level_audit import LevelAudit, LevelCell
    from evenbreak.handicaps.charts.level_chart import LevelChart
    from evenbreak.ratings.scale import Scale

ROW_HEADINGS = ("difference", "race", "W low", "middle", "high", "even at", "place", "off by")
LEVEL_HEADINGS = ("levels", "race", "W low", "middle", "high", "even at", "apart", "off by")

SAME_SCALE = 0.1
"""Charts whose scales differ by a smaller share are drawn in the same points."""

EXAMPLES = """\b
Examples:
  evenbreak chart audit npl_10
  evenbreak chart audit fargo_r6_hot --scale fargo
  evenbreak chart audit ours.csv --plot ours.png --beside npl_10
"""


@click.command("audit", epilog=EXAMPLES)
@click.argument("chart", metavar="NAME_OR_FILE")
@click.option(
    "--scale",
    metavar="npl|fargo|elo|POINTS",
    help="What the ratings mean: POINTS of difference double the odds.  [default: what fits the "
    "chart best; npl for a chart of skill levels]",
)
@click.option("--beside", metavar="NAME_OR_FILE", help="Another chart for the picture.")
@plot_option_for("not of a chart of skill levels")
@wants_json
def command(
    chart: str, scale: str | None, beside: str | None, plot: str | None, as_json: bool
) -> None:
    """Tell how fair a chart is, race by race, and which scale it was made for.

    NAME_OR_FILE: a chart that `evenbreak chart list` names, or a CSV file of one; it may have
    gaps and overlaps. The picture is that of the stronger player's chance over the rating
    difference.
    """
    from evenbreak.files.chart import find_chart_file
    from evenbreak.handicaps.charts.audit import audit
    from evenbreak.handicaps.charts.level_chart import LevelChart

    if beside is not None and plot is None:
        refuse("--beside adds a chart to the picture; give --plot FILE, or leave it out")
    file = find_chart_file(chart)
    for warning in (*file.warnings, *file.problems):
        click.echo(f"Warning: {warning}", err=True)
    if isinstance(file.found, LevelChart):
        if plot is not None:
            refuse("a chart of skill levels has no rating differences to draw; leave --plot out")
        _print_levels(file.found, scale, as_json)
        return
    report = audit(file.found, scale=scale)
    if plot is not None:
        from evenbreak.plots.charts import chart_figure

        other = None if beside is None else other_chart(beside, report.scale)
        write_plot(chart_figure(report, other), plot)
    if as_json:
        print_json(
            {
                "chart": report.name,
                "points_per_doubling": report.scale.points_per_doubling,
                "fit": report.fit and asdict(report.fit),
                "best_fit": report.best_fit and asdict(report.best_fit),
                "rows": [asdict(row) for row in report.rows],
                "gaps": report.gaps,
                "overlaps": report.overlaps,
                "schema_version": SCHEMA_VERSION,
            }
        )
        return
    if to_terminal():
        scale_said = f"{report.scale.points_per_doubling:.4g} points double the odds"
        cells = [_cells(row) for row in report.rows]
        click.echo(f"{report.name}: W, the stronger player's chance, where {scale_said}\n")
        click.echo(aligned([ROW_HEADINGS, *cells]))
    else:
        rows = [tuple(map(_csv, asdict(row).values())) for row in report.rows]
        click.echo(csv_text(list(asdict(report.rows[0])), rows), nl=False)
    for line in _verdict(report, fitted=scale is None):
        click.echo(line, err=not to_terminal())


def other_chart(chart: str, scale: Scale) -> ChartAudit:
    """Return the audit of the chart beside, on the same scale if it was made for about that."""
    from evenbreak.files.chart import find_chart_file
    from evenbreak.handicaps.charts.audit import audit
    from evenbreak.handicaps.charts.level_chart import LevelChart

    found = find_chart_file(chart).found
    if isinstance(found, LevelChart):
        refuse("--beside names a chart of skill levels, which has no rating differences to draw")
    on_same = audit(found, scale=scale)
    if on_same.best_fit is None:
        return on_same
    own = on_same.best_fit.points_per_doubling
    return on_same if abs(own / scale.points_per_doubling - 1.0) < SAME_SCALE else audit(found)


def _csv(value: Any) -> Any:
    return {True: "yes", False: "no"}[value] if isinstance(value, bool) else value


def _chance(value: float | None) -> str:
    return "" if value is None else f"{value:.3f}"


def _rounded(value: float) -> str:
    return f"{round(value, 2) + 0.0:.2f}"  # -0.0 + 0.0 is 0.0


def _cells(row: AuditRow) -> list[str]:
    """Return a row as a terminal shows it."""
    return [
        span_text(row.difference_from, row.difference_to),
        f"{row.stronger_needs}:{row.weaker_needs}",
        *map(_chance, (row.p_win_low, row.p_win_middle, row.p_win_high)),
        f"{row.even_difference:.2f}",
        "" if row.even_place is None else _rounded(row.even_place),
        _chance(row.unfairness),
    ]


def _verdict(report: ChartAudit, *, fitted: bool) -> Iterator[str]:
    """Yield what the rows come to, a line each."""
    best = report.best_fit
    if best is not None:
        yield (
            f"The scale that fits best: {best.points_per_doubling:.4g} points double the odds, "
            f"tilt {_rounded(best.tilt)}."
        )
    if report.fit is not None and not fitted:
        yield (
            f"On the scale given ({report.scale.points_per_doubling:.4g} points): "
            f"tilt {_rounded(report.fit.tilt)}."
        )
    if report.fit is not None:
        yield "Tilt is where in its band a race is even: 0 begin, 0.5 middle, 1 end."
        yield (
            f"The bands begin {report.fit.misfit:.2f} points from there (root mean square; "
            "rounding makes 0.29)."
        )
    yield _worst(report.worst)
    for told, spans in (("no row", report.gaps), ("more than one row", report.overlaps)):
        if spans:
            yield f"Differences in {told}: {', '.join(span_text(*span) for span in spans)}."
    easier = [row for row in report.rows if not row.monotone]
    for row in easier:
        yield (
            f"Not harder than an earlier race: {row.stronger_needs}:{row.weaker_needs} "
            f"({span_text(row.difference_from, row.difference_to)})."
        )
    if not (report.gaps or report.overlaps or easier):
        yield "No gaps, no overlaps; each race is harder than the one before it."


def _worst(row: AuditRow) -> str:
    """Return in words which race is the most unfair, and where in its band."""
    ends = [(row.difference_from, row.p_win_low)]
    if row.difference_to is not None and row.p_win_high is not None:
        ends.append((row.difference_to, row.p_win_high))
    difference, chance = max(ends, key=lambda end: abs(end[1] - 0.5))
    return (
        f"Most unfair: {row.stronger_needs}:{row.weaker_needs} at a difference of {difference}, "
        f"where the stronger wins {chance:.3f}."
    )


def _print_levels(chart: LevelChart, scale: str | None, as_json: bool) -> None:
    from evenbreak.handicaps.charts.level_audit import audit_levels

    report = audit_levels(chart, scale="npl" if scale is None else scale)
    levels = [
        {"level": level, "rating": rating}
        for level, rating in zip(report.levels, report.ratings, strict=True)
    ]
    if as_json:
        print_json(
            {
                "chart": report.name,
                "points_per_doubling": report.scale.points_per_doubling,
                "misfit": report.misfit,
                "levels": levels,
                "cells": [asdict(cell) for cell in report.cells],
                "schema_version": SCHEMA_VERSION,
            }
        )
        return
    if to_terminal():
        scale_said = f"{report.scale.points_per_doubling:.4g} points double the odds"
        click.echo(f"{report.name}: W, the higher level's chance, where {scale_said}\n")
        cells = [_level_cells(cell) for cell in report.cells if cell.level > cell.opponent_level]
        click.echo(aligned([LEVEL_HEADINGS, *cells]))
    else:
        rows = [tuple(map(_csv, asdict(cell).values())) for cell in report.cells]
        click.echo(csv_text(list(asdict(report.cells[0])), rows), nl=False)
    for line in _level_verdict(report):
        click.echo(line, err=not to_terminal())


def _level_cells(cell: LevelCell) -> list[str]:
    return [
        f"{cell.level} v {cell.opponent_level}",
        f"{cell.needs}:{cell.opponent_needs}",
        *map(_chance, (cell.p_win_low, cell.p_win_middle, cell.p_win_high)),
        f"{cell.even_difference:.1f}",
        f"{cell.difference:.1f}",
        _chance(cell.unfairness),
    ]


def _level_verdict(report: LevelAudit) -> Iterator[str]:
    ratings = zip(report.levels, report.ratings, strict=True)
    yield "The ratings that fit the chart best, the lowest level at 0:"
    yield "  " + ", ".join(f"level {level} {rating:.1f}" for level, rating in ratings)
    yield f"Its races are even {report.misfit:.1f} points from there (root mean square)."
    worst = report.worst
    yield (
        f"Most unfair: level {worst.level} v {worst.opponent_level}, {worst.needs}:"
        f"{worst.opponent_needs}, off by {worst.unfairness:.3f}."
    )
    easier = [f"{cell.level} v {cell.opponent_level}" for cell in report.cells if not cell.monotone]
    if easier:
        yield f"Not harder than that of a nearer level: {', '.join(easier)}."
    else:
        yield "Each race is harder than those of nearer levels."
