"""Sparse LU: right, within the bounds that come with it, and refused where it is worthless."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import chain_of
from evenbreak.chains.certified_lu import CertifiedLU, CertifiedSolve
from evenbreak.chains.elimination import Elimination
from evenbreak.errors import AccuracyError


def cluster(leak, seed=0, n=8):
    """n states that all reach each other, the first of which is left with chance `leak`."""
    rng = np.random.default_rng(seed)
    arcs = []
    for j in range(n):
        chances = rng.dirichlet(np.ones(n)) * (1 - leak * (j == 0))
        arcs += [(j, i, p) for i, p in enumerate(chances)]
    return chain_of([*arcs, (0, "out", leak)])


def exact_visits(chain, start):
    columns = oracle.columns_of(chain)
    visits = oracle.visits(columns, {start: Fraction(1)})
    return np.array([float(visits[j]) for j in range(len(chain) - 1)])


@pytest.mark.parametrize("leak", [0.5, 1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("transposed", [False, True])
def test_the_error_is_within_its_bound(leak, transposed):
    chain = cluster(leak)
    n = len(chain) - 1
    table = np.array([exact_visits(chain, j) for j in range(n)]).T
    solves = CertifiedLU.of_states(chain.arcs, np.arange(n))
    for j in range(n):
        b = np.eye(n)[j]
        x = solves.solve(b, transposed=transposed)
        missed = solves.missed(x, b, transposed=transposed)
        bound = solves.error(missed, transposed=transposed, floor=1e-3)
        assert np.all(np.abs(x - (table.T if transposed else table)[:, j]) <= bound)
        assert np.all(bound <= 1e-12 / leak * x)


def test_a_wrong_answer_is_seen():
    chain = cluster(0.25)
    solves = CertifiedLU.of_states(chain.arcs, np.arange(8))
    b = np.eye(8)[0]
    x = solves.solve(b)
    for wrong in (x * (1 + 1e-6), x + np.eye(8)[3], np.zeros(8)):
        assert np.all(solves.error(solves.missed(wrong, b), floor=1e-3) >= np.abs(wrong - x))


def test_nothing_is_claimed_where_the_factors_are_no_good():
    chain = cluster(1e-18)
    try:
        solves = CertifiedLU.of_states(chain.arcs, np.arange(8))
    except AccuracyError:
        return
    assert np.all(np.isinf(solves.error(np.ones(8))))


def test_a_singular_matrix_is_refused():
    chain = chain_of([(0, 1, 1.0), (1, 0, 1.0), (0, "out", 1e-17)])
    with pytest.raises(AccuracyError, match="left too rarely"):
        CertifiedLU.of_states(chain.arcs, np.arange(2))


def test_self_loops_do_no_harm():
    """Left once in 1e14 steps: the arcs say so to the last digit, 1 minus the loop does not."""
    chain = chain_of([("S", "S", 1 - 1e-14), ("S", "W", 1e-14)])
    solves = CertifiedLU.of_states(chain.arcs, np.array([0]))
    assert solves.solve(np.ones(1)) == pytest.approx(1e14, rel=1e-15)


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
    factor = CertifiedSolve(csc_array(T), leak)
    x = factor.values(b) if transposed else factor.visits(b)
    worst = np.max(np.abs(x[:, 0] / exact(T, leak, b[:, 0], transposed) - 1))
    assert worst < (1e-12 if factor.residual is None else 1e-6)
    if np.finfo(np.longdouble).eps < np.finfo(float).eps:  # else fewer can be certified
        assert factor.residual is None or chance < 1e-3


@pytest.mark.parametrize("chance", [1e-13, 1e-16, 1e-19])
def test_a_chain_too_slow_for_floats_is_refused_though_its_residual_is_small(chance):
    T, leak = coupled(chance)
    with pytest.raises(AccuracyError, match=r"too slowly|too rarely"):
        CertifiedSolve(csc_array(T), leak).visits(np.eye(60, 1))
