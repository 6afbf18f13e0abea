"""The sparse factorisation: certified where it can be, and refused where it is worthless."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains.elimination import Elimination
from evenbreak.chains.sparse_lu import SparseFactorisation
from evenbreak.errors import AccuracyError


def coupled(chance, size=30):
    """Return a jump chain of two dense blocks, joined by `chance` each way, and its leak."""
    rng = np.random.default_rng(7)
    n = 2 * size
    T = np.zeros((n, n))
    T[:size, :size], T[size:, size:] = rng.random((2, size, size))
    np.fill_diagonal(T, 0.0)
    T /= T.sum(axis=0)
    T[:, 0] *= 1 - chance
    T[:, -1] *= 1 - chance
    T[-1, 0] = T[0, -1] = chance
    leak = np.zeros(n)
    leak[1] = 0.1
    T[:, 1] *= 0.9
    return T, leak


def exact(T, leak, b, transposed):
    rows = [{i: float(x) for i, x in enumerate(column) if x} for column in T.T]
    factor = Elimination(rows, leak.tolist())
    return factor.values(b.tolist()) if transposed else factor.visits(b.tolist())


@pytest.mark.parametrize("transposed", [False, True])
@pytest.mark.parametrize("chance", [1e-1, 1e-3, 1e-5])
def test_certified_answers_are_right(chance, transposed):
    T, leak = coupled(chance)
    b = np.zeros((60, 1))
    b[5] = 1.0
    factor = SparseFactorisation(csc_array(T), leak)
    x = factor.values(b) if transposed else factor.visits(b)
    worst = np.max(np.abs(x[:, 0] / exact(T, leak, b[:, 0], transposed) - 1))
    assert worst < (1e-12 if factor.residual is None else 1e-6)
    if np.finfo(np.longdouble).eps < np.finfo(float).eps:  # else fewer can be certified
        assert factor.residual is None or chance < 1e-3


@pytest.mark.parametrize("chance", [1e-13, 1e-16, 1e-19])
def test_a_chain_too_slow_for_floats_is_refused_though_its_residual_is_small(chance):
    T, leak = coupled(chance)
    with pytest.raises(AccuracyError, match=r"too slowly|too rarely"):
        SparseFactorisation(csc_array(T), leak).visits(np.eye(60, 1))
