"""Classes, kinds and periods, against what the oracle finds by walking the graph."""

import random

import networkx as nx
import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import Chain
from rows import each_of


def chain_of_arcs(n, arcs, loops=()):
    """Return a chain in which each state takes its arcs (and loop, if listed) alike."""
    matrix = np.zeros((n, n))
    for j, i in [*arcs, *((k, k) for k in loops)]:
        matrix[i, j] = 1.0
    matrix[:, matrix.sum(axis=0) == 0] = np.eye(n)[:, matrix.sum(axis=0) == 0]
    return Chain(range(n), csc_array(matrix / matrix.sum(axis=0)), 0)


def random_chain(draw):
    n = draw.randint(1, 12)
    arcs = [(draw.randrange(n), draw.randrange(n)) for _ in range(draw.randint(0, 2 * n))]
    return chain_of_arcs(n, arcs)


@each_of("seed", range(150))
def test_classes_are_the_strong_components_upstream_first(seed):
    chain = random_chain(random.Random(seed))
    structure, columns = chain.structure, oracle.columns_of(chain)
    graph = nx.DiGraph((j, i) for j, column in enumerate(columns) for i in column)
    graph.add_nodes_from(range(len(chain)))
    found = {frozenset(structure.members(c).tolist()) for c in range(structure.count)}
    assert found == {frozenset(c) for c in nx.strongly_connected_components(graph)}
    assert all(structure.label[j] <= structure.label[i] for j, i in graph.edges)
    closed = {
        frozenset(structure.members(c).tolist())
        for c in range(structure.count)
        if structure.closed[c]
    }
    assert closed == {frozenset(c) for c in oracle.closed_classes(columns)}
    for states in closed:
        label = structure.label[min(states)]
        assert structure.periods[label] == oracle.period(chain, states)
    assert (structure.periods[~structure.closed] == 0).all()


def test_kinds():
    chain = chain_of_arcs(5, [(0, 1), (1, 2), (2, 1), (0, 3), (4, 0)])
    assert chain.structure.kinds == [
        "transient",
        "recurrent",
        "recurrent",
        "absorbing",
        "transient",
    ]


@pytest.mark.parametrize("n", [2, 3, 5, 64, 99])
def test_a_cycle_has_its_length_for_period(n):
    circle = [(k, (k + 1) % n) for k in range(n)]
    assert chain_of_arcs(n, circle).structure.periods.tolist() == [n]
    assert chain_of_arcs(n, circle, loops=[n // 2]).structure.periods.tolist() == [1]
    shortcut = chain_of_arcs(n, [*circle, (n - 2, 0)]).structure.periods.tolist()
    assert shortcut == [1]


def test_periods_of_many_classes_are_found_together():
    arcs = [(0, 1), (1, 0), (2, 3), (3, 4), (4, 2), (5, 0), (5, 2), (6, 7), (7, 6), (7, 5)]
    structure = chain_of_arcs(8, arcs).structure
    assert {c: p for c, p in enumerate(structure.periods.tolist()) if p} == {
        structure.label[0]: 2,
        structure.label[2]: 3,
    }


def test_arcs_all_forward_or_all_backward_need_no_search(monkeypatch):
    def fail(*_args, **_kwargs):
        raise AssertionError("searched for strong components")

    monkeypatch.setattr("scipy.sparse.csgraph.connected_components", fail)
    forward = chain_of_arcs(4, [(0, 1), (1, 3), (0, 2)]).structure
    assert forward.label.tolist() == [0, 1, 2, 3]
    assert forward.closed.tolist() == [False, False, True, True]
    backward = chain_of_arcs(4, [(3, 1), (1, 0), (3, 2)]).structure
    assert backward.label.tolist() == [3, 2, 1, 0]
    assert backward.closed[backward.label].tolist() == [True, False, True, False]
    assert backward.members(0).tolist() == [3]


def test_fifty_thousand_small_classes():
    k = 50_000
    j = np.arange(3 * k)
    i = j - j % 3 + (j + 1) % 3
    chain = Chain(range(3 * k), csc_array((np.ones(3 * k), (i, j))), 0)
    assert chain.structure.count == k
    assert (chain.structure.periods == 3).all()
