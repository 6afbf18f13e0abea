"""`evenbreak ladder --compare`: systems, charts and step sizes side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.plot import write_plot
from evenbreak.cli.kit.systems import chart_for
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.ladder.opponents import opponents_of_options, why_no_long_run

if TYPE_CHECKING:
    from evenbreak.answers.ladder.comparison import LadderComparison


ALLOWED = ("autocorrelated", "equal_skill", "league", "skill")
"""The options that --compare goes with, besides --chart and --plot."""


def comparison(chart_name: str | None, asked: dict[str, Any], plot: str | None) -> Answer:
    """Return systems and steps side by side, or refuse options that a comparison cannot take."""
    from evenbreak.answers.ladder.comparison import compare_ladders, ladder_comparison_answer
    from evenbreak.errors import AccuracyError
    from evenbreak.handicaps.systems.catalogue import system_of

    for name, value in asked.items():
        if name not in ALLOWED and value not in (None, False):
            option = {"start": "from"}.get(name, name.replace("_", "-"))
            refuse(f"--compare goes through several systems; leave --{option} out")
    npl = system_of("npl")
    chart, warnings = chart_for(npl, chart_name)
    opponents, name, doubts = opponents_of_options(
        asked, npl.scale, "--compare is for NPL ratings; leave it out and give --scale for others"
    )
    try:
        found = compare_ladders(chart, opponents, name)
    except AccuracyError as error:
        raise AccuracyError(why_no_long_run(error, opponents)) from None
    if plot is not None:
        _draw(found, plot)
    return ladder_comparison_answer(found, [*warnings, *doubts])


def _draw(found: LadderComparison, path: str) -> None:
    from evenbreak.answers.ladder.comparison import NEWCOMERS
    from evenbreak.plots.ladders import SystemPoint, systems_figure

    points = [
        SystemPoint(row.system, 100.0 * row.sd_doublings, row.settling_mean, best)
        for row, best in found.steps
    ]
    for row in found.systems:
        if (row.system, row.chart) == ("npl", found.chart.name):
            continue  # the league itself on this chart is the step of 1
        name = {NEWCOMERS: "newcomers", "npl": row.chart}.get(row.system, row.system)
        points.append(SystemPoint(name, 100.0 * row.sd_doublings, row.settling_mean, None))
    write_plot(systems_figure(points, chart=found.chart.name), path)
