"""Wider numbers: laws and visits beyond the range of floats."""

import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import Chain
from evenbreak.chains.decimal_elimination import DecimalElimination, decimal_law


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
