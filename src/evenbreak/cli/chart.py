"""`evenbreak chart`: list, show, audit and design handicap charts."""

from __future__ import annotations

import click

from evenbreak import handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import chart_by_difference
from evenbreak.cli.kit.asked import command_of, spelled
from evenbreak.cli.kit.groups import Entry, LazyGroup
from evenbreak.cli.kit.said import refuse, said
from evenbreak.cli.kit.terminal import write_plot
from evenbreak.errors import InputError
from evenbreak.questions.charts import ChartAudit, ChartDesign, ChartList, ChartShow, ChartTeam
from evenbreak.ratings.scale import Scale

COMMANDS = {
    "list": Entry("chart:list_", "List the charts that come with evenbreak."),
    "show": Entry("chart:show", "Show a chart: who needs how many games."),
    "audit": Entry("chart:audit", "Check how fair a chart is, and which ratings it fits."),
    "design": Entry("chart:design", "Design the fairest chart for given ratings."),
    "team": Entry("chart:team", "Find the points that the weaker of two teams gets."),
}
"""Each command, with its line of help."""

_FIELDS = {"rows": "most_rows", "weaker_least": "least", "stronger_least": "least"}
"""What a parameter of a design is called in the question."""

SAME_SCALE = 0.1
"""Charts whose scales differ by a smaller share are drawn on the same scale."""


@click.command("chart", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """List, show, audit and design handicap charts.

    A chart gives the race that two players play, by the difference of their ratings or
    by their skill levels.
    """


@command_of(ChartList, "list")
def list_(asked: ChartList) -> Answer:  # noqa: ARG001
    """List the charts."""
    from evenbreak.answers.chart.show import chart_list_answer

    return chart_list_answer()


@command_of(ChartShow, "show")
def show(asked: ChartShow) -> Answer:
    """Show the races of a chart."""
    from evenbreak.answers.chart.show import chart_show_answer
    from evenbreak.files.charts import find_chart_file

    file = find_chart_file(asked.chart)
    return chart_show_answer(file.chart, warnings=file.warnings)


@command_of(ChartAudit, "audit")
def audit(asked: ChartAudit) -> Answer:
    """Check how fair a chart is."""
    from evenbreak.answers.chart.audit import (
        chart_audit_answer,
        level_audit_answer,
        points_audit_answer,
    )
    from evenbreak.files.charts import find_chart_file

    file = find_chart_file(asked.chart)
    warnings = (*file.warnings, *file.problems)
    if isinstance(file.found, handicaps.LevelChart):
        if asked.plot is not None:
            asked.refuse("a chart by skill level has no rating differences; leave {plot} out")
        levels = handicaps.audit_levels(file.found, scale=asked.scale or "npl")
        return level_audit_answer(
            levels, skills=handicaps.level_skills(file.found), warnings=warnings
        )
    if isinstance(file.found, handicaps.PointsChart):
        if asked.plot is not None or asked.scale is not None:
            asked.refuse(
                "a chart of points has no rating differences; leave {scale} and {plot} out"
            )
        return points_audit_answer(file.found, warnings=warnings)
    report = handicaps.audit(file.found, scale=asked.scale)
    if asked.plot is not None:
        from evenbreak.plots.charts import draw_chart

        other = None if asked.beside is None else other_chart(asked.beside, report.scale)
        write_plot(draw_chart(report, other), asked.plot)
    return chart_audit_answer(report, warnings=warnings)


def other_chart(chart: str, scale: Scale) -> handicaps.ChartAudit:
    """Return the audit of the chart beside, on the same scale if it was made for about that."""
    from evenbreak.files.charts import find_chart_file

    draft = find_chart_file(chart).found
    if not isinstance(draft, handicaps.ChartDraft):
        refuse("--beside names a chart by skill level, which has no rating differences to plot")
    on_same = handicaps.audit(draft, scale=scale)
    if on_same.best_fit is None:
        return on_same
    own = on_same.best_fit.points_per_doubling
    is_near = abs(own / scale.points_per_doubling - 1.0) < SAME_SCALE
    return on_same if is_near else handicaps.audit(draft)


@command_of(ChartDesign, "design")
def design(asked: ChartDesign) -> Answer:
    """Design the fairest chart."""
    from evenbreak.answers.chart.design import DesignTask, chart_design_answer

    charts = tuple(chart_by_difference(name, "beside") for name in asked.beside)
    try:
        task = DesignTask(
            asked.scale,
            handicaps.RaceLimits(asked.games, *asked.least, asked.games_p90),
            target=asked.target,
            tilt=asked.tilt,
            up_to=asked.up_to,
            rows=asked.most_rows,
            beside=charts,
        )
        return chart_design_answer(task, task.design())
    except InputError as error:
        raise InputError(said(error.sentence, _spelled)) from error


def _spelled(parameter: str) -> str:
    """Return the option that sets a parameter of a design."""
    return spelled(ChartDesign, _FIELDS.get(parameter, parameter))


@command_of(ChartTeam, "team")
def team(asked: ChartTeam) -> Answer:
    """Find the points that the weaker of two teams gets."""
    from evenbreak.answers.chart.show import team_handicap_answer

    handicap = handicaps.team_handicap(
        asked.average_1,
        asked.average_2,
        match_ups=asked.match_ups,
        games=asked.single_games,
        points_won=asked.won,
        points_lost=asked.lost,
        scale=asked.scale,
    )
    return team_handicap_answer(
        (asked.average_1, asked.average_2),
        handicap,
        match_ups=asked.match_ups,
        scale=asked.scale,
    )
