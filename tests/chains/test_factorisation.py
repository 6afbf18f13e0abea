"""Which method a class gets, and the cut of the classes into runs."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import factorisation
from evenbreak.chains.arcs import arcs_of
from evenbreak.chains.factorisation import Factorisation, path_order


def line(n, shuffle):
    T = np.zeros((n, n))
    i = np.arange(n - 1)
    T[i + 1, i], T[i, i + 1] = 0.25, 0.5
    place = np.random.default_rng(shuffle).permutation(n)
    return csc_array(T[place][:, place]), place


@pytest.mark.parametrize("shuffle", range(3))
def test_a_line_is_found_from_one_end_to_the_other(shuffle):
    T, place = line(50, shuffle)
    order = place[path_order(T)].tolist()
    assert order in (list(range(50)), list(range(49, -1, -1)))


def test_what_has_two_ends_but_is_no_line():
    T = np.zeros((5, 5))
    for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (3, 0), (1, 4), (4, 1), (2, 1)):
        T[b, a] = 0.25
    assert path_order(csc_array(T)) is None
    assert path_order(csc_array(np.ones((4, 4)) - np.eye(4))) is None


@pytest.mark.parametrize(
    ("small", "spans"),
    [(64, [(0, 9)]), (3, [(0, 4), (4, 9)]), (1, [(0, 1), (1, 4), (4, 9)])],
)
def test_small_classes_between_large_ones_are_taken_together(monkeypatch, small, spans):
    monkeypatch.setattr(factorisation, "SMALL", small)
    T = np.zeros((9, 9))
    T[1:4, 1:4] = np.roll(np.eye(3), 1, axis=0) * 0.5
    T[4:, 4:] = np.roll(np.eye(5), 1, axis=0) * 0.5
    T[1, 0] = T[4, 3] = 0.25
    leak = 1.0 - T.sum(axis=0)
    factor = Factorisation(arcs_of(csc_array(T)), leak, np.ones(9))
    assert [(piece.first, piece.last) for piece in factor._pieces] == spans
    inverse = np.linalg.inv(np.eye(9) - T)
    b = np.random.default_rng(0).random((9, 2))
    assert factor.visits(b) == pytest.approx(inverse @ b, rel=1e-13)
    assert factor.values(b) == pytest.approx(inverse.T @ b, rel=1e-13)
