"""All races that a chart may hold, with their chance and length at each difference."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import number_probability, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart, ChartRow
from evenbreak.handicaps.charts.fair import RaceLimits
from evenbreak.handicaps.charts.race_grid import ends_within_grid, even_differences, win_grid
from evenbreak.ratings.scale import Scale
from evenbreak.words import Parameter

_TIE = 1e-12
_MOST_CELLS = 5_000_000
_MOST_CELLS_IN_ROWS = 20_000_000
_HEAVIEST = 1e6
"""The weight that means "never, unless no allowed race does better"."""


class CostedChart(NamedTuple):
    """A chart, and the mean cost that its design minimized."""

    cost: float
    chart: Chart


class Candidates:
    """The races within limits, ordered from the easiest for the stronger player to the hardest.

    The first `evens` of them are even races, from shortest to longest; each later race is even at a
    larger difference than the one before it. Raises InputError if `up_to` is not a positive whole
    number, or if there are too many races to try.
    """

    def __init__(self, scale: Scale, limits: RaceLimits, up_to: int | None = None) -> None:
        self.scale, self.limits = scale, limits
        m, n = np.array(limits.races).T
        even = even_differences(scale, m, n)
        last = (
            max(math.floor(even.max() + _TIE), 1)
            if up_to is None
            else whole(up_to, "up_to", at_least=1)
        )
        if m.size * (last + 1) > _MOST_CELLS:
            raise InputError(
                "{races} races at {differences} differences are too many to try. Narrow "
                "{games}, raise {weaker_least}, or lower {up_to}.",
                races=m.size,
                differences=last + 1,
                games=Parameter("games"),
                weaker_least=Parameter("weaker_least"),
                up_to=Parameter("up_to"),
            )
        order = np.lexsort((m + n, np.where(m == n, -np.inf, even)))
        self.m, self.n, self.points = m[order], n[order], np.arange(last + 1)
        self.evens = int((m == n).sum())

    @cached_property
    def wins(self) -> Floats:
        """P(the stronger player wins), shape (races, differences)."""
        return win_grid(self.scale, self.m, self.n, self.points)

    def fairest(self, **wishes: Any) -> Chart:
        """Return the fairest chart made of these races, like `design`; parameters as for `best`."""
        return self.best(**wishes).chart

    def best(
        self,
        *,
        target: float = 0.5,
        tilt: float = 0.5,
        rows: int | None = None,
        name: str = "design",
    ) -> CostedChart:
        """Return the fairest chart of these races and its cost; parameters as for `design`."""
        cost = self._within_limits(
            self._cost(number_probability(target, "target"), number_probability(tilt, "tilt"))
        )
        path = cheapest_path(cost, self.evens, self._row_limit(rows))
        return CostedChart(float(cost[path, np.arange(path.size)].mean()), self._chart(path, name))

    def nearest(self, name: str) -> Chart:
        """Return the chart with the race closest to 1/2 at each difference (`nearest_chart`)."""
        cost = self._cost(0.5, 0.5)
        cost[: self.evens - 1] = np.inf
        return self._chart(self._within_limits(cost).argmin(axis=0), name)

    def _row_limit(self, rows: Any) -> int | None:
        """Return the limit on rows, or None if no chart of these races could exceed it."""
        if rows is None:
            return None
        most = whole(rows, "rows", at_least=1)
        if most >= min(self.points.size, self.m.size - self.evens + 1):
            return None
        cells = self.m.size * self.points.size
        if most * cells > _MOST_CELLS_IN_ROWS:
            raise InputError(
                "{rows} is {most}, and {races} races at {differences} differences are "
                "too many to try for each number of rows. Narrow {games}, lower {rows} or {up_to}.",
                rows=Parameter("rows"),
                most=most,
                races=self.m.size,
                differences=self.points.size,
                games=Parameter("games"),
                up_to=Parameter("up_to"),
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

    def _within_limits(self, cost: Floats) -> Floats:
        """Return the costs; infinite where more than 1 match in 10 ends too late."""
        games = self.limits.games_p90
        if games is None:
            return cost
        ended = ends_within_grid(self.scale, self.m, self.n, self.points, games)
        short = ended >= 0.9 - _TIE
        if not short.any(axis=0).all() or not short[: self.evens, 0].any():
            nowhere = int(self.points[~short.any(axis=0)][0]) if short[: self.evens, 0].any() else 0
            raise NoChartError(
                "{games_p90} is {games}, but at a difference of {nowhere} no allowed race ends "
                "within that many games in 9 matches out of 10. Give a larger number, or allow "
                "shorter races.",
                games_p90=Parameter("games_p90"),
                games=games,
                nowhere=nowhere,
            )
        return np.where(short, cost, np.inf)

    def _chart(self, path: Ints, name: str) -> Chart:
        """Return the chart whose race at each difference is given by its place in the list."""
        runs = [(place, len(list(run))) for place, run in groupby(path.tolist())]
        rows, start = [], 0
        for place, count in runs:
            rows.append(ChartRow(start, start + count - 1, int(self.m[place]), int(self.n[place])))
            start += count
        rows[-1] = rows[-1]._replace(difference_to=None)
        return Chart(name, rows)


# The cheapest path through the races of a chart, by dynamic programming over the differences.
#
# In the arrays races go down and differences across. A path has one race for each difference and
# never steps back to an easier one; the first `evens` races are all even, and a path has just one
# of them. A limit on the rows of the chart limits the different races of its path: the best
# total is then kept for each number of rows used so far.


class NoChartError(InputError):
    """No chart satisfies the limits."""


def cheapest_path(cost: Floats, evens: int, rows: int | None = None) -> Ints:
    """Return the path with the lowest total cost, as the position of a race for each difference.

    It has at most `rows` different races, or any number if that is None. Raises NoChartError if
    every path has an infinite cost.
    """
    races, differences = cost.shape
    best = np.empty((differences, rows or 1, races))  # in that many rows, or fewer
    best[0] = cost[:, 0]
    for d in range(1, differences):
        easier = np.minimum.accumulate(best[d - 1], axis=1)
        if rows is not None:  # a step to another race begins a row
            easier[1:] = easier[:-1].copy()
            easier[0] = np.inf
        easier[:, :evens] = np.inf  # no steps between even races: none is harder
        best[d] = np.minimum(best[d - 1], easier) + cost[:, d]
    path = np.empty(differences, dtype=np.int64)
    left = 0 if rows is None else rows - 1
    path[-1] = here = int(best[-1, left].argmin())
    if not np.isfinite(best[-1, left, here]):
        more = "more races" if rows is None else "more races, or more rows"
        raise NoChartError(
            "no chart within these limits has races that get harder as the difference "
            "grows. Allow longer matches or {more}.",
            more=more,
        )
    for d in range(differences - 1, 0, -1):
        if here >= evens and (rows is None or left > 0):
            fewer = left if rows is None else left - 1
            easiest = int(best[d - 1, fewer, : here + 1].argmin())
            if best[d - 1, fewer, easiest] <= best[d - 1, left, here]:
                here, left = easiest, fewer
        path[d - 1] = here
    return path


# Races of similar length: a chart as leagues print it does not jump from 3:3 to 8:7.
#
# The longest matches of the National Pool League's chart 10 have 7 to 9 games, those of chart 20
# have 17 to 19. So the races that limits allow are taken in groups whose longest matches differ
# by no more than a few games, and the fairest chart is the fairest that any group makes.


def similar_limits(limits: RaceLimits, spread: Any) -> list[RaceLimits]:
    """Return limits for each group of races whose longest matches differ by at most `spread`.

    >>> [alike.games for alike in similar_limits(RaceLimits((5, 9)), 2)]
    [(5, 7), (6, 8), (7, 9)]
    """
    spread, (low, high) = whole(spread, "spread"), limits.games
    groups = []
    for first in range(low, max(low, high - spread) + 1):
        try:
            groups.append(replace(limits, games=(first, min(first + spread, high))))
        except InputError:  # no even race is that long
            continue
    if not groups:
        raise InputError(
            "{spread} is {value}, which leaves no even race. Give 1 or more.", value=spread
        )
    return groups


class SimilarLengths:
    """The races within limits, in groups whose longest matches differ by at most `spread` games.

    Without `up_to`, all groups go up to the difference at which the hardest race in any group is
    even.
    """

    def __init__(
        self, scale: Scale, limits: RaceLimits, spread: Any, up_to: int | None = None
    ) -> None:
        self.points: Ints = Candidates(scale, limits, up_to).points
        last = int(self.points[-1])
        self.groups = [Candidates(scale, alike, last) for alike in similar_limits(limits, spread)]

    def fairest(self, *, name: str = "design", **wishes: Any) -> Chart:
        """Return the fairest chart from any of the groups, as `Candidates.fairest` does."""
        charts, refused = [], []
        for group in self.groups:
            try:
                charts.append(group.best(name=name, **wishes))
            except NoChartError as error:
                refused.append(error)
        if not charts:
            raise refused[0]  # that of the shortest races, whose remedy goes furthest
        return min(charts, key=lambda costed: costed.cost).chart
