"""The audit of a chart of points: what it takes to be even, and what a wrong level is worth.

Such a chart does not say how well a level plays. If all players need about as many innings to
reach their points, their points an inning are in proportion to the points they need. A player
is then taken to shoot as in straight pool: each shot is made with the same chance, counts a
point, and a miss ends the inning, so that r points an inning mean a chance of r / (1 + r).
Left out are the second point of the 9, balls that nobody scores, safeties, and the layout.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

from evenbreak.checks import number
from evenbreak.handicaps.charts.chart_of import points_chart_of
from evenbreak.handicaps.charts.points_chart import PointsChart
from evenbreak.matches.straight_pool import StraightPool, straight_pool_odds

INNINGS = 25.0
"""The innings that a player is taken to need; the answers change little between 15 and 40."""


@dataclass(frozen=True)
class PointsLevel:
    """What a level of a chart of points is taken to play like.

    Parameters
    ----------
    level, points
        the level and the points that it needs.
    points_an_inning
        what an average player of the level scores an inning.
    p_win_as_next
        P(a player of this level who scores like the next one wins against an average player
        of this level); None for the highest.
    """

    level: int
    points: int
    points_an_inning: float
    p_win_as_next: float | None


@dataclass(frozen=True)
class PointsPair:
    """The match of average players of two levels, the higher one first."""

    level: int
    opponent_level: int
    points: int
    opponent_points: int
    p_win: float


@dataclass(frozen=True)
class PointsAudit:
    """What a chart of points comes to, under the assumptions of this module.

    Parameters
    ----------
    name
        the name of the chart.
    innings
        the innings that a player needs on average.
    levels, pairs
        the levels, and the pairs of different levels.
    """

    name: str
    innings: float
    levels: tuple[PointsLevel, ...]
    pairs: tuple[PointsPair, ...]


def audit_points(chart: PointsChart | str, *, innings: float = INNINGS) -> PointsAudit:
    """Return how even a chart of points is if points an inning go with the points needed.

    Parameters
    ----------
    chart
        the chart, or its name in `POINTS_CHARTS`.
    innings
        how many innings a player needs on average to reach their points.

    Raises
    ------
    InputError
        if there is no such chart, or `innings` is not a number of 1 or more.

    >>> report = audit_points("apa_9ball")
    >>> round(report.levels[4].points_an_inning, 2), round(report.levels[4].p_win_as_next, 2)
    (1.52, 0.69)
    """
    chart = points_chart_of(chart)
    innings = number(innings, "innings", low=1.0, high=1000.0)
    rows = list(zip(chart.levels, chart.points, strict=True))
    following = [*chart.points[1:], None]
    return PointsAudit(
        chart.name,
        innings,
        tuple(
            PointsLevel(
                level,
                points,
                points / innings,
                None if more is None else _win((points, points), (more, points), innings),
            )
            for (level, points), more in zip(rows, following, strict=True)
        ),
        tuple(
            PointsPair(high, low, own, other, _win((own, other), (own, other), innings))
            for (low, other), (high, own) in combinations(rows, 2)
        ),
    )


def _win(needs: tuple[int, int], scored_as: tuple[int, int], innings: float) -> float:
    """Return P(player 1 wins), either player being first at the table with chance 1/2."""
    p1, p2 = (points / (innings + points) for points in scored_as)
    matches = (StraightPool(*needs, p1, p2, first=first) for first in (1, 2))
    return sum(straight_pool_odds(match).p_win_1 for match in matches) / 2.0
