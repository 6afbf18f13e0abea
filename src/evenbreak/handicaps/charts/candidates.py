"""All races that a chart may hold, with the chance and length of each at each difference."""

from __future__ import annotations

import math
from functools import cached_property
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.checks import number_probability, one_of, positive, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.cheapest_path import (
    NoChartError,
    cheapest_within,
    without_the_worst,
)
from evenbreak.handicaps.charts.match_rules import MatchRules
from evenbreak.handicaps.charts.race_limits import RaceLimits
from evenbreak.handicaps.charts.rows import ChartRow

_TIE = 1e-12
_MOST_CELLS = 5_000_000
_MOST_CELLS_IN_ROWS = 20_000_000
_MOST_ONE_BY_ONE = 400
_HEAVIEST = 1e6
"""The weight that means 'never, unless no allowed race does better'."""


class CostedChart(NamedTuple):
    """A chart with what its design made as small as possible: the largest cost, then the mean."""

    cost: tuple[float, float]
    chart: Chart


class Candidates:
    """The races within limits, the easiest for the stronger player first.

    The first `evens` of them are even races, the shortest first; each of the others is even at
    a larger difference than the one before.

    Parameters
    ----------
    rules, limits, up_to
        as for `design`.

    Raises
    ------
    InputError
        if `up_to` is not a whole number from 1 up, or there are too many races to try.

    >>> candidates = Candidates(MatchRules("npl"), RaceLimits((3, 5), weaker_least=2), 30)
    >>> list(zip(candidates.m.tolist(), candidates.n.tolist())), candidates.evens
    ([(2, 2), (3, 3), (3, 2), (4, 2)], 2)
    """

    def __init__(self, rules: MatchRules, limits: RaceLimits, up_to: int | None = None) -> None:
        self.rules, self.limits = rules, limits
        m, n = np.array(limits.races).T
        if not rules.is_plain and m.size > _MOST_ONE_BY_ONE:
            raise InputError(
                f"games is {limits.games!r}, which makes {m.size} races; if they are won by more "
                f"than 1, or the break matters, the most is {_MOST_ONE_BY_ONE}: narrow games"
            )
        even = rules.even_differences(m, n)
        last = (
            max(math.floor(even.max() + _TIE), 1)
            if up_to is None
            else whole(up_to, "up_to", at_least=1)
        )
        if m.size * (last + 1) > _MOST_CELLS:
            raise InputError(
                f"{m.size} races at {last + 1} differences are too many to try; narrow games, "
                "raise the fewest games of the weaker player, or lower up_to"
            )
        order = np.lexsort((m + n, np.where(m == n, -np.inf, even)))
        self.m, self.n, self.points = m[order], n[order], np.arange(last + 1)
        self.evens = int((m == n).sum())

    @cached_property
    def wins(self) -> Floats:
        """P(the stronger player wins), shape (races, differences)."""
        return self.rules.win(self.m, self.n, self.points)

    @cached_property
    def mean_games(self) -> Floats:
        """The mean length in games, shape (races, differences)."""
        return self.rules.mean_games(self.m, self.n, self.points)

    def fairest(self, **wishes: Any) -> Chart:
        """Return the fairest chart of these races, as `design` does; parameters as for `best`."""
        return self.best(**wishes).chart

    def best(
        self,
        *,
        target: float = 0.5,
        tilt: float = 0.5,
        criterion: str = "mean",
        mean_games: float | None = None,
        games_p90: int | None = None,
        rows: int | None = None,
        name: str = "design",
    ) -> CostedChart:
        """Return the fairest chart of these races, and its cost.

        Parameters
        ----------
        games_p90
            a limit on the 90% length, in addition to that of the limits.

        The others are those of `design`.
        """
        target, tilt = number_probability(target, "target"), number_probability(tilt, "tilt")
        criterion = one_of(criterion, "criterion", ("mean", "worst"))
        budget = math.inf if mean_games is None else positive(mean_games, "mean_games")
        rows = self._row_limit(rows)
        cost = self._cost(target, tilt)
        for most in {self.limits.games_p90, games_p90} - {None}:
            cost = np.where(self._short_enough(most), cost, np.inf)
        length = self.mean_games if budget < math.inf else np.zeros_like(cost)
        length = np.where(np.isfinite(cost), length, np.inf)
        if criterion == "worst":
            cost = without_the_worst(cost, length, self.evens, budget, rows)
        path = cheapest_within(cost, length, self.evens, budget, rows)
        paid = cost[path, np.arange(path.size)]
        worst = float(paid.max()) if criterion == "worst" else 0.0
        return CostedChart((worst, float(paid.mean())), self._chart(path, name))

    def nearest(self, name: str) -> Chart:
        """Return the chart with the race nearest 1/2 at each difference (`nearest_chart`)."""
        cost = self._cost(0.5, 0.5)
        cost[: self.evens - 1] = np.inf
        if self.limits.games_p90 is not None:
            cost = np.where(self._short_enough(self.limits.games_p90), cost, np.inf)
        return self._chart(cost.argmin(axis=0), name)

    def _row_limit(self, rows: Any) -> int | None:
        """Return the limit on the rows; None where no chart of these races could exceed it."""
        if rows is None:
            return None
        most = whole(rows, "rows", at_least=1)
        if most >= min(self.points.size, self.m.size - self.evens + 1):
            return None
        cells = self.m.size * self.points.size
        if most * cells > _MOST_CELLS_IN_ROWS:
            raise InputError(
                f"rows is {most}, and {self.m.size} races at {self.points.size} differences are "
                "too many to try for each number of rows; narrow games, lower rows or up_to"
            )
        return most

    def _cost(self, target: float, tilt: float) -> Floats:
        above = self.wins - target
        over, under = (
            min(0.5 / share, _HEAVIEST) if share else _HEAVIEST for share in (1.0 - tilt, tilt)
        )
        cost = np.where(above > 0.0, over * above, under * np.maximum(-above - _TIE, 0.0))
        cost[:, 0] = np.where(np.arange(self.m.size) < self.evens, 0.0, np.inf)
        return cost

    def _short_enough(self, games: Any) -> Bools:
        """Return at which differences each race ends within `games` in 9 of 10 matches."""
        short = self.rules.ends_within(self.m, self.n, self.points, games) >= 0.9 - _TIE
        if not short.any(axis=0).all() or not short[: self.evens, 0].any():
            nowhere = int(self.points[~short.any(axis=0)][0]) if short[: self.evens, 0].any() else 0
            raise NoChartError(
                f"games_p90 is {games}, but at a difference of {nowhere} no allowed race ends "
                "within that in 9 of 10 matches; give more, or allow shorter races"
            )
        return np.asarray(short)

    def _chart(self, path: Ints, name: str) -> Chart:
        """Return the chart with, at each difference, the race at that place of the list."""
        runs = [(place, len(list(run))) for place, run in groupby(path.tolist())]
        rows, start = [], 0
        for place, count in runs:
            rows.append(ChartRow(start, start + count - 1, int(self.m[place]), int(self.n[place])))
            start += count
        rows[-1] = rows[-1]._replace(difference_to=None)
        return Chart(name, rows)
