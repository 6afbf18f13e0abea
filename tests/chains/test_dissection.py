"""The fronts of a nested dissection: each state once, and no arc past a front unseen."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import dissection
from evenbreak.chains.dissection import bandwidth, dissect, neighbours


def grid(side):
    """Return the arcs of a square grid, numbered at random."""
    place = np.random.default_rng(0).permutation(side * side).reshape(side, side)
    one = np.concatenate([place[1:].ravel(), place[:, 1:].ravel()])
    other = np.concatenate([place[:-1].ravel(), place[:, :-1].ravel()])
    return csc_array((np.ones(len(one)), (one, other)), (side * side, side * side))


def scattered(n, each, seed):
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(0, n, each * n), np.repeat(np.arange(n), each)
    apart = rows != columns
    return csc_array((np.ones(apart.sum()), (rows[apart], columns[apart])), (n, n))


def filled_in(graph, order):
    """Return where eliminating state by state leaves arcs, by place in the order."""
    full = graph.toarray()[order][:, order] > 0
    for k in range(len(order)):
        near = k + 1 + np.flatnonzero(full[k + 1 :, k])
        full[np.ix_(near, near)] = True
    return full


def fronts_as_matrix(fronts):
    """Return which pairs of states are in a front together, by place in the order."""
    size = fronts[-1].last
    held = np.zeros((size, size), dtype=bool)
    for first, last, later in fronts:
        held[first:last, first:last] = True
        held[first:last, later] = held[later[:, None], np.arange(first, last)] = True
    return held


@pytest.mark.parametrize("leaf", [2, 20])
@pytest.mark.parametrize(
    "T",
    [grid(12), scattered(90, 2, seed=1), scattered(60, 30, seed=2), csc_array((50, 50))],
    ids=["grid", "sparse", "dense", "no arcs"],
)
def test_fronts_hold_all_arcs_that_elimination_makes(monkeypatch, T, leaf):
    monkeypatch.setattr(dissection, "_LEAF", leaf)
    graph = neighbours(T)
    order, fronts = dissect(graph)
    assert sorted(order.tolist()) == list(range(T.shape[0]))
    assert [front.first for front in fronts] == [0, *(front.last for front in fronts[:-1])]
    assert not (filled_in(graph, order) & ~fronts_as_matrix(fronts)).any()
    for number, (_, last, later) in enumerate(fronts):
        if len(later):  # what remains is all held by the front that takes it up
            parent = next(f for f in fronts[number + 1 :] if f.last > later[0])
            assert later[0] >= last
            assert set(later.tolist()) <= {*range(parent.first, parent.last), *parent.later}


def test_a_grid_is_cut_into_few_entries():
    """A band as wide as the side would hold two million; the whole matrix, 26 million."""
    _, fronts = dissect(neighbours(grid(72)))
    assert sum(front.entries for front in fronts) < 700_000
    assert max(len(front.later) + front.last - front.first for front in fronts) < 200


def test_a_dense_graph_is_one_front():
    order, fronts = dissect(neighbours(csc_array(np.ones((300, 300)))))
    assert len(order) == 300
    assert [(first, last, len(later)) for first, last, later in fronts] == [(0, 300, 0)]


def test_the_band_of_a_grid_is_about_its_side():
    assert 20 <= bandwidth(neighbours(grid(20))) < 40
