"""The paths found are compared with the cheapest of all paths, listed one by one."""

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from evenbreak.handicaps.charts.cheapest_path import (
    NoChartError,
    cheapest_within,
    without_the_worst,
)

RACES, DIFFERENCES, EVENS = 4, 4, 2
costs = arrays(float, (RACES, DIFFERENCES), elements=st.integers(0, 20).map(float))
row_limits = st.none() | st.integers(1, 4)


def all_paths(rows=None):
    """Yield every path that starts anywhere and never steps back, nor between even races."""
    for path in product(range(RACES), repeat=DIFFERENCES):
        steps = [(a, b) for a, b in pairwise(path) if a != b]
        if all(b > a and b >= EVENS for a, b in steps) and len(set(path)) <= (rows or RACES):
            yield path


def total(values, path):
    return sum(values[race, difference] for difference, race in enumerate(path))


@given(costs, row_limits)
def test_no_path_is_cheaper(cost, rows):
    path = cheapest_within(cost, np.zeros_like(cost), EVENS, np.inf, rows).tolist()
    assert tuple(path) in set(all_paths(rows))
    assert total(cost, path) == min(total(cost, other) for other in all_paths(rows))


@given(costs, costs, st.integers(0, 60), row_limits)
def test_a_path_within_a_budget_is_the_cheapest_of_all_that_are_no_longer(
    cost, length, budget, rows
):
    shortest = min(total(length, path) for path in all_paths(rows))
    try:
        path = cheapest_within(cost, length, EVENS, budget / DIFFERENCES, rows).tolist()
    except NoChartError:
        assert shortest > budget
        return
    long = total(length, path)
    assert long <= budget
    no_longer = [other for other in all_paths(rows) if total(length, other) <= long]
    assert total(cost, path) == min(total(cost, other) for other in no_longer)


@given(costs, row_limits)
def test_what_is_left_has_the_least_largest_cost(cost, rows):
    left = without_the_worst(cost, np.zeros_like(cost), EVENS, np.inf, rows)

    def worst(path):
        return max(cost[race, difference] for difference, race in enumerate(path))

    least = min(map(worst, all_paths(rows)))
    assert left[np.isfinite(left)].max() == least
    assert (left == np.where(cost <= least, cost, np.inf)).all()


def test_no_way_through_is_an_error():
    cost = np.zeros((3, 3))
    cost[:, 1] = np.inf
    with pytest.raises(NoChartError, match="more races"):
        cheapest_within(cost, cost, 1, np.inf)
