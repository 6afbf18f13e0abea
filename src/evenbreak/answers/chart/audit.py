"""How fair a chart is, and which ratings it was made for."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, astuple, replace
from typing import Any

import numpy as np

from evenbreak import handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import decimals, percent, range_words
from evenbreak.fields.question import refuse
from evenbreak.files.charts import find_chart_file
from evenbreak.handicaps.charts.audit import AuditRow, ChartAudit, ChartFit
from evenbreak.handicaps.charts.level_audit import LevelAudit, LevelCell, PointsAudit, audit_points
from evenbreak.handicaps.charts.level_chart import PointsChart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.matches.win import race_win_probability
from evenbreak.questions import charts as questions
from evenbreak.ratings.scale import NAMES, SCALES, Scale
from evenbreak.words import listed, race

SAME_SCALE = 0.05
"""Scales whose relative difference is smaller count as the same."""

SAME_CHANCE = 0.02
"""A chart favors neither player if the mean chance is closer to 1/2 than this."""

ROUGH = 0.25
"""A fit that is off by more than this share of a band, on average, isn't reported."""

_CHANCES = columns_of("p_win_low p_win_middle p_win_high")
_OFF = column_of("off_by_chance")
_MONOTONE = column_of("monotone")


def chart_audit_answer(report: ChartAudit, *, warnings: Sequence[str] = ()) -> Answer:
    """Return how fair a chart by rating difference is, and the scale and tilt that fit it.

    >>> from evenbreak.handicaps import audit
    >>> print(chart_audit_answer(audit("npl_10")).sentences[0].partition(". ")[0])
    At differences of 1 to 56 points, the stronger player wins 50% of the matches on average, so the
    chart favors neither player
    """
    points = report.scale.points_per_doubling
    fitted = report.fit is not None and report.fit is report.best_fit
    where = ", on the scale that fits it best" if fitted else ""
    columns = [
        *columns_of("span needs"),
        *_CHANCES,
        *columns_of("even_difference even_place"),
        _OFF,
        _MONOTONE,
    ]
    return Answer(
        f"Chart {report.name}{where}: {points:.4g} points double the odds of winning a game",
        [
            " ".join((*_favored(report), *_least_fair(report), *_beyond(report))),
            " ".join((*_order(report), *_made_for(report))),
            Table(
                "rows",
                columns,
                list(map(_paired, report.rows)),
                "The stronger player's chance in each band of rating differences, and the "
                "difference at which the race is exactly fair (even at):",
            ),
        ],
        details=list(_tilt(report, fitted=fitted)),
        warnings=warnings,
        data={
            "chart": report.name,
            "points_per_doubling": points,
            "fit": report.fit and asdict(report.fit),
            "best_fit": report.best_fit and asdict(report.best_fit),
            "gaps": report.gaps,
            "overlaps": report.overlaps,
            "mean_p_win": float(report.p_win.mean()) if report.p_win.size else None,
        },
    )


def _favored(report: ChartAudit) -> Iterator[str]:
    """Yield who the chart favors overall, if any row has an end."""
    chances = report.p_win
    if not chances.size:
        return
    last = max(row.difference_to for row in report.rows if row.difference_to is not None)
    mean = float(chances.mean())
    if abs(mean - 0.5) < SAME_CHANCE:
        so = "so the chart favors neither player"
    else:
        who, often = ("stronger", chances > 0.5) if mean > 0.5 else ("weaker", chances < 0.5)
        so = (
            f"so the chart favors the {who} player, who is the favorite at {int(often.sum())} of "
            f"{chances.size} differences"
        )
    yield (
        f"At differences of 1 to {last} points, the stronger player wins {percent(mean)} of the "
        f"matches on average, {so}."
    )


