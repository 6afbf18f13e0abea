"""`evenbreak chart audit`: how fair a chart is, and which ratings it was made for."""

from __future__ import annotations

import click

from evenbreak import handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import scale_option
from evenbreak.cli.kit.plot import plot_option_for, write_plot
from evenbreak.cli.kit.values import refuse
from evenbreak.ratings.scale import Scale

SAME_SCALE = 0.1
"""Charts whose scales differ by a smaller share are drawn on the same scale."""

EXAMPLES = """\b
Examples:
  evenbreak chart audit npl_10
  evenbreak chart audit fargo_r6_hot --scale fargo
  evenbreak chart audit ours.csv --plot ours.png --beside npl_10
"""


@click.command("audit", epilog=EXAMPLES)
@click.argument("chart", metavar="NAME_OR_FILE")
@scale_option("what fits the chart best; npl for a chart by skill level", fixed=False)
@click.option("--beside", metavar="NAME_OR_FILE", help="Another chart for the picture of --plot.")
@plot_option_for("not for a chart by skill level")
@faces()
def command(chart: str, scale: Scale | None, beside: str | None, plot: str | None) -> Answer:
    """Check how fair a chart is, race by race, and which ratings it was made for.

    NAME_OR_FILE is a chart from `evenbreak chart list` or a CSV file, which may have gaps
    and overlaps. The plot shows the stronger player's chance by rating difference.
    """
    from evenbreak.answers.chart.audit import chart_audit_answer, level_audit_answer
    from evenbreak.files.charts import find_chart_file

    if beside is not None and plot is None:
        refuse("--beside adds a chart to the plot; give --plot FILE, or leave --beside out")
    file = find_chart_file(chart)
    warnings = (*file.warnings, *file.problems)
    if isinstance(file.found, handicaps.LevelChart):
        if plot is not None:
            refuse("a chart by skill level has no rating differences to plot; leave --plot out")
        return level_audit_answer(
            handicaps.audit_levels(file.found, scale=scale or "npl"), warnings=warnings
        )
    if isinstance(file.found, handicaps.PointsChart):
        from evenbreak.answers.chart.audit import points_audit_answer

        if plot is not None or scale is not None:
            refuse("a chart of points has no rating differences; leave --scale and --plot out")
        return points_audit_answer(file.found, warnings=warnings)
    report = handicaps.audit(file.found, scale=scale)
    if plot is not None:
        from evenbreak.plots.charts import chart_figure

        other = None if beside is None else other_chart(beside, report.scale)
        write_plot(chart_figure(report, other), plot)
    return chart_audit_answer(report, warnings=warnings)


def other_chart(chart: str, scale: Scale) -> handicaps.ChartAudit:
    """Return the audit of the chart beside, on the same scale if it was made for about that."""
    from evenbreak.files.charts import find_chart_file

    found = find_chart_file(chart).found
    if not isinstance(found, handicaps.ChartDraft):
        refuse("--beside names a chart by skill level, which has no rating differences to plot")
    on_same = handicaps.audit(found, scale=scale)
    if on_same.best_fit is None:
        return on_same
    own = on_same.best_fit.points_per_doubling
    return (
        on_same
        if abs(own / scale.points_per_doubling - 1.0) < SAME_SCALE
        else handicaps.audit(found)
    )
