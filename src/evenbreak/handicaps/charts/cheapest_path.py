"""The cheapest path through the races of a chart, by dynamic programming over the differences.

In the arrays races go down and differences across. A path has one race for each difference and
never steps back to an easier one; the first `evens` races are all even, and a path has just one
of them. A limit on the rows of the chart limits the different races of its path: the best
total is then kept for each number of rows used so far.
"""

from __future__ import annotations

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.errors import InputError


class NoChartError(InputError):
    """No chart keeps the limits."""


def cheapest_path(cost: Floats, evens: int, rows: int | None = None) -> Ints:
    """Return the path of least total cost, as the place of a race for each difference.

    It has at most `rows` different races; any number of them if that is None.

    Raises
    ------
    NoChartError
        if every path has an infinite cost.
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
