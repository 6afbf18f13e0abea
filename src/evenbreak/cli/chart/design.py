"""`evenbreak chart design`: the fairest chart for given ratings, and what fairness costs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.chart.design_options import design_options, options_named, task_of
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.values import refuse

if TYPE_CHECKING:
    from evenbreak.answers.chart_design import DesignTask
    from evenbreak.handicaps.charts.chart import Chart


EXAMPLES = """\b
Examples:
  evenbreak chart design --games 7..9 --least 5:2 --beside npl_10
  evenbreak chart design --games 5..15 --scale fargo --tilt 0 > ours.csv
  evenbreak chart design --games 17..41 --rows 10 --rule worst
  evenbreak chart design --games 5..19 --pareto --beside npl_10
"""


@click.command("design", epilog=EXAMPLES)
@design_options
@click.option(
    "--pareto", is_flag=True, help="List what fairness costs in length, instead of one chart."
)
@plot_option
@faces()
def command(pareto: bool, plot: str | None, **wishes: Any) -> Answer:
    """Design the fairest chart for given ratings, within limits on its races.

    Unfairness is how far the stronger player's chance is from the target. Into a pipe or
    a file the chart is written as a CSV file that the other commands read.
    """
    from evenbreak.answers.chart_design import chart_design_answer

    with options_named(in_minutes=wishes["minutes"] is not None):
        task = task_of(**wishes)
        if pareto:
            return _pareto(task, plot)
        design = task.design()
    if plot is not None:
        _draw(task, design[0], plot)
    return chart_design_answer(task, design)


def _draw(task: DesignTask, made: Chart, plot: str) -> None:
    from evenbreak.handicaps.charts.audit import audit
    from evenbreak.plots.charts import chart_figure

    if not task.rules.is_plain:
        refuse("--plot draws plain races; leave it out, or --win-by and --breaks")
    reports = [audit(one, scale=task.rules.scale) for one in (made, *task.beside[:1])]
    write_plot(chart_figure(*reports), plot)


def _pareto(task: DesignTask, plot: str | None) -> Answer:
    from evenbreak.answers.chart_pareto import chart_pareto_answer
    from evenbreak.handicaps.charts.pareto import pareto

    if task.rule == "nearest" or task.mean_games is not None or task.tilt != 0.5:
        refuse("--pareto tries all lengths; leave --mean-games, --tilt and --rule nearest out")
    with Progress("charts designed") as progress:
        charts = pareto(
            task.rules,
            task.limits,
            beside=task.beside,
            criterion=task.rule,
            target=task.target,
            up_to=task.up_to,
            rows=task.rows,
            spread=task.spread,
            watch=progress,
        )
    if plot is not None:
        from evenbreak.plots.pareto_front import pareto_figure

        write_plot(pareto_figure(charts, criterion=task.rule), plot)
    return chart_pareto_answer(task, charts)
