"""The cheapest way through the races of a chart, by dynamic programming over the differences.

Races go down, differences across. A path holds one race for each difference and never steps
back to an easier one; the first `evens` races are all even, and a path holds one of them.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import InputError

__all__ = ["NoChartError", "cheapest_within", "without_the_worst"]

Floats = NDArray[np.float64]


class NoChartError(InputError):
    """No chart keeps the limits."""


def _cheapest(cost: Floats, evens: int) -> NDArray[np.int64]:
    """Return the path of the least total cost, of no step back; a place for each difference."""
    best = np.empty(cost.shape[::-1])
    best[0] = cost[:, 0]
    for d in range(1, len(best)):
        before = np.minimum.accumulate(best[d - 1])
        before[:evens] = best[d - 1, :evens]  # of even races none is harder: no step between
        best[d] = before + cost[:, d]
    path = np.empty(len(best), dtype=np.int64)
    path[-1] = best[-1].argmin()
    if not np.isfinite(best[-1, path[-1]]):
        raise NoChartError(
            "no chart keeps these limits with races that get harder as the difference grows; "
            "allow longer matches or more races"
        )
    for d in range(len(best) - 1, 0, -1):
        here = path[d]
        path[d - 1] = here if here < evens else best[d - 1, : here + 1].argmin()
    return path


def _mean(values: Floats, path: NDArray[np.int64]) -> float:
    return float(values[path, np.arange(path.size)].mean())


def cheapest_within(cost: Floats, length: Floats, evens: int, budget: float) -> NDArray[np.int64]:
    """Return the cheapest path among all no longer than itself, its mean length in the budget.

    With a price on each game the cheapest path of all is such a path; the price is the
    least at which it keeps the budget.
    """
    path = _cheapest(cost, evens)
    if _mean(length, path) <= budget:
        return path
    price, path = math.inf, _cheapest(length, evens)
    shortest = _mean(length, path)
    if shortest > budget:
        raise NoChartError(
            f"mean_games is {budget:g}, and the shortest chart that keeps the limits has a mean "
            f"of {shortest:.2f} games; give so many or more, or allow shorter races"
        )
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = high if price == math.inf else (low + high) / 2.0
        tried = _cheapest(np.where(np.isfinite(cost), cost + middle * length, np.inf), evens)
        if _mean(length, tried) <= budget:
            price = high = middle
            path = tried
        elif price == math.inf:
            low, high = high, 4.0 * high
        else:
            low = middle
    return path


def without_the_worst(cost: Floats, length: Floats, evens: int, budget: float) -> Floats:
    """Return the costs with those above the least possible largest cost made infinite."""
    levels = np.unique(cost[np.isfinite(cost)])
    low, high = 0, len(levels) - 1
    while low < high:
        middle = (low + high) // 2
        if _keeps(np.where(cost <= levels[middle], length, np.inf), evens, budget):
            high = middle
        else:
            low = middle + 1
    return np.where(cost <= levels[low], cost, np.inf)


def _keeps(length: Floats, evens: int, budget: float) -> bool:
    try:
        return _mean(length, _cheapest(length, evens)) <= budget
    except NoChartError:
        return False
