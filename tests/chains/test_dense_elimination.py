"""Elimination in a dense array, and the laws it gives, against exact rational arithmetic."""

from fractions import Fraction

import numpy as np
import pytest

import oracle
from evenbreak.chains import Chain, chain_of, dense_elimination, stationary_laws, stochastic_limit
from evenbreak.chains.arcs import arcs_of
from evenbreak.chains.stationary import dense_law, suits_array


def dense(size, decades, seed=1):
    """Return a chain with all arcs, whose chances span the given decades."""
    P = 10.0 ** -np.random.default_rng(seed).uniform(0.0, decades, (size, size))
    return chain_of(P / P.sum(axis=1, keepdims=True), rows="from", start=0)


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("decades", [1, 14, 60])
@pytest.mark.parametrize("size", [2, 5, 30])
def test_every_entry_is_right(monkeypatch, size, decades):
    chain = dense(size, decades, seed=size)
    exact = oracle.limit(oracle.columns_of(chain), {0: Fraction(1)})
    one_by_one = dense_law(chain.arcs)
    monkeypatch.setattr(dense_elimination, "_ONE_BY_ONE", 4)
    in_blocks = dense_law(chain.arcs)
    assert oracle.worst_relative_error(one_by_one, exact) < 5e-15
    assert oracle.worst_relative_error(in_blocks, exact) < 5e-15


def test_the_limit_is_this_law_and_has_its_period():
    chain = dense(30, 3)
    assert stochastic_limit(chain).probability.tolist() == dense_law(chain.arcs).tolist()
    assert stationary_laws(chain).tolist() == dense_law(chain.arcs).tolist()
    round_and_round = chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)])
    limit = stochastic_limit(round_and_round, {0: 0.5, 1: 0.5})
    assert (limit.period, limit.to_dict()) == (3, dict.fromkeys(range(3), 1 / 3))


def test_a_valley_deeper_than_floats_is_left_to_others():
    down = [(i, i + 1, 1e-60) for i in range(7)] + [(i, i - 1, 1e-60) for i in range(8, 15)]
    up = [(i, i - 1, 0.5) for i in range(1, 8)] + [(i, i + 1, 0.5) for i in range(7, 14)]
    stays = [(i, i, 0.5) for i in (*range(1, 7), *range(8, 14))] + [(i, i, 1.0) for i in (0, 14)]
    chain = chain_of([*down, *up, *stays])
    assert dense_law(chain.arcs) is None
    law = stochastic_limit(chain, 0, via="elimination").probability
    assert law[[0, 5, 14]] == pytest.approx([0.5, 2.0**4 * 1e-300, 0.5], rel=1e-14)


def test_large_and_sparse_classes_are_not_dense():
    ring = chain_of([(i, (i + 1) % 100, 1.0) for i in range(100)])
    assert not suits_array(ring.arcs)
    assert suits_array(dense(100, 1).arcs)
    assert suits_array(arcs_of(Chain([0], [[1.0]]).matrix))


@pytest.mark.parametrize("kind", ["alike", "two kinds", "turning"])
def test_rounding_errors_of_many_states_do_not_add_up(kind):
    """Where states are alike, all of them round in the same direction."""
    n = 300
    i = np.arange(n)
    into = np.where(i < n // 2, 3, 1) if kind == "two kinds" else np.ones(n, dtype=int)
    weights = np.outer(into, np.ones(n)) + ((i[:, None] - i) % n if kind == "turning" else 0)
    law = dense_law(Chain(range(n), weights / weights.sum(axis=0)).arcs)
    assert law == pytest.approx(into / into.sum(), rel=1e-15, abs=0.0)
