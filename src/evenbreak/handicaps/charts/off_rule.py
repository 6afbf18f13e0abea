"""Where a chart breaks its rule: at each difference, the race with W closest to 1/2.

The chart is compared with its own races. Its first row is kept for equal players, for whom any even
race will do, and later rows are compared at each whole-point difference.
"""

from __future__ import annotations

from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.handicaps.charts.chart import Chart, ChartRow
from evenbreak.handicaps.charts.race_grid import win_grid
from evenbreak.ratings.scale import scale_of


class OffRule(NamedTuple):
    """A difference, in points, at which another race in the chart would be closer to even.

    `win` is P(the stronger player wins) in the chart's race, and `nearest_win` in the race closest
    to 1/2.
    """

    difference: int
    race: tuple[int, int]
    win: float
    nearest: tuple[int, int]
    nearest_win: float


def off_rule(chart: Chart, scale: Any) -> tuple[OffRule, ...]:
    """Return the differences at which another race in the chart has W closer to 1/2.

    Nothing past the start of the last row counts, because the hardest race is kept there.

    Source: the rule before Table 5.6.
    """
    races = [(row.stronger_needs, row.weaker_needs) for row in chart.rows]
    wins = _wins(chart, scale)
    nearest = np.abs(wins - 0.5).argmin(axis=0).tolist()
    return tuple(
        OffRule(
            difference,
            races[has],
            float(wins[has, difference]),
            races[best],
            float(wins[best, difference]),
        )
        for difference, best in enumerate(nearest)
        if (has := races.index(chart.race(difference))) != best
    )


def nearest_rows(chart: Chart, scale: Any) -> tuple[ChartRow, ...]:
    """Return the chart with its races moved to where the rule has them (W closest to 1/2).

    >>> from evenbreak.handicaps import chart
    >>> [(row.difference_from, *row[2:]) for row in nearest_rows(chart("npl_8"), "npl")]
    [(0, 4, 4), (7, 4, 3), (20, 5, 3), (29, 4, 2), (40, 5, 2), (49, 6, 2)]
    """
    nearest = np.abs(_wins(chart, scale) - 0.5).argmin(axis=0).tolist()
    rows: list[ChartRow] = []
    for place, run in groupby(enumerate(nearest), key=lambda pair: pair[1]):
        differences = [difference for difference, _ in run]
        rows.append(
            chart.rows[place]._replace(
                difference_from=differences[0], difference_to=differences[-1]
            )
        )
    rows[-1] = rows[-1]._replace(difference_to=None)
    return tuple(rows)


def _wins(chart: Chart, scale: Any) -> Floats:
    """Return P(the stronger player wins) by race and difference, up to past the last row's start.

    The last race is even further out than the previous one, so it is the closest from there on.
    """
    last = chart.rows[-1].difference_from + 10
    m, n = np.array([(row.stronger_needs, row.weaker_needs) for row in chart.rows]).T
    return win_grid(scale_of(scale), m, n, np.arange(last + 1))
