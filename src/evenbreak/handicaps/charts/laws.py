"""The rules that every chart must follow, including charts from other packages."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from functools import partial
from typing import Any, cast

import numpy as np

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.race_grid import even_doublings
from evenbreak.plugins import broken_of, lawful

AnyChart = Chart | LevelChart | PointsChart


def broken_chart_laws(chart: AnyChart) -> list[str]:
    """Return the rules that a chart breaks, in sentences; empty if it breaks none.

    Its shape is checked when it is made. This function checks that a pair's race is the same seen
    from either side; that no race is easier for the stronger player than one at a smaller
    difference, or for the higher of two levels than its race against a higher one; and that the
    chart can be sent to other processes.

    >>> from evenbreak.handicaps import Chart, chart
    >>> broken_chart_laws(chart("npl_10"))
    []
    >>> broken_chart_laws(Chart("dip", [(0, 9, 5, 5), (10, 19, 5, 3), (20, None, 5, 4)]))
    ['the race in row 3, 5:4, is easier for the stronger player than the race in row 2, 5:3']
    """
    laws = (_it_is_a_value, _races_are_turned_round, _races_get_harder)
    return broken_of(partial(law, chart) for law in laws)


def lawful_chart(chart: Any) -> AnyChart:
    """Return a chart that breaks no rule, or raise an error for the first rule that it breaks."""
    if not isinstance(chart, Chart | LevelChart | PointsChart):
        raise InputError(
            "it must be a Chart, a LevelChart or a PointsChart; it is a {type}",
            type=type(chart).__name__,
        )
    return cast("AnyChart", lawful(chart, broken_chart_laws(chart)))


def _it_is_a_value(chart: AnyChart) -> Iterator[str]:
    if pickle.loads(pickle.dumps(chart)) != chart:  # noqa: S301
        yield "it changes when sent to another process"


def _races_are_turned_round(chart: AnyChart) -> Iterator[str]:
    if isinstance(chart, Chart):
        pairs = [(row.difference_from, -row.difference_from) for row in chart.rows]
        seen = [(chart.race(one), chart.race(other)) for one, other in pairs]
    else:
        pairs = [(one, other) for one in chart.levels for other in chart.levels]
        seen = [(chart.race(one, other), chart.race(other, one)) for one, other in pairs]
    for pair, (race, turned) in zip(pairs, seen, strict=True):
        if race != turned[::-1]:
            yield (
                f"the race at {pair[0]} is {race}, but at {pair[1]} it's {turned}. Make one "
                "the reverse of the other."
            )


def _races_get_harder(chart: AnyChart) -> Iterator[str]:
    if isinstance(chart, Chart):
        needs = np.array([row[2:] for row in chart.rows])
        for k in np.flatnonzero(np.diff(even_doublings(*needs.T)) < -1e-9) + 1:
            (m, n), (m_before, n_before) = needs[k], needs[k - 1]
            yield (
                f"the race in row {k + 1}, {m}:{n}, is easier for the stronger player than the "
                f"race in row {k}, {m_before}:{n_before}"
            )
    elif isinstance(chart, LevelChart):
        needs = np.array(chart.needs)
        even = even_doublings(needs, needs.T)
        for i, j in zip(*np.nonzero(np.diff(even, axis=0) < -1e-9), strict=True):
            low, high, opponent = chart.levels[i], chart.levels[i + 1], chart.levels[j]
            yield (
                f"the race against level {opponent} is easier for level {high} than for level {low}"
            )
