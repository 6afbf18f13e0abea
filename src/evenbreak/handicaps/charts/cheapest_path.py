"""The cheapest path through the races of a chart, by dynamic programming over the differences.

In the arrays races go down and differences across. A path has one race for each difference and
never steps back to an easier one; the first `evens` races are all even, and a path has just one
of them. A limit on the rows of the chart limits the different races of its path: the best
total is then kept for each number of rows used so far.
"""

from __future__ import annotations

import math

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.errors import InputError


class NoChartError(InputError):
    """No chart keeps the limits."""


def _cheapest(cost: Floats, evens: int, rows: int | None) -> Ints:
    """Return the path of least total cost, as the place of a race for each difference.

    It has at most `rows` different races; any number of them if that is None.
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
            "no chart within these limits has races that get harder as the difference grows; "
            f"allow longer matches or {more}"
        )
    for d in range(differences - 1, 0, -1):
        if here >= evens and (rows is None or left > 0):
            fewer = left if rows is None else left - 1
            easiest = int(best[d - 1, fewer, : here + 1].argmin())
            if best[d - 1, fewer, easiest] <= best[d - 1, left, here]:
                here, left = easiest, fewer
        path[d - 1] = here
    return path


def _mean(values: Floats, path: Ints) -> float:
    return float(values[path, np.arange(path.size)].mean())


def cheapest_within(
    cost: Floats, length: Floats, evens: int, budget: float, rows: int | None = None
) -> Ints:
    """Return a path within a budget for the mean length, the cheapest of all no longer than it.

    Each game is given a price, the lowest at which the cheapest path keeps the budget. `rows`
    limits the number of different races; None: no limit.
    """
    path = _cheapest(cost, evens, rows)
    if _mean(length, path) <= budget:
        return path
    price, path = math.inf, _cheapest(length, evens, rows)
    shortest = _mean(length, path)
    if shortest > budget:
        raise NoChartError(
            f"mean_games is {budget:g}, but the shortest chart within the limits has a mean of "
            f"{shortest:.2f} games; give that or more, or allow shorter races"
        )
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = high if price == math.inf else (low + high) / 2.0
        tried = _cheapest(np.where(np.isfinite(cost), cost + middle * length, np.inf), evens, rows)
        if _mean(length, tried) <= budget:
            price = high = middle
            path = tried
        elif price == math.inf:
            low, high = high, 4.0 * high
        else:
            low = middle
    return path


def without_the_worst(
    cost: Floats, length: Floats, evens: int, budget: float, rows: int | None = None
) -> Floats:
    """Return the costs, made infinite where they exceed the smallest possible largest cost."""
    levels = np.unique(cost[np.isfinite(cost)])
    low, high = 0, len(levels) - 1
    while low < high:
        middle = (low + high) // 2
        if _keeps(np.where(cost <= levels[middle], length, np.inf), evens, budget, rows):
            high = middle
        else:
            low = middle + 1
    return np.where(cost <= levels[low], cost, np.inf)


def _keeps(length: Floats, evens: int, budget: float, rows: int | None) -> bool:
    try:
        return _mean(length, _cheapest(length, evens, rows)) <= budget
    except NoChartError:
        return False
