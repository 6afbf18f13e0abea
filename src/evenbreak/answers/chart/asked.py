"""From a question about charts to its answer."""

from __future__ import annotations

from dataclasses import replace

from evenbreak import handicaps
from evenbreak.answers.chart.show import (
    chart_list_answer,
    chart_show_answer,
    system_list_answer,
    team_handicap_answer,
)
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import chart_by_difference
from evenbreak.errors import InputError
from evenbreak.fields.question import refuse
from evenbreak.files.charts import find_chart_file
from evenbreak.questions.charts import (
    ChartAudit,
    ChartDesign,
    ChartList,
    ChartShow,
    ChartTeam,
    Systems,
)
from evenbreak.ratings.scale import Scale
from evenbreak.words import Parameter, Sentence, say

_FIELDS = {"rows": "most_rows", "weaker_least": "least", "stronger_least": "least"}
"""What a parameter of a design is called in the question."""

SAME_SCALE = 0.1
"""Charts whose scales differ by a smaller share are drawn on the same scale."""


def list_(asked: ChartList) -> Answer:  # noqa: ARG001
    """Return the charts that there are."""
    return chart_list_answer()


def systems(asked: Systems) -> Answer:  # noqa: ARG001
    """Return the systems that there are."""
    return system_list_answer()


def show(asked: ChartShow) -> Answer:
    """Return the races of a chart."""
    file = find_chart_file(asked.chart)
    return chart_show_answer(file.chart, warnings=file.warnings)


def audit(asked: ChartAudit) -> Answer:
    """Return how fair a chart is."""
    from evenbreak.answers.chart.audit import (
        chart_audit_answer,
        level_audit_answer,
        points_audit_answer,
    )

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
    other = None if asked.beside is None else other_chart(asked.beside, report.scale)
    return replace(chart_audit_answer(report, warnings=warnings), drawn=(report, other))


def other_chart(chart: str, scale: Scale) -> handicaps.ChartAudit:
    """Return the audit of the chart beside, on the same scale if it was made for about that."""
    draft = find_chart_file(chart).found
    if not isinstance(draft, handicaps.ChartDraft):
        refuse("{beside} names a chart by skill level, which has no rating differences to plot")
    on_same = handicaps.audit(draft, scale=scale)
    if on_same.best_fit is None:
        return on_same
    own = on_same.best_fit.points_per_doubling
    is_near = abs(own / scale.points_per_doubling - 1.0) < SAME_SCALE
    return on_same if is_near else handicaps.audit(draft)


def design(asked: ChartDesign) -> Answer:
    """Return the fairest chart."""
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
        raise InputError(_of_the_question(error.sentence)) from error


def _of_the_question(sentence: Sentence) -> Sentence:
    """Return what is wrong with a design, with its parameters as the question calls them."""
    values = {name: Parameter(field) for name, field in _FIELDS.items()}
    for name, value in sentence.values.items():
        is_one = isinstance(value, Parameter)
        values[name] = Parameter(_FIELDS.get(value, value)) if is_one else value
    return say(sentence.template, **values)


def team(asked: ChartTeam) -> Answer:
    """Return the points that the weaker of two teams gets."""
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