def _beyond(report: ChartAudit) -> Iterator[str]:
    """Yield the stronger player's chances where the chart has no harder race."""
    last = report.rows[-1]
    if last.difference_to is not None:
        return
    even = max(last.even_difference, last.difference_from)
    further = round(even + report.scale.points_per_doubling)
    needs = last.stronger_needs, last.weaker_needs
    wins = race_win_probability(report.scale.win_probability(float(further)), *needs)
    yield (
        f"The last race, {race(needs)}, applies however far apart two players are: at a "
        f"difference of {further} the stronger player wins {percent(wins)} of the time."
    )


def _least_fair(report: ChartAudit) -> Iterator[str]:
    ends = [
        (row, difference, chance)
        for row in report.rows
        for difference, chance in (
            (row.difference_from, row.p_win_low),
            (row.difference_to, row.p_win_high),
        )
        if difference is not None and chance is not None
    ]
    chances = [chance for _, _, chance in ends]
    worst, difference, chance = max(ends, key=lambda end: abs(end[2] - 0.5))
    yield (
        f"Up to {max(end[1] for end in ends)} points, their chance is never below "
        f"{percent(min(chances))} or above {percent(max(chances))}; the least fair race is "
        f"{worst.stronger_needs}:{worst.weaker_needs} at a difference of {difference}, which they "
        f"win {percent(chance)} of the time."
    )


def _order(report: ChartAudit) -> Iterator[str]:
    """Yield what is wrong with the order of the rows, or that nothing is wrong."""
    for count, spans in (("No race is", report.gaps), ("More than one race is", report.overlaps)):
        if spans:
            many = len(spans) > 1 or spans[0][0] != spans[0][1]
            where = "differences of" if many else "a difference of"
            yield f"{count} given for {where} {listed([range_words(*span) for span in spans])}."
    easier = [row for row in report.rows if not row.monotone]
    for row in easier:
        yield (
            f"The race for {range_words(row.difference_from, row.difference_to)} "
            f"({race((row.stronger_needs, row.weaker_needs))}) is no harder on the stronger player "
            "than the one before it."
        )
    if not (report.gaps or report.overlaps or easier):
        yield (
            "There are no gaps or overlaps, and each race is harder on the stronger player than "
            "the one before it."
        )


def _made_for(report: ChartAudit) -> Iterator[str]:
    """Yield the ratings that the chart was made for."""
    best, points = report.best_fit, report.scale.points_per_doubling
    if best is None:
        return
    fitting = best.points_per_doubling
    if _rough(report, best):
        yield (
            "The chart does not fit any ratings well: on the scale that comes nearest, "
            f"{fitting:.4g} points double the odds."
        )
        return
    known = next(
        (
            NAMES[name]
            for name, scale in SCALES.items()
            if abs(fitting / scale.points_per_doubling - 1.0) < SAME_SCALE
        ),
        "",
    )
    those = f", as with {known} ratings" if known else ""
    if abs(fitting / points - 1.0) < SAME_SCALE:
        yield f"The chart fits ratings on which about {fitting:.0f} points double the odds{those}."
    else:
        yield (
            f"The chart was made for other ratings: about {fitting:.4g} points double the odds on "
            f"the scale that it fits best{those}."
        )


def _rough(report: ChartAudit, fit: ChartFit) -> bool:
    """Return whether a chart's bands start far from where a fit would put them."""
    widths = [
        row.difference_to - row.difference_from + 1
        for row in report.rows
        if row.difference_to is not None
    ]
    return fit.misfit > ROUGH * sum(widths) / len(widths)


def _tilt(report: ChartAudit, *, fitted: bool) -> Iterator[str]:
    if report.fit is None:
        return
    yield (
        "'Place' is where in its band a race is even: 0 at the start, 0.5 in the middle, 1 at the "
        f"end. The chart's tilt is the place that suits all its races best: "
        f"{decimals(2)(report.fit.tilt)}. The bands start {report.fit.misfit:.2f} points away from "
        f"where this tilt would put them (root mean square); rounding to whole points accounts "
        "for 0.29."
    )
    best = report.best_fit
    if best is not None and not fitted:
        yield (
            f"On the scale that fits best, {best.points_per_doubling:.4g} points double the odds "
            f"and the tilt is {decimals(2)(best.tilt)}; the bands then start "
            f"{best.misfit:.2f} points from where that tilt would put them."
        )


