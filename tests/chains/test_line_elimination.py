"""Lines of states: found in any order, and solved against exact arithmetic and known laws."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array

import oracle
from evenbreak.chains.birth_death import LineElimination, line_order
from rows import each_of


def line(n, shuffle):
    T = np.zeros((n, n))
    i = np.arange(n - 1)
    T[i + 1, i], T[i, i + 1] = 0.25, 0.5
    place = np.random.default_rng(shuffle).permutation(n)
    return csc_array(T[place][:, place]), place


@pytest.mark.parametrize("shuffle", range(3))
def test_a_line_is_found_from_one_end_to_the_other(shuffle):
    T, place = line(50, shuffle)
    order = place[line_order(T)].tolist()
    assert order in (list(range(50)), list(range(49, -1, -1)))


def test_what_has_two_ends_but_is_no_line():
    T = np.zeros((5, 5))
    for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (3, 0), (1, 4), (4, 1), (2, 1)):
        T[b, a] = 0.25
    assert line_order(csc_array(T)) is None
    assert line_order(csc_array(np.ones((4, 4)) - np.eye(4))) is None


@each_of("n", [1, 2, 3, 4, 5, 8, 13, 32])
@each_of("decades", [0.5, 12])
def test_both_solves(n, decades):
    rng = np.random.default_rng(n)
    up, down = 10.0 ** -rng.uniform(0.4, decades, (2, n - 1))
    leak = np.where(rng.random(n) < 0.4, 10.0 ** -rng.uniform(2, 14, n), 0.0)
    leak[rng.integers(n)] = 1e-13
    b = np.where(rng.random((n, 2)) < 0.6, rng.random((n, 2)), 0.0)
    matrix = [[Fraction(0)] * n for _ in range(n)]
    for k in range(n - 1):
        matrix[k + 1][k], matrix[k][k + 1] = -Fraction(up[k]), -Fraction(down[k])
    for k in range(n):
        matrix[k][k] = Fraction(leak[k]) - sum(matrix[i][k] for i in range(n) if i != k)
    order = rng.permutation(n)
    place = np.argsort(order)
    line = csc_array(diags_array([up, down], offsets=[-1, 1], shape=(n, n)))[order][:, order]
    found = LineElimination(csc_array(line), leak[order], place)
    transposed = [list(row) for row in zip(*matrix, strict=True)]
    for column in range(2):
        right = [Fraction(x) for x in b[:, column].tolist()]
        visits = found.visits(b[order])[place, column]
        values = found.values(b[order])[place, column]
        assert oracle.worst_relative_error(visits, oracle.solve(matrix, right)) < 2e-15
        assert oracle.worst_relative_error(values, oracle.solve(transposed, right)) < 2e-15


def test_a_long_line_of_equal_arcs_keeps_twelve_digits():
    """Steps up with 0.49, down with 0.51, left at the bottom: each step down takes 50."""
    n, up, down = 20_000, 0.49, 0.51
    leak = np.zeros(n)
    leak[0] = down
    leak[-1] = up
    T = diags_array([np.full(n - 1, up), np.full(n - 1, down)], offsets=[-1, 1])
    found = LineElimination(csc_array(T), leak, np.arange(n))
    steps = found.values(np.ones((n, 1)))[:, 0]
    drift = Fraction(down) - Fraction(up)
    for k in (0, 99, 9_999):
        # The top is so far that the chance to reach it is below 1e-170.
        assert steps[k] == pytest.approx(float((k + 1) / drift), rel=1e-13)
