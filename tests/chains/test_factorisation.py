"""The cut of the classes into runs, each solved by its own method."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import factorisation
from evenbreak.chains.arcs import arcs_of
from evenbreak.chains.factorisation import Factorisation


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
