"""Solves by LU with pivoting: right, and within the bounds that come with them."""

from fractions import Fraction

import numpy as np
import pytest

import oracle
from evenbreak.chains import chain_of
from evenbreak.chains.lu_solves import LUSolves
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
    solves = LUSolves(chain.arcs, np.arange(n))
    for j in range(n):
        b = np.eye(n)[j]
        x = solves.solve(b, transposed=transposed)
        bound = solves.error(solves.missed(x, b, transposed=transposed), transposed=transposed)
        assert np.all(np.abs(x - (table.T if transposed else table)[:, j]) <= bound)
        assert np.all(bound <= 1e-12 / leak * x)


def test_a_wrong_answer_is_seen():
    chain = cluster(0.25)
    solves = LUSolves(chain.arcs, np.arange(8))
    b = np.eye(8)[0]
    x = solves.solve(b)
    for wrong in (x * (1 + 1e-6), x + np.eye(8)[3], np.zeros(8)):
        assert np.all(solves.error(solves.missed(wrong, b)) >= np.abs(wrong - x))


def test_nothing_is_claimed_where_the_factors_are_no_good():
    chain = cluster(1e-18)
    try:
        solves = LUSolves(chain.arcs, np.arange(8))
    except AccuracyError:
        return
    assert np.all(np.isinf(solves.error(np.ones(8))))


def test_a_singular_matrix_is_refused():
    chain = chain_of([(0, 1, 1.0), (1, 0, 1.0), (0, "out", 1e-17)])
    with pytest.raises(AccuracyError, match="left too rarely"):
        LUSolves(chain.arcs, np.arange(2))


def test_self_loops_do_no_harm():
    """Left once in 1e14 steps: the arcs say so to the last digit, 1 minus the loop does not."""
    chain = chain_of([("S", "S", 1 - 1e-14), ("S", "W", 1e-14)])
    solves = LUSolves(chain.arcs, np.array([0]))
    assert solves.solve(np.ones(1)) == pytest.approx(1e14, rel=1e-15)
