"""The arcs between different states, and those among some of them."""

import numpy as np
from scipy.sparse import csc_array

from evenbreak.chains.arcs import arcs_of


def test_arcs_among_some_states_and_the_leak_to_the_others():
    matrix = np.array(
        [[0.5, 0.125, 0, 0.5], [0.25, 0.5, 0, 0.25], [0.25, 0.25, 1, 0.25], [0, 0.125, 0, 0]]
    )
    arcs = arcs_of(csc_array(matrix))
    inner, leak = arcs.among(np.array([0, 1]))
    assert inner.matrix().toarray().tolist() == [[0, 0.125], [0.25, 0]]
    assert leak.tolist() == [0.25, 0.375]
    assert arcs.outflow.tolist() == [0.5, 0.5, 0, 1.0]


def test_the_outflow_never_comes_from_the_loop():
    """1 - (1 - 1e-17) is 0 in floats; the arc of 1e-17 is not."""
    matrix = csc_array(np.array([[1.0, 0.0], [1e-17, 1.0]]))
    assert arcs_of(matrix).outflow.tolist() == [1e-17, 0.0]


def test_no_arcs():
    arcs = arcs_of(csc_array(np.eye(3)))
    assert arcs.outflow.tolist() == [0, 0, 0]
    assert arcs.matrix().nnz == 0