def level_audit_answer(
    report: LevelAudit, *, skills: LevelSkills | None = None, warnings: Sequence[str] = ()
) -> Answer:
    """Return how fair a chart by skill level is, and the ratings that it implies.

    If `skills` were measured, they show how fair it really is.

    >>> from evenbreak.handicaps import audit_levels, level_chart
    >>> print(level_audit_answer(audit_levels(level_chart("apa_8ball"))).sentences[0])
    Between average players of two levels, the higher level wins between 42% and 58% of the
    matches. The least fair race is 5:2 between levels 7 and 4, which level 7 wins 42% of the time.
    """
    points = report.scale.points_per_doubling
    between = [cell for cell in report.cells if cell.level > cell.opponent_level]
    measured = [] if skills is None or skills.source == "chart" else _chances(between, skills)
    columns = [
        *columns_of("levels needs_at_levels"),
        *_CHANCES,
        *columns_of("even_difference apart", show={"even_difference": decimals(1)}),
        _OFF,
        _MONOTONE,
    ]
    return Answer(
        f"Chart {report.name}, on a scale where {points:.4g} points double the odds of winning a "
        "game",
        [
            _least_fair_levels(between),
            *([_in_fact(between, measured)] if measured else []),
            _level_order(report.cells),
            Table(
                "",
                columns,
                list(map(_paired, between)),
                "The higher level's chance of winning if the two players are as close as their "
                "levels allow (start), average for their levels (middle), or as far apart as "
                "possible (end). 'Even at' is the difference at which the race is fair, and "
                "'apart' is the difference between average players:",
            ),
            Table(
                "levels",
                columns_of("level rating", show={"rating": decimals(1)}),
                list(zip(report.levels, report.ratings, strict=True)),
                "The ratings that fit the chart best, with the lowest level at 0:",
            ),
        ],
        details=[
            f"With these ratings, the difference at which a race is fair is {report.misfit:.1f} "
            "points away from the difference between its two levels (root mean square over all "
            "pairs of levels)."
        ],
        warnings=warnings,
        data={
            "chart": report.name,
            "points_per_doubling": points,
            "misfit": report.misfit,
            "measured": [
                {"level": cell.level, "opponent_level": cell.opponent_level, "p_win": p}
                for cell, p in zip(between, measured, strict=False)
            ],
        },
        csv=Table("cells", columns, list(map(_paired, report.cells))),
    )


def _paired(one: AuditRow | LevelCell) -> tuple[Any, ...]:
    """Return the values of a row, the first four as two pairs."""
    first, second, third, fourth, *others = astuple(one)
    return (first, second), (third, fourth), *others


def _least_fair_levels(between: Sequence[LevelCell]) -> str:
    if not between:
        return "The chart has a single level, so all its players are equal."
    chances = [cell.p_win_middle for cell in between]
    worst = max(between, key=lambda cell: cell.unfairness)
    return (
        f"Between average players of two levels, the higher level wins between "
        f"{percent(min(chances))} and {percent(max(chances))} of the matches. The least fair race "
        f"is {worst.needs}:{worst.opponent_needs} between levels {worst.level} and "
        f"{worst.opponent_level}, which level {worst.level} wins {percent(worst.p_win_middle)} of "
        "the time."
    )


def _chances(between: Sequence[LevelCell], skills: LevelSkills) -> list[float]:
    """Return P(the higher level wins) for each pair, from what its levels are worth."""
    pairs = np.array([(cell.level, cell.opponent_level) for cell in between]).T
    needs = np.array([(cell.needs, cell.opponent_needs) for cell in between]).T
    chances: list[float] = race_win_probability(skills.chance(*pairs), *needs).tolist()
    return chances


def _in_fact(between: Sequence[LevelCell], chances: Sequence[float]) -> str:
    most, cell = max(zip(chances, between, strict=True), key=lambda pair: pair[0])
    return (
        "That assumes that the gaps between levels are exactly what the races make up for. In "
        "some 40,000 matches in other leagues with this chart, they weren't: the higher level won "
        f"{percent(min(chances))} to {percent(most)} of the matches, most often between levels "
        f"{cell.level} and {cell.opponent_level}."
    )


