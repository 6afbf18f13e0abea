"""Conjugate gradients, against the dense inverse."""

import numpy as np
import pytest
from scipy import sparse

from evenbreak.errors import AccuracyError
from evenbreak.ratings.conjugate_gradients import energies, solve_unit


def league(kind, rng, players=120):
    """Return a scaled Hessian of ratings: a Laplacian with a prior, of unit diagonal."""
    size = {"mixed": players, "clubs": 12}.get(kind, 2)
    a = rng.integers(0, players, 900)
    b = a - a % size + rng.integers(0, size, 900)
    if kind == "chain":
        a, b = np.arange(players - 1), np.arange(1, players)
    weight = np.where(a == b, 0.0, rng.exponential(2.0, len(a)))
    matrix = np.zeros((players, players))
    np.add.at(matrix, (a, b), -weight)
    np.add.at(matrix, (b, a), -weight)
    # A single match a pair of clubs joins them, as tightly as one game.
    for k in range(0, players - size, size):
        matrix[k, k + size] -= 0.25
        matrix[k + size, k] -= 0.25
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, 0.3 - matrix.sum(1))
    scale = 1.0 / np.sqrt(np.diagonal(matrix))
    return matrix * scale[:, None] * scale


@pytest.mark.parametrize("kind", ["mixed", "clubs", "chain"])
@pytest.mark.parametrize("accuracy", [1e-4, 1e-6])
def test_energies_are_those_of_the_inverse(kind, accuracy):
    """The worst of many columns, most of them between players of different clubs."""
    rng = np.random.default_rng(5)
    matrix = league(kind, rng)
    ends = rng.integers(0, len(matrix), (2, 200))
    right = np.zeros((len(matrix), 200))
    right[ends[0], np.arange(200)] += 1.0
    right[ends[1], np.arange(200)] -= 1.0
    exact = np.einsum("ij,ij->j", right, np.linalg.solve(matrix, right))
    found = energies(sparse.csr_array(matrix), right, accuracy)
    assert np.abs(found - exact).max() <= 5.0 * accuracy * exact.max()


def test_a_column_of_its_own_direction_takes_one_step():
    assert energies(np.eye(3), np.array([[2.0, 0.0], [0.0, 0.0], [0.0, 0.0]]), 1e-6).tolist() == [
        4.0,
        0.0,
    ]


def test_a_chain_that_a_weak_prior_hardly_holds_is_solved_all_the_same():
    """Its condition is 2e8, so that it takes more steps than it has players."""
    size = 400
    weight = 10.0 ** np.random.default_rng(1).uniform(-3, 0, size - 1)
    matrix = np.diag(np.append(weight, 0.0) + np.append(0.0, weight) + 1e-8)
    matrix -= np.diag(weight, 1) + np.diag(weight, -1)
    scale = 1.0 / np.sqrt(np.diagonal(matrix))
    unit, right = matrix * scale[:, None] * scale, np.zeros((size, 1))
    right[[0, -1], 0] = scale[[0, -1]] * [1.0, -1.0]
    found = solve_unit(sparse.csr_array(unit), right, 1e-12)
    np.testing.assert_allclose(found, np.linalg.solve(unit, right), rtol=1e-6)


def test_what_has_no_solution_is_refused():
    with pytest.raises(AccuracyError, match="smaller prior_sd"):
        solve_unit(np.ones((2, 2)), np.array([[1.0], [-1.0]]), 1e-6)
