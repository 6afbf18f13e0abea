"""The cut of the classes into runs, each solved by its own method."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import factorization
from evenbreak.chains.arcs import arcs_of
from evenbreak.chains.certified import CertifiedSolve
from evenbreak.chains.factorization import Factorization, TriangularSolve, eliminate_together
from evenbreak.errors import AccuracyError


@pytest.mark.parametrize(
    ("small", "spans"),
    [(64, [(0, 9)]), (3, [(0, 4), (4, 9)]), (1, [(0, 1), (1, 4), (4, 9)])],
)
def test_small_classes_between_large_ones_are_taken_together(monkeypatch, small, spans):
    monkeypatch.setattr(factorization, "SMALL", small)
    T = np.zeros((9, 9))
    T[1:4, 1:4] = np.roll(np.eye(3), 1, axis=0) * 0.5
    T[4:, 4:] = np.roll(np.eye(5), 1, axis=0) * 0.5
    T[1, 0] = T[4, 3] = 0.25
    leak = 1.0 - T.sum(axis=0)
    factor = Factorization(arcs_of(csc_array(T)), leak, np.ones(9))
    assert [(piece.first, piece.last) for piece in factor._pieces] == spans
    inverse = np.linalg.inv(np.eye(9) - T)
    b = np.random.default_rng(0).random((9, 2))
    assert factor.visits(b) == pytest.approx(inverse @ b, rel=1e-13)
    assert factor.values(b) == pytest.approx(inverse.T @ b, rel=1e-13)


@pytest.mark.slow
def test_a_line_without_long_doubles_and_a_hub_are_proved(monkeypatch):
    """Equal arcs repeat the same rounding errors, 3,000 times in doubles alone."""
    n = 3000
    T = csc_array(np.diag(np.full(n - 1, 0.5), 1) + np.diag(np.full(n - 1, 0.5), -1))
    leak = np.zeros(n)
    leak[0] = 0.5
    T[0, 1], T[n - 2, n - 1] = 0.5, 1.0
    monkeypatch.setattr(factorization, "_WIDE", False)
    line = Factorization(arcs_of(T), leak, np.ones(n))
    steps = line.values(np.ones((n, 1)))[:, 0]
    assert type(line._pieces[0].solver) is CertifiedSolve
    k = np.arange(1, n + 1)
    assert steps == pytest.approx(k * (2 * n - k), rel=2e-16)
    monkeypatch.setattr(factorization, "_HUB", 100)
    star = np.zeros((600, 600))
    star[0, 1:], star[1:, 0] = 1.0, 0.5 / 599
    star[0, 2:4] = 0.75
    star[1, 2] = star[2, 3] = 0.25
    hub = Factorization(arcs_of(csc_array(star)), np.eye(600)[0] * 0.5, star.sum(axis=0))
    found = hub.visits(np.eye(600, 1))
    assert hub._pieces[0].solver._factors is None
    assert found[0, 0] == pytest.approx(2.0, rel=1e-15)


@pytest.mark.parametrize(
    ("few", "reason"), [(600, "has arcs between most"), (0, "is left too rarely to prove")]
)
def test_a_refusal_says_why_and_what_it_would_take(monkeypatch, few, reason):
    T = np.full((600, 600), 1e-3 if few else 1e-20)
    if not few:
        T[np.arange(600) - 1, np.arange(600)] = T[np.arange(600) - 9, np.arange(600)] = 0.5
        T = np.where(np.abs(np.subtract.outer(np.arange(600), np.arange(600))) % 97 < 9, T, 0.0)
    np.fill_diagonal(T, 0.0)
    monkeypatch.setattr(factorization, "MOST_ENTRIES", 1000)
    monkeypatch.setattr(factorization, "is_dense", lambda *_: few > 0)
    factor = Factorization(arcs_of(csc_array(T)), np.eye(600)[0] * 1e-30, T.sum(axis=0))
    with pytest.raises(AccuracyError, match=rf"600 states {reason}.* numbers .*GB"):
        factor.visits(np.eye(600, 1))


# One substitution through single states and small classes in between.


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
    monkeypatch.setattr(factorization, "_ENTRIES", most)
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


# Many small graphs eliminated at once.


def test_the_factors_multiply_to_the_stack():
    count, size = 4, 5
    A = np.random.default_rng(0).random((size + 1, size, count)) / size
    given = A.copy()
    pivot = eliminate_together(A, size)
    for k in range(count):
        lower = np.eye(size) - np.tril(A[:size, :, k], -1) / pivot[:, k]
        upper = np.eye(size) - np.triu(A[:size, :, k], 1)
        arcs = given[:size, :, k] * (1 - np.eye(size))
        whole = np.diag(arcs.sum(axis=0) + given[size, :, k]) - arcs
        assert lower @ np.diag(pivot[:, k]) @ upper == pytest.approx(whole, abs=1e-14)