def _level_order(cells: Sequence[LevelCell]) -> str:
    easier = [f"{cell.level} v {cell.opponent_level}" for cell in cells if not cell.monotone]
    if easier:
        return (
            f"The race for {listed(easier)} is no harder on the higher level than a race "
            f"against a closer level."
        )
    return "Each race is harder on the higher level than any race against a closer level."


FEW, MANY = 15.0, 40.0
"""The numbers of innings used to show how much the answer depends on them."""


def points_audit_answer(chart: PointsChart, *, warnings: Sequence[str] = ()) -> Answer:
    """Return a points chart's audit, with the assumptions behind it.

    >>> from evenbreak.handicaps import points_chart
    >>> answer = points_audit_answer(points_chart("apa_9ball"))
    >>> print(answer.sentences[0].partition(". ")[0])
    Between average players of two levels, the higher level wins between 48% and 50% of the matches
    """
    report, few, many = (
        audit_points(chart, innings=innings) for innings in (audit_points(chart).innings, FEW, MANY)
    )
    columns = columns_of("level points_needed points_an_inning p_win_as_next")
    return Answer(
        f"Chart {report.name}, if players score in proportion to the points they need",
        [
            _even(report),
            _wrong_level(report, few, many),
            Table("levels", columns, list(map(astuple, report.levels))),
            f"The chart doesn't say how well the players at each level play. Here a player is "
            f"assumed to need {report.innings:g} innings on average to reach their points; "
            f"every shot is equally likely to go in and is worth one point, and a miss ends "
            f"the inning. The second point for the 9, balls that no one scores, and safeties are "
            f"left out.",
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
        f"is {uneven.points} points against {uneven.opponent_points} (levels {uneven.level} "
        f"and {uneven.opponent_level}), which level {uneven.level} wins "
        f"{percent(uneven.p_win)} of the time."
    )


def _wrong_level(*reports: PointsAudit) -> str:
    """Return what being one level too low is worth, and how much that depends on the innings."""
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


_DRAWN_TOGETHER = 0.1
"""Charts whose scales have a smaller relative difference are drawn on the same scale."""


def audit(asked: questions.ChartAudit) -> Answer:
    """Return how fair a chart is."""
    file = find_chart_file(asked.chart)
    warnings = (*file.warnings, *file.problems)
    if isinstance(file.found, handicaps.LevelChart):
        if asked.plot is not None:
            asked.refuse("a chart by skill level has no rating differences. Leave {plot} out.")
        levels = handicaps.audit_levels(file.found, scale=asked.scale or "npl")
        return level_audit_answer(
            levels, skills=handicaps.level_skills(file.found), warnings=warnings
        )
    if isinstance(file.found, handicaps.PointsChart):
        if asked.plot is not None or asked.scale is not None:
            asked.refuse(
                "a chart of points has no rating differences. Leave {scale} and {plot} out."
            )
        return points_audit_answer(file.found, warnings=warnings)
    report = handicaps.audit(file.found, scale=asked.scale)
    other = None if asked.beside is None else other_chart(asked.beside, report.scale)
    return replace(chart_audit_answer(report, warnings=warnings), drawn=(report, other))


def other_chart(chart: str, scale: Scale) -> handicaps.ChartAudit:
    """Return the other chart's audit, on the same scale if the two scales are close."""
    draft = find_chart_file(chart).found
    if not isinstance(draft, handicaps.ChartDraft):
        refuse("{beside} names a chart by skill level, which has no rating differences to plot")
    on_same = handicaps.audit(draft, scale=scale)
    if on_same.best_fit is None:
        return on_same
    own = on_same.best_fit.points_per_doubling
    is_near = abs(own / scale.points_per_doubling - 1.0) < _DRAWN_TOGETHER
    return on_same if is_near else handicaps.audit(draft)
