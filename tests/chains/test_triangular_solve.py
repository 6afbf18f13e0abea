"""One substitution through single states and small classes in between."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import factorisation as triangular_solve
from evenbreak.chains.factorisation import TriangularSolve


def test_single_states_and_classes_of_two_and_three_in_turn():
    """Classes {0}, {1, 2}, {3}, {4, 5, 6}, {7}: against a dense inverse."""
    offsets = np.array([0, 1, 3, 4, 7, 8])
    rng = np.random.default_rng(4)
    label = np.repeat(np.arange(5), np.diff(offsets))
    T = rng.random((8, 8)) / 9 * (label[:, None] >= label[None, :])
    np.fill_diagonal(T, 0.0)
    leak = np.full(8, 0.125)
    arcs = csc_array(T).tocoo()
    flow = TriangularSolve((arcs.col, arcs.row, arcs.data), leak, T.sum(axis=0) + leak, offsets)
    inverse = np.linalg.inv(np.diag(T.sum(axis=0) + leak) - T)
    b = rng.random((8, 3))
    assert flow.visits(b) == pytest.approx(inverse @ b, rel=1e-12)
    assert flow.values(b) == pytest.approx(inverse.T @ b, rel=1e-12)


def test_single_states_only():
    sources, targets, chances = np.array([0, 0, 1]), np.array([1, 2, 2]), np.array([0.25, 0.5, 0.5])
    outflow = np.array([0.75, 0.5, 0.125])
    flow = TriangularSolve(
        (sources, targets, chances), np.array([0, 0, 0.125]), outflow, np.arange(4)
    )
    visits = flow.visits(np.array([[0.75], [0.0], [0.0]]))
    assert visits[:, 0] == pytest.approx([1.0, 0.5, 6.0], rel=1e-15)


@pytest.mark.parametrize("most", [1, 8, 10_000])
def test_classes_of_one_size_are_stacked_in_any_number(monkeypatch, most):
    """Sizes 2, 3, 1, 2, 3, 2, each class with arcs to all later ones."""
    monkeypatch.setattr(triangular_solve, "_ENTRIES", most)
    offsets = np.cumsum([0, 2, 3, 1, 2, 3, 2])
    n = offsets[-1]
    rng = np.random.default_rng(5)
    label = np.repeat(np.arange(6), np.diff(offsets))
    T = rng.random((n, n)) / n * (label[:, None] >= label[None, :])
    np.fill_diagonal(T, 0.0)
    leak = np.full(n, 0.125)
    arcs = csc_array(T).tocoo()
    flow = TriangularSolve((arcs.col, arcs.row, arcs.data), leak, T.sum(axis=0) + leak, offsets)
    inverse = np.linalg.inv(np.diag(T.sum(axis=0) + leak) - T)
    b = rng.random((n, 2))
    assert flow.visits(b) == pytest.approx(inverse @ b, rel=1e-12)
    assert flow.values(b) == pytest.approx(inverse.T @ b, rel=1e-12)
