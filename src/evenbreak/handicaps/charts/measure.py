"""How fair the matches of a chart are, and how long they last."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from evenbreak.checks import number_probability, whole
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.match_rules import play_of

_TIE = 1e-9


@dataclass(frozen=True)
class ChartMeasure:
    """How fair the matches of a chart are and how long, over all whole-point differences.

    Each difference from 0 to `up_to` counts alike.

    Parameters
    ----------
    up_to
        the largest difference, in points.
    mean_unfairness, worst_unfairness
        mean and largest `|P(the stronger wins) - target|`. At 0 neither is the stronger, and
        that counts as no unfairness.
    worst_difference
        where it is largest.
    mean_games
        the mean length of a match.
    games_p90
        within how many games 9 of 10 matches end, at whatever difference: the largest of
        their 90 % quantiles.
    """

    up_to: int
    mean_unfairness: float
    worst_unfairness: float
    worst_difference: int
    mean_games: float
    games_p90: int


def last_difference(chart: Chart, play: Any) -> int:
    """Return the last whole-point difference at which the chart's last race favours the stronger.

    That is where the race of the row without an end is even: what a chart was made for.

    >>> from evenbreak.handicaps import chart
    >>> last_difference(chart("npl_8"), "npl")
    52
    """
    row = chart.rows[-1]
    even = float(play_of(play).even_differences([row.stronger_needs], [row.weaker_needs])[0])
    return max(math.floor(even + _TIE), 1)


def measure_chart(
    chart: Chart, play: Any, *, up_to: int | None = None, target: float = 0.5
) -> ChartMeasure:
    """Return how fair a chart's matches are and how long.

    Parameters
    ----------
    chart
        a chart of rating differences.
    play
        what ratings mean and how matches are played, as `design` takes it.
    up_to
        the last difference that counts; None for `last_difference(chart, play)`.
    target
        the chance that the stronger player should have.

    Raises
    ------
    InputError
        if a parameter has a value that it cannot have.

    >>> from evenbreak.handicaps import chart
    >>> measured = measure_chart(chart("npl_10"), "npl")
    >>> round(measured.mean_unfairness, 4), round(measured.worst_unfairness, 4)
    (0.0288, 0.0817)
    >>> round(measured.mean_games, 2), measured.games_p90
    (6.68, 9)
    """
    play = play_of(play)
    target = number_probability(target, "target")
    last = last_difference(chart, play) if up_to is None else whole(up_to, "up_to", at_least=1)
    unfair, mean_games, games_p90 = [], [], 0
    for row in chart.rows:
        end = last if row.difference_to is None else min(last, row.difference_to)
        if row.difference_from > last:
            break
        points = np.arange(row.difference_from, end + 1)
        race = [row.stronger_needs], [row.weaker_needs]
        unfair.append(np.abs(play.win(*race, points)[0] - target))
        mean_games.append(play.mean_games(*race, points)[0])
        games_p90 = max(games_p90, int(play.games_quantile(*row[2:], points, 0.9).max()))
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
