"""Audit a chart by skill level: the ratings that it implies for the levels.

The race between two levels is even at one difference in strength. If the chart were consistent,
each level would have a rating, and every such difference would be the difference between two
ratings. Least squares finds the ratings that come closest to that.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import number
from evenbreak.handicaps.charts.chart_of import level_chart_of, points_chart_of
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.race_grid import even_doublings
from evenbreak.matches.straight_pool import StraightPool, straight_pool_odds
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale, scale_of


@dataclass(frozen=True)
class LevelCell:
    """The race between two skill levels, and its chances.

    Parameters
    ----------
    level, opponent_level, needs, opponent_needs
        the two levels, higher one first, and each player's games.
    p_win_low, p_win_middle, p_win_high
        P(the higher-level player wins) if the two players are as close as their levels allow, in
        the middle of their levels, and as far apart as their levels allow. For two players at the
        same level: P(the stronger player wins).
    even_difference
        the difference in points at which the race is even.
    difference
        the difference in points between the ratings of the two levels; below `even_difference`, the
        chart favors the lower level; above it, the higher level.
    unfairness
        `|p_win_middle - 1/2|`; 0 for two players at the same level.
    monotone
        whether the race is harder for the higher level than the race against the next higher
        opponent, and than the race of the next lower level against the same opponent.
    """

    level: int
    opponent_level: int
    needs: int
    opponent_needs: int
    p_win_low: float
    p_win_middle: float
    p_win_high: float
    even_difference: float
    difference: float
    unfairness: float
    monotone: bool


@dataclass(frozen=True)
class LevelAudit:
    """How fair a chart by skill level is, and which ratings it implies.

    Parameters
    ----------
    scale
        the scale of the ratings; the chart itself does not determine one.
    levels, ratings
        the skill levels, and the rating in the middle of each in points, 0 for the lowest.
    misfit
        root mean square distance, in points, between the differences at which the races are even
        and the differences of these ratings, over the pairs of different levels.
    cells
        the pairs of levels, higher one first.
    """

    name: str
    scale: Scale
    levels: tuple[int, ...]
    ratings: tuple[float, ...]
    misfit: float
    cells: tuple[LevelCell, ...]

    @property
    def worst(self) -> LevelCell:
        """The most unfair pair of levels; the first one if several are equally unfair."""
        return max(self.cells, key=lambda cell: cell.unfairness)


def audit_levels(chart: LevelChart | str, *, scale: Any = DEFAULT_SCALE) -> LevelAudit:
    """Return the fairness of a chart by skill level, and the ratings that fit it best.

    Each level is assumed to extend halfway to its neighbors; the lowest and highest levels extend
    as far outward as inward.

    Parameters
    ----------
    scale
        the scale of the ratings: 'npl', 'fargo', 'elo', a `Scale` or the points that double
        the odds. The chances do not depend on it.

    Raises
    ------
    InputError
        if the chart or the scale is unknown.

    Notes
    -----
    Where a race is even: P5.5. Every pair of levels has the same weight.

    >>> report = audit_levels("apa_8ball", scale="fargo")
    >>> [round(rating) for rating in report.ratings]
    [0, 44, 101, 149, 184, 223]
    """
    used, chart = scale_of(scale), level_chart_of(chart)
    needs = np.array(chart.needs)
    even = even_doublings(needs, needs.T)
    # Every pair counts once, and even[j, i] = -even[i, j]; so the mean of a row is the
    # least-squares rating of its level.
    strength = even.mean(axis=1)
    gaps = strength[:, None] - strength[None, :]
    upper = np.triu_indices(len(strength), 1)
    misfit = float(np.sqrt(np.mean((gaps - even)[upper] ** 2))) if len(upper[0]) else 0.0
    points = used.points_per_doubling
    return LevelAudit(
        chart.name,
        used,
        tuple(chart.levels),
        tuple((points * (strength - strength[0])).tolist()),
        points * misfit,
        tuple(_cells(chart, even, strength, used)),
    )


def _cells(chart: LevelChart, even: Floats, strength: Floats, scale: Scale) -> Iterator[LevelCell]:
    half = np.diff(strength) / 2.0
    below, above = (np.r_[half[:1], half], np.r_[half, half[-1:]]) if len(half) else ([0.0],) * 2
    low, high = strength - below, strength + above
    points = scale.points_per_doubling
    for i, level in enumerate(chart.levels):
        for j, opponent in enumerate(chart.levels[: i + 1]):
            own, theirs = chart.race(level, opponent)
            gap = strength[i] - strength[j]
            nearest, farthest = (low[i] - high[j] if i > j else 0.0), high[i] - low[j]
            middle = gap if i > j else farthest / 2.0
            p = scale.win_probability(points * np.array([nearest, middle, farthest]))
            low_end, center, high_end = race_win_probability(p, own, theirs).tolist()
            easier = [even[k] for k in ((i - 1, j), (i, j + 1)) if i > j]
            yield LevelCell(
                level,
                opponent,
                own,
                theirs,
                p_win_low=low_end,
                p_win_middle=center,
                p_win_high=high_end,
                even_difference=float(points * even[i, j]),
                difference=float(points * gap),
                unfairness=abs(center - 0.5) if i > j else 0.0,
                monotone=all(even[i, j] > gap_before for gap_before in easier),
            )


# The audit of a chart of points: what it takes to be even, and what a wrong level is worth.
#
# Such a chart does not say how well a level plays. If all players need about as many innings to
# reach their points, their points an inning are in proportion to the points they need. A player
# is then taken to shoot as in straight pool: each shot is made with the same chance, counts a
# point, and a miss ends the inning, so that r points an inning mean a chance of r / (1 + r).
# Left out are the second point of the 9, balls that nobody scores, safeties, and the layout.


INNINGS = 25.0
"""The innings that a player is assumed to need; results change little between 15 and 40."""


@dataclass(frozen=True)
class PointsLevel:
    """Assumed play of a level in a chart of points.

    `points_an_inning` is for an average player; `p_win_as_next` is P(a player at this level who
    scores like the next level wins against an average player at this level), None for the highest
    level.
    """

    level: int
    points: int
    points_an_inning: float
    p_win_as_next: float | None


@dataclass(frozen=True)
class PointsPair:
    """The match between average players of two levels, higher one first."""

    level: int
    opponent_level: int
    points: int
    opponent_points: int
    p_win: float


@dataclass(frozen=True)
class PointsAudit:
    """The levels and pairs of a chart of points, under the assumptions of this module.

    Parameters
    ----------
    innings
        the mean number of innings that a player needs.
    """

    name: str
    innings: float
    levels: tuple[PointsLevel, ...]
    pairs: tuple[PointsPair, ...]


def audit_points(chart: PointsChart | str, *, innings: float = INNINGS) -> PointsAudit:
    """Return how even a chart of points is, if points per inning are proportional to points needed.

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
            PointsPair(
                high,
                low,
                needs_high,
                needs_low,
                _win((needs_high, needs_low), (needs_high, needs_low), innings),
            )
            for (low, needs_low), (high, needs_high) in combinations(rows, 2)
        ),
    )


def _win(needs: tuple[int, int], scored_as: tuple[int, int], innings: float) -> float:
    """Return P(player 1 wins), where each player is equally likely to shoot first."""
    p1, p2 = (points / (innings + points) for points in scored_as)
    matches = (StraightPool(*needs, p1, p2, first=first) for first in (1, 2))
    return sum(straight_pool_odds(match).p_win_1 for match in matches) / 2.0
