"""Blocked elimination at sizes at which panels and windows really run."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains.banded import BandedElimination, band_order
from evenbreak.chains.elimination import Elimination


def grid(k, rng):
    """Return the arcs of a k x k grid, at random, in shuffled order."""
    place = rng.permutation(k * k).reshape(k, k)
    pairs = [(place[1:], place[:-1]), (place[:, 1:], place[:, :-1])]
    a = np.concatenate([x.ravel() for x, _ in pairs])
    b = np.concatenate([y.ravel() for _, y in pairs])
    rows, columns = np.concatenate((a, b)), np.concatenate((b, a))
    return csc_array((rng.uniform(0.01, 0.25, len(rows)), (rows, columns)), (k * k, k * k))


def plain(T, leak):
    rows = [{} for _ in leak]
    for i, j, chance in zip(*T.nonzero(), T[T.nonzero()].tolist(), strict=True):
        rows[int(j)][int(i)] = chance
    return Elimination(rows, leak.tolist())


def test_a_grid_has_a_narrow_band():
    order, width = band_order(grid(30, np.random.default_rng(0)))
    assert sorted(order.tolist()) == list(range(900))
    assert width < 60


@pytest.mark.parametrize("kind", ["grid", "dense", "one direction"])
def test_equal_to_plain_elimination(kind):
    rng = np.random.default_rng(5)
    if kind == "grid":
        T = grid(18, rng)
    elif kind == "dense":
        T = csc_array(rng.random((150, 150)) * (1 - np.eye(150)) / 150)
    else:
        T = csc_array(
            np.roll(np.eye(200), 1, axis=0) * 0.9 + np.roll(np.eye(200), 7, axis=0) * 0.05
        )
    n = T.shape[0]
    leak = np.zeros(n)
    leak[3] = 1e-12
    b = np.where(rng.random((n, 2)) < 0.1, 1.0, 0.0)
    blocked, slow = BandedElimination(T, leak, *band_order(T)), plain(T, leak)
    for column in range(2):
        right = b[:, column].tolist()
        assert blocked.visits(b)[:, column] == pytest.approx(slow.visits(right), rel=1e-12)
        assert blocked.values(b)[:, column] == pytest.approx(slow.values(right), rel=1e-12)
