"""The plot of an answer, for every question that has one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from evenbreak.answers.ladder.comparison import NEWCOMERS, LadderComparison
from evenbreak.answers.ladder.ladder import ladder_title
from evenbreak.answers.practice.practice import interval_of, trend_line_of
from evenbreak.files.practice import ScoresFile
from evenbreak.plots.charts import draw_chart
from evenbreak.plots.contours import breaks_figure, draw_shots
from evenbreak.plots.ladders import SystemPoint, draw_systems, ladder_figure
from evenbreak.plots.league import draw_pay
from evenbreak.plots.matches import course_figure, draw_formats
from evenbreak.plots.practice import (
    draw_drill,
    draw_log,
    draw_practice_shots,
    draw_score,
    draw_scores,
    draw_spot,
    draw_two_lists,
)
from evenbreak.plots.traced_shot import shot_on_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from evenbreak.answers.kit.answer import Answer

Picture = Callable[[Any, "Answer"], "Axes | Figure"]


def picture_of(command: str, asked: Any, answer: Answer) -> Axes | Figure:
    """Return the plot of the answer to a command's question."""
    return _PICTURES[command](asked, answer)


def _compare(_: Any, answer: Answer) -> Axes | Figure:
    players, formats, line, pairs = answer.drawn
    return draw_formats(
        formats,
        line,
        pairs.values(),
        p1=float(players.rack.p1),
        title=answer.heading,
        names=players.names,
    )


def _ladder(asked: Any, answer: Answer) -> Axes | Figure:
    if asked.compare:
        comparison = answer.drawn
        return draw_systems(_points_of(comparison), chart=comparison.chart.name)
    findings = answer.drawn
    return ladder_figure(
        findings.law,
        natural=findings.natural,
        within=findings.question.within,
        curve=findings.settling,
        title=f"Ratings on {ladder_title(findings.ladder)}",
    )


def _points_of(comparison: LadderComparison) -> list[SystemPoint]:
    points = [
        SystemPoint(row.system, 100.0 * row.sd_doublings, row.settling_mean, best)
        for row, best in comparison.steps
    ]
    for row in comparison.systems:
        if (row.system, row.chart) == ("npl", comparison.chart.name):
            continue  # the league itself on this chart is the step of 1
        name = {NEWCOMERS: "newcomers", "npl": row.chart}.get(row.system, row.system)
        points.append(SystemPoint(name, 100.0 * row.sd_doublings, row.settling_mean, None))
    return points


def _practice(asked: Any, answer: Answer) -> Axes | Figure:
    confidence = asked.confidence
    if isinstance(answer.drawn, ScoresFile):
        file = answer.drawn
        line = trend_line_of(file, confidence) if asked.new is None else None
        return draw_scores(file, interval_of(file, confidence), line, new=asked.new)
    one, other = answer.drawn
    if not isinstance(one, ScoresFile):
        return draw_practice_shots(one, other, confidence=confidence)
    intervals = interval_of(one, confidence), interval_of(other, confidence)
    return draw_two_lists(one.scores, other.scores, ("before", "after"), intervals)


_PICTURES: dict[str, Picture] = {
    "live": lambda _, answer: course_figure(
        answer.drawn[1], title=answer.heading, names=answer.drawn[0].names
    ),
    "compare": _compare,
    "breaks": lambda _, answer: breaks_figure(answer.drawn[0], first_breaker=answer.drawn[1]),
    "oneball": lambda asked, answer: draw_shots(answer.drawn, look_ahead=asked.ahead),
    "straight": lambda _, answer: draw_spot(answer.drawn),
    "chart audit": lambda _, answer: draw_chart(*answer.drawn),
    "ladder": _ladder,
    "sandbag pay": lambda _, answer: draw_pay(answer.drawn),
    "drill": lambda asked, answer: (draw_drill if asked.log is None else draw_log)(answer.drawn),
    "practice": _practice,
    "runs": lambda asked, answer: draw_score(answer.drawn[0], asked.innings, asked=answer.drawn[1]),
    "physics shot": lambda _, answer: shot_on_table(answer.drawn),
}
