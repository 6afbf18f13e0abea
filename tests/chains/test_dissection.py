"""The fronts of a nested dissection: each state once, and no arc past a front unseen."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array, eye_array
from scipy.sparse.linalg import splu

import oracle
from evenbreak.chains import dense_elimination, dissection
from evenbreak.chains.dissection import FrontElimination, bandwidth, dissect, neighbors
from evenbreak.chains.elimination import Elimination


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
    graph = neighbors(T)
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
    _, fronts = dissect(neighbors(grid(72)))
    assert sum(front.entries for front in fronts) < 700_000
    assert max(len(front.later) + front.last - front.first for front in fronts) < 200


def test_a_dense_graph_is_one_front():
    order, fronts = dissect(neighbors(csc_array(np.ones((300, 300)))))
    assert len(order) == 300
    assert [(first, last, len(later)) for first, last, later in fronts] == [(0, 300, 0)]


def test_the_band_of_a_grid_is_about_its_side():
    assert 20 <= bandwidth(neighbors(grid(20))) < 40


# Elimination in fronts at sizes at which fronts, blocks and strips really arise.


def lattice(side, rng, decades=1.0):
    """Return the arcs of a square grid, spread over some decades, in shuffled order."""
    place = rng.permutation(side * side).reshape(side, side)
    one = np.concatenate([place[1:].ravel(), place[:, 1:].ravel()])
    other = np.concatenate([place[:-1].ravel(), place[:, :-1].ravel()])
    rows, columns = np.concatenate((one, other)), np.concatenate((other, one))
    chances = 0.25 * 10.0 ** -rng.uniform(0.0, decades, len(rows))
    return csc_array((chances, (rows, columns)), (side * side, side * side))


def factored(T, leak):
    return FrontElimination(T, leak, *dissect(neighbors(T)))


def plain(T, leak, number=float):
    rows = [{} for _ in leak]
    arcs = T.tocoo()
    for i, j, chance in zip(arcs.row, arcs.col, arcs.data.tolist(), strict=True):
        rows[int(j)][int(i)] = number(chance)
    return Elimination(rows, [number(x) for x in leak.tolist()])


def of_kind(kind, rng):
    if kind == "grid":
        return lattice(18, rng)
    if kind == "dense":
        return csc_array(rng.random((150, 150)) * (1 - np.eye(150)) / 150)
    ring = np.eye(200)
    return csc_array(np.roll(ring, 1, axis=0) * 0.9 + np.roll(ring, 7, axis=0) * 0.05)


@pytest.mark.slow_after(4)
@pytest.mark.parametrize("small", [True, False])
@pytest.mark.parametrize("kind", ["grid", "dense", "one direction"])
def test_equal_to_plain_elimination(monkeypatch, kind, small):
    if small:
        monkeypatch.setattr(dissection, "_LEAF", 8)
        for name, value in [("_ONE_BY_ONE", 3), ("_TERMS", 5), ("_FEW", 20), ("_SMALL", 200)]:
            monkeypatch.setattr(dense_elimination, name, value)
    rng = np.random.default_rng(5)
    T = of_kind(kind, rng)
    n = T.shape[0]
    leak = np.zeros(n)
    leak[3] = 1e-12
    b = np.where(rng.random((n, 3)) < 0.1, 1.0, 0.0)
    given = b.copy()
    fronts, slow = factored(T, leak), plain(T, leak)
    for column in range(3):
        right = b[:, column].tolist()
        assert fronts.visits(b)[:, column] == pytest.approx(slow.visits(right), rel=1e-13)
        assert fronts.values(b)[:, column] == pytest.approx(slow.values(right), rel=1e-13)
    assert (b == given).all()


@pytest.mark.parametrize("decades", [1, 16, 50])
def test_right_in_every_entry_however_stiff(monkeypatch, decades):
    """Against fractions; 16 decades leave nothing of an answer that comes from subtraction."""
    monkeypatch.setattr(dissection, "_LEAF", 6)
    monkeypatch.setattr(dense_elimination, "_ONE_BY_ONE", 4)
    T = lattice(6, np.random.default_rng(decades), decades)
    leak = np.zeros(36)
    leak[7] = 10.0**-decades
    b = np.zeros((36, 1))
    b[20] = 1.0
    fronts, exact = factored(T, leak), plain(T, leak, Fraction)
    right = [Fraction(x) for x in b[:, 0].tolist()]
    assert oracle.worst_relative_error(fronts.visits(b)[:, 0], exact.visits(right)) < 3e-15
    assert oracle.worst_relative_error(fronts.values(b)[:, 0], exact.values(right)) < 3e-15
    pivots = plain(T, leak).pivots
    assert (fronts.pivots > 0.0).all()
    assert len(pivots) == len(fronts.pivots)


def test_large_blocks_are_multiplied_and_solved_whole(monkeypatch):
    """The same numbers as in strips, up to rounding."""
    rng = np.random.default_rng(3)
    T = csc_array(rng.random((220, 220)) * (1 - np.eye(220)) / 220)
    leak = rng.random(220) / 100
    b = rng.random((220, 9))
    strips = factored(T, leak)
    monkeypatch.setattr(dense_elimination, "_LARGE", 1)
    whole = factored(T, leak)
    assert whole.visits(b) == pytest.approx(strips.visits(b), rel=1e-14)
    assert whole.values(b) == pytest.approx(strips.values(b), rel=1e-14)


def test_a_grid_of_3600_states_agrees_with_sparse_lu():
    rng = np.random.default_rng(4)
    T, leak = lattice(60, rng), rng.random(3600) / 10
    b = rng.random((3600, 1))
    outflow = T.sum(axis=0) + leak
    system = csc_array(eye_array(3600).multiply(outflow).tocsc() - T)
    assert factored(T, leak).visits(b) == pytest.approx(splu(system).solve(b), rel=1e-11)
