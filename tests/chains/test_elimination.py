"""Elimination in plain Python, for floats, fractions and decimal numbers."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import Chain
from evenbreak.chains.elimination import DecimalElimination, Elimination, decimal_law
from evenbreak.errors import AccuracyError

HALF = Fraction(1, 2)


def test_fractions_stay_exact():
    rows = [{1: HALF, 2: HALF / 2}, {0: Fraction(1, 3)}, {0: HALF, 1: HALF}]
    leaks = [HALF / 2, Fraction(2, 3), Fraction(0)]
    factor = Elimination(rows, leaks)
    x = factor.visits([Fraction(1), 0, 0])
    assert x == [Fraction(3, 2), Fraction(15, 16), Fraction(3, 8)]
    assert sum(leak * visits for leak, visits in zip(leaks, x, strict=True)) == 1
    assert factor.values([1, 1, 1])[0] == sum(x)


def test_the_states_of_a_star_are_eliminated_before_its_center():
    n = 2_000
    rows = [dict.fromkeys(range(1, n), 0.5 / n), *({0: 0.5} for _ in range(n - 1))]
    factor = Elimination(rows, [0.0] * (n - 1) + [0.5], most=2 * n)
    assert factor.visits([1.0] + [0.0] * (n - 1))[0] > 0


def test_too_much_work_is_refused():
    rows = [dict.fromkeys((i for i in range(30) if i != j), 0.01) for j in range(30)]
    with pytest.raises(AccuracyError, match="too many to eliminate"):
        Elimination(rows, [0.1] * 30, most=1_000)


def test_a_core_with_many_arcs_is_left_to_a_solver_of_its_own():
    """A line of ten states leads into six that are all joined, and back."""
    n, tenth = 16, Fraction(1, 10)
    rows = [{j + 1: 5 * tenth, j - 1: 4 * tenth} for j in range(1, 10)]
    rows = [{1: 5 * tenth}, *rows]
    rows += [{i: tenth for i in range(9, n) if i != j} for j in range(10, n)]
    leaks = [1 - sum(row.values()) for row in rows]
    cores = []

    def core(arcs, leaks):
        cores.append(Elimination(arcs, leaks))
        return cores[-1]

    in_two = Elimination([row.copy() for row in rows], leaks, most=30, core=core)
    whole = Elimination(rows, leaks)
    b = [Fraction(j % 3) for j in range(n)]
    assert len(cores[0].steps) == 6
    assert in_two.visits(b) == whole.visits(b)
    assert in_two.values(b) == whole.values(b)


def test_a_law_beyond_all_floats_sums_to_one():
    """A cycle that is left at each state with 1e-100 only, but never forward from the last."""
    n = 8
    matrix = np.roll(np.eye(n), 1, axis=0) * 1e-100
    matrix[0, 1:] += 0.5
    law = decimal_law(Chain(range(n), oracle.with_loops(csc_array(matrix))).arcs)
    assert law[0] == pytest.approx(1.0, rel=1e-15)
    assert law[1:4] == pytest.approx([2e-100, 4e-200, 8e-300], rel=1e-14)
    assert not law[5:].any()


def test_visits_beyond_all_floats_are_infinite():
    matrix = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1e-320, 0.0, 1.0]])
    arcs, leak = Chain(range(3), csc_array(matrix)).arcs.among(np.array([0, 1]))
    x = DecimalElimination(arcs, leak).visits(np.array([[1.0], [0.0]]))
    assert np.isinf(x).all()
