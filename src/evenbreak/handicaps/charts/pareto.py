"""What fairness costs in length: the fairest charts for every length."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import count
from typing import Any, NamedTuple

from evenbreak.checks import one_of, whole
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.charts.cheapest_path import NoChartError
from evenbreak.handicaps.charts.design import races_to_try
from evenbreak.handicaps.charts.match_rules import match_rules
from evenbreak.handicaps.charts.measure import ChartMeasure, last_difference, measure_chart
from evenbreak.handicaps.charts.race_limits import RaceLimits

_TIE = 1e-9
_STEP = 0.5
"""Games between one limit on the mean length and the next."""


@dataclass(frozen=True)
class ParetoChart:
    """One chart of a list, with its unfairness and its length.

    Parameters
    ----------
    chart
        the chart; a designed one is named after its limit ('games_p90 8' or 'mean_games
        6.5'), 'fairest' if it has none, or 'as npl_10' if it is no longer than that chart.
    measure
        how fair and how long it is.
    beaten_by
        the name of the fairest chart of the list that is fairer and no longer, by the mean
        and by the 90% length, or as fair and shorter; None if there is none.
    """

    chart: Chart
    measure: ChartMeasure
    beaten_by: str | None


def pareto(
    rules: Any,
    limits: RaceLimits,
    *,
    beside: Sequence[Chart | str] = (),
    criterion: str = "mean",
    target: float = 0.5,
    up_to: int | None = None,
    rows: int | None = None,
    spread: int | None = None,
    watch: Callable[[int], object] | None = None,
) -> list[ParetoChart]:
    """Return what fairness costs in length: the fairest charts for every length.

    Parameters
    ----------
    rules, limits, target
        as for `design`.
    beside
        printed charts, or their names in `CHARTS`, to place among them. Each is joined by the
        fairest chart within the limits that is no longer, named 'as' with its name.
    criterion
        'mean' or 'worst': which unfairness counts.
    up_to
        the last difference that counts; None for the smallest `last_difference` of the charts
        beside (without any, where the hardest allowed race is even).
    rows
        the most rows of a designed chart; None for any number.
    spread
        how much the longest matches of a designed chart may differ, as for `design`.
    watch
        called after each chart designed, with the number of charts so far.

    Returns
    -------
    list of ParetoChart
        by their mean length, the longest first: the fairest chart of all; the fairest for
        each limit on the 90% length; for limits on the mean length, half a game apart; and
        the charts beside. A designed chart that another one beats is left out.

    Raises
    ------
    InputError
        as `design` does.

    >>> for one in pareto("npl", RaceLimits((5, 7), weaker_least=2), beside=["npl_8"])[:4]:
    ...     found = one.measure
    ...     print(
    ...         one.chart.name,
    ...         round(found.mean_unfairness, 4),
    ...         round(found.mean_games, 2),
    ...         found.games_p90,
    ...         one.beaten_by,
    ...     )
    npl_8 0.0306 5.1 7 fairest
    fairest 0.0297 4.81 7 None
    games_p90 6 0.0424 4.54 6 None
    mean_games 4.5 0.0429 4.46 7 None
    """
    rules, charts = match_rules(rules), [chart_of(chart) for chart in beside]
    criterion = one_of(criterion, "criterion", ("mean", "worst"))
    if up_to is None and charts:
        up_to = min(last_difference(chart, rules) for chart in charts)
    elif up_to is not None:
        up_to = whole(up_to, "up_to", at_least=1)
    candidates = races_to_try(rules, limits, spread, up_to)
    last = int(candidates.points[-1])

    def measured(chart: Chart) -> _Measured:
        return _Measured(chart, measure_chart(chart, rules, up_to=last, target=target))

    designed = count(1)

    def fairest(name: str = "fairest", **most: Any) -> _Measured:
        one = candidates.fairest(target=target, criterion=criterion, rows=rows, name=name, **most)
        if watch is not None:
            watch(next(designed))
        return measured(one)

    made = [fairest(), *_shorter_and_shorter(fairest)]
    printed = [measured(chart) for chart in charts]
    for one in printed:
        with suppress(NoChartError):  # no chart within the limits is that short
            made.append(
                fairest(
                    f"as {one.chart.name}",
                    mean_games=one.measure.mean_games + _TIE,
                    games_p90=one.measure.games_p90,
                )
            )
    every = [*printed, *_without_copies(made)]
    placed = [
        ParetoChart(one.chart, one.measure, _beaten_by(one, every, criterion)) for one in every
    ]
    kept = [one for k, one in enumerate(placed) if k < len(printed) or one.beaten_by is None]
    return sorted(kept, key=lambda one: -one.measure.mean_games)


class _Measured(NamedTuple):
    chart: Chart
    measure: ChartMeasure

    def bad(self, criterion: str) -> tuple[float, float, int]:
        """Return what should be small: unfairness, mean and 90% length."""
        found = self.measure
        unfair = found.mean_unfairness if criterion == "mean" else found.worst_unfairness
        return unfair, found.mean_games, found.games_p90


def _shorter_and_shorter(fairest: Callable[..., _Measured]) -> Iterator[_Measured]:
    """Yield the fairest charts under tighter and tighter limits on either length."""
    longest = fairest().measure
    with suppress(NoChartError):
        games = longest.games_p90
        while True:
            games -= 1
            yield (one := fairest(f"games_p90 {games}", games_p90=games))
            games = min(games, one.measure.games_p90)
    with suppress(NoChartError):
        mean = longest.mean_games
        while True:
            most = _STEP * (math.ceil(mean / _STEP - _TIE) - 1)
            yield (one := fairest(f"mean_games {most:g}", mean_games=most))
            mean = min(most, one.measure.mean_games)


def _without_copies(made: Sequence[_Measured]) -> list[_Measured]:
    """Return the charts, only the first of those with the same rows."""
    return list({tuple(one.chart.rows): one for one in reversed(made)}.values())[::-1]


def _beaten_by(one: _Measured, every: Sequence[_Measured], criterion: str) -> str | None:
    """Return the name of the fairest chart that is better in one respect and worse in none."""
    bad = one.bad(criterion)
    better = [
        (other.bad(criterion), other.chart.name)
        for other in every
        if all(a <= b + _TIE for a, b in zip(other.bad(criterion), bad, strict=True))
        and any(a < b - _TIE for a, b in zip(other.bad(criterion), bad, strict=True))
    ]
    return min(better)[1] if better else None
