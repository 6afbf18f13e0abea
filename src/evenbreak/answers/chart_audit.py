"""How fair a chart is, and which ratings it was made for."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, astuple
from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.wording import decimals, listed, percent, race, range_words
from evenbreak.handicaps.charts.audit import AuditRow, ChartAudit, ChartFit
from evenbreak.handicaps.charts.level_audit import LevelAudit, LevelCell

SAME_SCALE = 0.05
"""Scales that differ by a smaller share are the same scale to a reader."""

TILTS = (
    (0.15, "at the start of its band, so the stronger player is nearly always the favourite"),
    (0.35, "early in its band, so the stronger player is the favourite more often"),
    (0.65, "near the middle of its band, so neither player is favoured overall"),
    (0.85, "late in its band, so the weaker player is the favourite more often"),
)
"""Where a race is even, up to each tilt."""

LATEST = "at the end of its band, so the weaker player is nearly always the favourite"

_CHANCES = (
    Column("p_win_low", "start", decimals(3)),
    Column("p_win_middle", "middle", decimals(3)),
    Column("p_win_high", "end", decimals(3)),
)
_OFF = Column("unfairness", "off by", decimals(3))
_MONOTONE = Column("monotone")


def chart_audit_answer(report: ChartAudit, *, warnings: Sequence[str] = ()) -> Answer:
    """Return how fair a chart by rating difference is, and the scale and tilt that fit it.

    >>> from evenbreak.handicaps import audit, chart
    >>> print(chart_audit_answer(audit(chart("npl_10"))).sentences[0])
    Up to a difference of 57 points, the stronger player wins between 44% and 58% of the matches.
    The least fair race is 7:3 at a difference of 46, where the stronger player wins 58% of the
    time.
    """
    points = report.scale.points_per_doubling
    fitted = report.fit is not None and report.fit is report.best_fit
    where = "on its best-fitting scale, where " if fitted else "where "
    columns = [
        Column(
            ("difference_from", "difference_to"),
            "difference",
            lambda ends: range_words(*ends),
            left=True,
        ),
        Column(("stronger_needs", "weaker_needs"), "race", race),
        *_CHANCES,
        Column("even_difference", "even at", decimals(2)),
        Column("even_place", "place", decimals(2), detail=True),
        _OFF,
        _MONOTONE,
    ]
    return Answer(
        f"Chart {report.name}, {where}{points:.4g} points double the odds of winning a game",
        [
            _least_fair(report),
            " ".join((*_order(report), *_made_for(report, fitted=fitted))),
            Table(
                "rows",
                columns,
                list(map(_paired, report.rows)),
                "The stronger player's chance in each band of differences; each race is exactly "
                "fair at the difference 'even at':",
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
        },
    )


def _least_fair(report: ChartAudit) -> str:
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
    return (
        f"Up to a difference of {max(end[1] for end in ends)} points, the stronger player wins "
        f"between {percent(min(chances))} and {percent(max(chances))} of the matches. The least "
        f"fair race is {worst.stronger_needs}:{worst.weaker_needs} at a difference of "
        f"{difference}, where the stronger player wins {percent(chance)} of the time."
    )


def _order(report: ChartAudit) -> Iterator[str]:
    """Yield what is wrong with the order of the rows, or that nothing is."""
    for count, spans in (("No race is", report.gaps), ("More than one race is", report.overlaps)):
        if spans:
            many = len(spans) > 1 or spans[0][0] != spans[0][1]
            where = "differences of" if many else "a difference of"
            yield f"{count} given for {where} {listed([range_words(*span) for span in spans])}."
    easier = [row for row in report.rows if not row.monotone]
    for row in easier:
        yield (
            f"The race for {range_words(row.difference_from, row.difference_to)}, "
            f"{row.stronger_needs}:{row.weaker_needs}, asks no more of the stronger player than an "
            "earlier one."
        )
    if not (report.gaps or report.overlaps or easier):
        yield (
            "There are no gaps or overlaps, and each race asks more of the stronger player than "
            "the one before it."
        )


def _made_for(report: ChartAudit, *, fitted: bool) -> Iterator[str]:
    best, points = report.best_fit, report.scale.points_per_doubling
    if best is None or report.fit is None:
        return
    if fitted:
        yield f"Each race is even {_where_even(report.fit)}."
    elif abs(best.points_per_doubling / points - 1.0) < SAME_SCALE:
        yield f"The chart fits these ratings: each race is even {_where_even(report.fit)}."
    else:
        yield (
            f"The chart fits another scale better: if {best.points_per_doubling:.4g} points double "
            f"the odds, each race is even {_where_even(best)}."
        )


def _where_even(fit: ChartFit) -> str:
    return next((words for tilt, words in TILTS if fit.tilt < tilt), LATEST)


def _tilt(report: ChartAudit, *, fitted: bool) -> Iterator[str]:
    if report.fit is None:
        return
    yield (
        "'Place' is where in its band a race is even: 0 at the start, 0.5 in the middle, 1 at the "
        f"end. The tilt of the chart is the place that suits all its races best: "
        f"{decimals(2)(report.fit.tilt)}. The bands begin {report.fit.misfit:.2f} points from "
        "where this tilt would put them (root mean square); rounding to whole points accounts "
        "for 0.29."
    )
    best = report.best_fit
    if best is not None and not fitted:
        yield (
            f"On the scale that fits best, {best.points_per_doubling:.4g} points double the odds "
            f"and the tilt is {decimals(2)(best.tilt)}; the bands then begin {best.misfit:.2f} "
            "points from where it would put them."
        )


def level_audit_answer(report: LevelAudit, *, warnings: Sequence[str] = ()) -> Answer:
    """Return how fair a chart by skill level is, and the ratings that it implies.

    >>> from evenbreak.handicaps import audit_levels, level_chart
    >>> print(level_audit_answer(audit_levels(level_chart("apa_8ball"))).sentences[0])
    Between average players of two levels, the higher level wins between 42% and 58% of the
    matches. The least fair race is 5:2 between levels 7 and 4, which level 7 wins 42% of the time.
    """
    points = report.scale.points_per_doubling
    between = [cell for cell in report.cells if cell.level > cell.opponent_level]
    columns = [
        Column(("level", "opponent_level"), "levels", _levels, left=True),
        Column(("needs", "opponent_needs"), "race", race),
        *_CHANCES,
        Column("even_difference", "even at", decimals(1)),
        Column("difference", "apart", decimals(1)),
        _OFF,
        _MONOTONE,
    ]
    return Answer(
        f"Chart {report.name}, on a scale where {points:.4g} points double the odds of winning a "
        "game",
        [
            _least_fair_levels(between),
            _level_order(report.cells),
            Table(
                "",
                columns,
                list(map(_paired, between)),
                "The higher level's chance if the two players are as close as their levels allow "
                "(start), average for their levels (middle), or as far apart as possible (end); "
                "the difference at which the race is fair (even at), and the one between average "
                "players (apart):",
            ),
            Table(
                "levels",
                [Column("level", "level"), Column("rating", "rating", decimals(1))],
                list(zip(report.levels, report.ratings, strict=True)),
                "The ratings that fit the chart best, with the lowest level at 0:",
            ),
        ],
        details=[
            f"With these ratings, the races are fair at differences {report.misfit:.1f} points "
            "away from those between the levels (root mean square over all pairs of levels)."
        ],
        warnings=warnings,
        data={
            "chart": report.name,
            "points_per_doubling": points,
            "misfit": report.misfit,
        },
        csv=Table("cells", columns, list(map(_paired, report.cells))),
    )


def _levels(two: tuple[int, int]) -> str:
    return f"{two[0]} v {two[1]}"


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


def _level_order(cells: Sequence[LevelCell]) -> str:
    easier = [f"{cell.level} v {cell.opponent_level}" for cell in cells if not cell.monotone]
    if easier:
        return (
            f"The race of {listed(easier)} asks no more of the higher level than one against a "
            "closer level."
        )
    return "Each race asks more of the higher level than the races against closer levels."
