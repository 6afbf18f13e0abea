"""How even a chart of points is, and what that rests on."""

from collections.abc import Sequence
from dataclasses import asdict, astuple

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.wording import chance, decimals, percent
from evenbreak.handicaps.charts.points_audit import PointsAudit, audit_points
from evenbreak.handicaps.charts.points_chart import PointsChart

FEW, MANY = 15.0, 40.0
"""The innings between which a reader sees how much the answer depends on them."""


def points_audit_answer(chart: PointsChart, *, warnings: Sequence[str] = ()) -> Answer:
    """Return what a chart of points comes to, with the assumptions behind it.

    >>> from evenbreak.handicaps import points_chart
    >>> answer = points_audit_answer(points_chart("apa_9ball"))
    >>> print(answer.sentences[0].partition(". ")[0])
    Between average players of two levels, the higher level wins between 48% and 50% of the matches
    """
    report, few, many = (
        audit_points(chart, innings=innings) for innings in (audit_points(chart).innings, FEW, MANY)
    )
    columns = [
        Column("level", "level"),
        Column("points", "points\nneeded"),
        Column("points_an_inning", "points\nan inning", decimals(2)),
        Column("p_win_as_next", "wins at own level if\nas good as the next", chance),
    ]
    return Answer(
        f"Chart {report.name}, if players score in proportion to the points they need",
        [
            _even(report),
            _wrong_level(report, few, many),
            Table("levels", columns, list(map(astuple, report.levels))),
            f"The chart says nothing about how well a level plays. Here a player needs "
            f"{report.innings:g} innings on average to reach their points; each shot is made with "
            "the same chance and counts a point, and a miss ends the inning. The second point of "
            "the 9, balls that nobody scores and safeties are left out.",
        ],
        warnings=warnings,
        data={
            "chart": report.name,
            "innings": report.innings,
            "pairs": [asdict(pair) for pair in report.pairs],
        },
    )


def _even(report: PointsAudit) -> str:
    if not report.pairs:
        return "The chart has a single level, so all its players are equal."
    chances = [pair.p_win for pair in report.pairs]
    uneven = max(report.pairs, key=lambda pair: abs(pair.p_win - 0.5))
    return (
        f"Between average players of two levels, the higher level wins between "
        f"{percent(min(chances))} and {percent(max(chances))} of the matches. The least even match "
        f"is {uneven.points} points against {uneven.opponent_points}, levels {uneven.level} and "
        f"{uneven.opponent_level}: level {uneven.level} wins {percent(uneven.p_win)}."
    )


def _wrong_level(*reports: PointsAudit) -> str:
    """Return what one level too low is worth, and how much that depends on the innings."""
    report, *others = (_as_next(one) for one in reports)
    if not report:
        return ""
    wide = [chance for other in others for chance in other]
    few, many = reports[1].innings, reports[2].innings
    return (
        f"A player rated one level too low wins {percent(min(report))} to {percent(max(report))} "
        f"of the matches at their own level ({percent(min(wide))} to {percent(max(wide))} if "
        f"players need {few:g} to {many:g} innings)."
    )


def _as_next(report: PointsAudit) -> list[float]:
    return [one.p_win_as_next for one in report.levels if one.p_win_as_next is not None]
