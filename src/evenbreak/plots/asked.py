"""The picture of an answer, for every question that has one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from evenbreak.answers.kit.answer import Answer
    from evenbreak.answers.ladder.comparison import LadderComparison
    from evenbreak.plots.ladders import SystemPoint

Picture = Callable[[Any, "Answer"], "Axes | Figure"]


def picture_of(command: str, asked: Any, answer: Answer) -> Axes | Figure:
    """Return the picture of an answer.

    Parameters
    ----------
    command, asked
        the question, as `evenbreak.answers.asked.answer_to` takes it.
    answer
        its answer.
    """
    return _PICTURES[command](asked, answer)


def _live(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.matches import course_figure

    players, odds = answer.drawn
    return course_figure(odds, title=answer.heading, names=players.names)


def _compare(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.matches import draw_formats

    players, formats, line, pairs = answer.drawn
    return draw_formats(
        formats,
        line,
        pairs.values(),
        p1=float(players.rack.p1),
        title=answer.heading,
        names=players.names,
    )


def _breaks(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.contours import breaks_figure

    rack, first = answer.drawn
    return breaks_figure(rack, first_breaker=first)


def _oneball(asked: Any, answer: Answer) -> Axes | Figure:
    from evenbreak.plots import draw_shots

    return draw_shots(answer.drawn, look_ahead=asked.ahead)


def _straight(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.practice import draw_spot

    return draw_spot(answer.drawn)


def _chart(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.charts import draw_chart

    return draw_chart(*answer.drawn)


def _ladder(asked: Any, answer: Answer) -> Axes | Figure:
    from evenbreak.plots.ladders import draw_systems, ladder_figure

    if asked.compare:
        comparison = answer.drawn
        return draw_systems(_points_of(comparison), chart=comparison.chart.name)
    from evenbreak.answers.ladder.ladder import ladder_title

    findings = answer.drawn
    return ladder_figure(
        findings.law,
        natural=findings.natural,
        within=findings.question.within,
        curve=findings.settling,
        title=ladder_title(findings.ladder),
    )


def _points_of(comparison: LadderComparison) -> list[SystemPoint]:
    from evenbreak.answers.ladder.comparison import NEWCOMERS
    from evenbreak.plots.ladders import SystemPoint

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


def _sandbag_pay(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.league import draw_pay

    return draw_pay(answer.drawn)


def _drill(asked: Any, answer: Answer) -> Axes | Figure:
    from evenbreak.plots.practice import draw_drill, draw_log

    return draw_drill(answer.drawn) if asked.log is None else draw_log(answer.drawn)


def _practice(asked: Any, answer: Answer) -> Axes | Figure:
    from evenbreak.answers.practice.practice import interval_of, trend_line_of
    from evenbreak.files.practice import ScoresFile
    from evenbreak.plots.practice import draw_practice_shots, draw_scores, draw_two_lists

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


def _runs(asked: Any, answer: Answer) -> Axes | Figure:
    from evenbreak.plots.practice import draw_score

    law, shaded = answer.drawn
    return draw_score(law, asked.innings, asked=shaded)


def _shot(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots import shot_on_table

    return shot_on_table(answer.drawn)


_PICTURES: dict[str, Picture] = {
    "live": _live,
    "compare": _compare,
    "breaks": _breaks,
    "oneball": _oneball,
    "straight": _straight,
    "chart audit": _chart,
    "ladder": _ladder,
    "sandbag pay": _sandbag_pay,
    "drill": _drill,
    "practice": _practice,
    "runs": _runs,
    "physics shot": _shot,
}
