"""The paths found are compared with the cheapest of all paths, listed one by one."""

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from evenbreak.handicaps.charts.candidates import NoChartError, cheapest_path

RACES, DIFFERENCES, EVENS = 4, 4, 2
costs = arrays(float, (RACES, DIFFERENCES), elements=st.integers(0, 20).map(float))
row_limits = st.none() | st.integers(1, 4)


def all_paths(rows=None):
    """Yield every path that starts anywhere and never steps back, nor between even races."""
    for path in product(range(RACES), repeat=DIFFERENCES):
        steps = [(a, b) for a, b in pairwise(path) if a != b]
        if all(b > a and b >= EVENS for a, b in steps) and len(set(path)) <= (rows or RACES):
            yield path


def total(cost, path):
    return sum(cost[race, difference] for difference, race in enumerate(path))


@given(costs, row_limits)
def test_no_path_is_cheaper(cost, rows):
    path = cheapest_path(cost, EVENS, rows).tolist()
    assert tuple(path) in set(all_paths(rows))
    assert total(cost, path) == min(total(cost, other) for other in all_paths(rows))


def test_no_way_through_is_an_error():
    cost = np.zeros((3, 3))
    cost[:, 1] = np.inf
    with pytest.raises(NoChartError, match="more races"):
        cheapest_path(cost, 1)
