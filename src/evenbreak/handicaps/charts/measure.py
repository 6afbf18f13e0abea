"""How fair the matches of a chart are, and how long they last."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from evenbreak.checks import number_probability, whole
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.charts.race_grid import (
    even_differences,
    games_quantiles,
    mean_games_grid,
    win_grid,
)
from evenbreak.ratings.scale import scale_of

_TIE = 1e-9


@dataclass(frozen=True)
class ChartMeasure:
    """Fairness and length of a chart's matches, over all whole-point differences.

    Every difference from 0 to `up_to` has the same weight.

    Parameters
    ----------
    up_to
        the largest difference, in points.
    mean_unfairness, worst_unfairness
        mean and largest `|P(the stronger player wins) - target|`. At 0, where neither player is
        stronger, it counts as 0.
    worst_difference
        the difference at which it is largest.
    mean_games
        over all differences.
    games_p90
        the number of games within which 9 out of 10 matches end, at every difference.
    """

    up_to: int
    mean_unfairness: float
    worst_unfairness: float
    worst_difference: int
    mean_games: float
    games_p90: int


def last_difference(chart: Chart | str, scale: Any) -> int:
    """Return the last whole-point difference at which the chart's last race is not too easy.

    The race in the open-ended last row is even there; at larger differences, the stronger player is
    always the favorite. This marks the range that a chart was made for.

    >>> last_difference("npl_8", "npl")
    52
    """
    row = chart_of(chart).rows[-1]
    even = even_differences(scale_of(scale), row.stronger_needs, row.weaker_needs)
    return max(math.floor(float(even) + _TIE), 1)


def measure_chart(
    chart: Chart | str, scale: Any, *, up_to: int | None = None, target: float = 0.5
) -> ChartMeasure:
    """Return the fairness and length of a chart's matches.

    Parameters
    ----------
    chart
        a chart by rating difference, or its name in `CHARTS`.
    scale
        the scale of the ratings, as for `design`.
    up_to
        the last difference that counts; None: `last_difference(chart, scale)`.
    target
        the chance that the stronger player should have.

    Raises
    ------
    InputError
        if a parameter is out of range.

    >>> measured = measure_chart("npl_10", "npl")
    >>> round(measured.mean_unfairness, 4), round(measured.worst_unfairness, 4)
    (0.0288, 0.0817)
    >>> round(measured.mean_games, 2), measured.games_p90
    (6.68, 9)
    """
    scale, chart = scale_of(scale), chart_of(chart)
    target = number_probability(target, "target")
    last = last_difference(chart, scale) if up_to is None else whole(up_to, "up_to", at_least=1)
    unfair, mean_games, games_p90 = [], [], 0
    for row in chart.rows:
        end = last if row.difference_to is None else min(last, row.difference_to)
        if row.difference_from > last:
            break
        points = np.arange(row.difference_from, end + 1)
        race = [row.stronger_needs], [row.weaker_needs]
        unfair.append(np.abs(win_grid(scale, *race, points)[0] - target))
        mean_games.append(mean_games_grid(scale, *race, points)[0])
        games_p90 = max(games_p90, int(games_quantiles(scale, *row[2:], points, 0.9).max()))
    missed = np.concatenate(unfair)
    missed[0] = 0.0
    return ChartMeasure(
        last,
        float(missed.mean()),
        float(missed.max()),
        int(missed.argmax()),
        float(np.concatenate(mean_games).mean()),
        games_p90,
    )
