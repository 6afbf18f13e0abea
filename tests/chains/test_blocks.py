"""Many small classes eliminated at once."""

import numpy as np
import pytest

from evenbreak.chains import blocks
from evenbreak.chains.blocks import eliminate_stack, stacks


def test_classes_are_stacked_by_size_and_not_too_many_at_once(monkeypatch):
    monkeypatch.setattr(blocks, "_ENTRIES", 8)
    found = [(size, classes.tolist()) for size, classes in stacks(np.array([1, 2, 3, 2, 1, 2]))]
    assert found == [(2, [1, 3]), (2, [5]), (3, [2])]


def test_the_factors_multiply_to_the_stack():
    rng = np.random.default_rng(0)
    count, size = 4, 5
    W = rng.random((count, size + 1, size)) / size
    given = W.copy()
    first = np.arange(count) * size
    factors = eliminate_stack(W, first)
    n = count * size
    lower, upper = np.eye(n), np.eye(n)
    column, row, value = factors.onward
    lower[row, column] = -value
    column, row, value = factors.back
    upper[row, column] = -value
    product = lower @ np.diag(factors.pivot) @ upper
    for k in range(count):
        here = slice(k * size, (k + 1) * size)
        arcs = given[k, :size] * (1 - np.eye(size))
        whole = np.diag(arcs.sum(axis=0) + given[k, size]) - arcs
        assert product[here, here] == pytest.approx(whole, abs=1e-14)
    assert (np.concatenate((factors.pivot, factors.onward[2], factors.back[2])) > 0).all()
