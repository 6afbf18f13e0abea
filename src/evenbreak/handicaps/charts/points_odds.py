"""Odds for a match by a chart of points, and how its match points are shared.

The players are assumed to shoot as in the audit of such a chart (`level_audit`): each shot is made
with the same chance and scores a point, and a miss ends the inning. After j innings, a player has k
points with the chance C(j + k - 1, k) p^k (1 - p)^j, and reaches the last of N points in inning i
with the chance C(i + N - 2, N - 1) p^N (1 - p)^(i - 1); both are exact here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import catalog_rows
from evenbreak.handicaps.charts.chart_of import points_chart_of
from evenbreak.handicaps.charts.level_audit import INNINGS
from evenbreak.handicaps.charts.level_chart import PointsChart, points_chart

MATCH_POINTS = 20
"""The match points shared by the two players in an APA 9-ball match."""


def loser_share(level: Any, points: Any) -> int:
    """Return how many of the 20 match points the loser of an APA 9-ball match gets.

    The winner gets the rest.

    Parameters
    ----------
    level
        the loser's skill level, 1 to 9.
    points
        the points that the loser scored, fewer than the level needs.

    Raises
    ------
    InputError
        if there is no such level, or a loser at this level cannot have this many points.

    Notes
    -----
    Source: the table on the association's score sheet, as implemented in two public score programs.

    >>> loser_share(3, 21), loser_share(9, 17), loser_share(5, 37)
    (7, 0, 8)
    """
    needs, _ = points_chart("apa_9ball").race(level, level)
    made = whole(points, "points", wanted=f"0 to {needs - 1}")
    if made >= needs:
        raise InputError("points must be 0 to {most}; you gave {made}", made=made, most=needs - 1)
    limits = next(row[1:] for row in catalog_rows("apa_9ball_shares") if row[0] == level)
    return int(np.searchsorted(limits, made))


@own_arrays
@dataclass(frozen=True, eq=False)
class PointsOdds:
    """Outcome of a match by a chart of points.

    Parameters
    ----------
    needs
        the points that player 1 and player 2 need, counted from 0.
    lost_1, lost_2
        `lost_1[k]`: P(player 1 loses with k points, including those in the current score); the same
        for player 2.
    share_1, share_2
        each player's mean match points, out of 20; None for charts other than APA 9-ball.
    mean_innings
        the mean number of innings left, including the last one.
    """

    needs: tuple[int, int]
    lost_1: Floats
    lost_2: Floats
    share_1: float | None
    share_2: float | None
    mean_innings: float

    def __repr__(self) -> str:
        m, n = self.needs
        return f"<PointsOdds of {m} points against {n}: {self.p_win_1:.4f}>"

    @property
    def p_win_1(self) -> float:
        """P(player 1 wins)."""
        return float(self.lost_2.sum())

    @property
    def p_win_2(self) -> float:
        """P(player 2 wins)."""
        return float(self.lost_1.sum())


def points_odds(
    chart: PointsChart | str,
    level_1: Any,
    level_2: Any,
    *,
    score: tuple[int, int] = (0, 0),
    innings: float = INNINGS,
) -> PointsOdds:
    """Return the outcome of a match between two skill levels by a chart of points.

    Either player is next at the table, with a chance of 1/2.

    Parameters
    ----------
    chart
        the chart, or its name in `POINTS_CHARTS`.
    level_1, level_2
        the skill levels.
    score
        the players' current points.
    innings
        how many innings a player needs on average to reach their points.

    Raises
    ------
    InputError
        if the chart does not have a level, or the score ends the match.

    >>> odds = points_odds("apa_9ball", 5, 3)
    >>> odds.needs, round(odds.p_win_1, 3), round(odds.share_1, 2)
    ((38, 25), 0.496, 9.91)
    """
    chart = points_chart_of(chart)
    needs: tuple[int, int] = chart.race(level_1, level_2)
    innings = number(innings, "innings", low=1.0, high=1000.0)
    left = []
    for need, has in zip(needs, score, strict=True):
        made = whole(has, "score")
        if made >= need:
            raise InputError("score is {made} of {need}: the match is over", made=made, need=need)
        left.append(need - made)
    chance = [need / (innings + need) for need in needs]
    reach = [_reaches(n, p) for n, p in zip(left, chance, strict=True)]
    longest = max(len(law) for law in reach)
    reach = [np.pad(law, (0, longest - len(law))) for law in reach]
    points = [_points(n, p, longest) for n, p in zip(left, chance, strict=True)]
    lost, length = [np.zeros(need) for need in needs], 0.0
    turns = np.arange(1, longest + 1)
    for winner, loser in ((0, 1), (1, 0)):
        for completed in (0, 1):  # the loser's innings before the winner's last: i - 1 or i
            law = points[loser][completed : longest + completed]
            lost[loser][score[loser] :] += reach[winner] @ law / 2.0
            length += float(reach[winner] * turns @ law.sum(axis=1)) / 2.0
    share_1, share_2 = _shares(chart, (level_1, level_2), lost)
    return PointsOdds(needs, lost[0], lost[1], share_1, share_2, length)


def _reaches(points: int, p: float) -> Floats:
    """Return P(the last of a number of points comes in inning 1, 2, ...)."""
    from scipy.stats import nbinom

    last = int(nbinom.isf(1e-14, points, p)) + 1
    return np.asarray(nbinom.pmf(np.arange(last + 1), points, p))


def _points(points: int, p: float, innings: int) -> Floats:
    """Return P(k points after j innings) for j = 0 to `innings` and k = 0 to `points` - 1."""
    from scipy.stats import nbinom

    made = np.arange(points)
    law = np.zeros((innings + 1, points))
    law[0, 0] = 1.0
    law[1:] = nbinom.pmf(made, np.arange(1, innings + 1)[:, None], 1.0 - p)
    return law


def _shares(
    chart: PointsChart, levels: tuple[Any, Any], lost: list[Floats]
) -> tuple[float, float] | tuple[None, None]:
    own = points_chart("apa_9ball")
    if (chart.levels, chart.points) != (own.levels, own.points):
        return None, None
    means = [
        sum(p * loser_share(level, k) for k, p in enumerate(law.tolist()))
        for level, law in zip(levels, lost, strict=True)
    ]
    p_1, p_2 = (float(law.sum()) for law in lost[::-1])
    return means[0] + MATCH_POINTS * p_1 - means[1], means[1] + MATCH_POINTS * p_2 - means[0]
