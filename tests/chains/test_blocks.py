"""Many small graphs eliminated at once."""

import numpy as np
import pytest

from evenbreak.chains.factorisation import eliminate_together


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
