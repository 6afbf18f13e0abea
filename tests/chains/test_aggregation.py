"""Aggregation and disaggregation: a handful of cycles, whatever the graph and its size."""

import numpy as np
import pytest
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.sparse.linalg import LinearOperator, bicgstab

from evenbreak.chains import aggregation
from evenbreak.chains.aggregation import Aggregation


def flows(kind, n, rng):
    """Return the balance equations of flows both ways along the arcs of a graph, and a leak."""
    state = np.arange(n)
    if kind == "grid":
        side = round(n**0.5)
        near = [(state + 1) % n, (state + side) % n]
    elif kind == "star":
        near = [np.zeros(n, dtype=int)]
    else:
        near = [rng.permutation(n), rng.permutation(n), (state + 1) % n]
    a, b = np.tile(state, len(near)), np.concatenate(near)
    a, b = a[a != b], b[a != b]
    flow = 10.0 ** -rng.uniform(0.0, 3.0, len(a))
    there = coo_array((np.append(flow, flow), (np.append(b, a), np.append(a, b))), shape=(n, n))
    leak = np.zeros(n)
    leak[0] = 1e-3
    return csr_array(diags_array(there.sum(axis=0) + leak) - there)


@pytest.mark.parametrize("kind", ["grid", "star", "random"])
def test_the_iterations_do_not_grow_with_the_size(kind):
    """Flows differ a thousandfold, and hardly any leaks: plain iterations would take hundreds."""
    rng = np.random.default_rng(3)
    counts = {}
    for n in (1600, 6400):
        B = flows(kind, n, rng)
        M = LinearOperator(B.shape, matvec=Aggregation(B), dtype=float)
        steps = []
        b = rng.random(n)
        x, unfinished = bicgstab(B, b, rtol=1e-8, maxiter=100, M=M, callback=steps.append)
        assert not unfinished
        assert np.linalg.norm(B @ x - b) <= 1e-7 * np.linalg.norm(b)
        counts[n] = len(steps)
    assert counts[6400] <= 60


def test_groups_are_pairs_or_a_few_more_and_nobody_is_left_alone():
    rng = np.random.default_rng(4)
    for kind in ("grid", "random"):
        group = aggregation._pairs(flows(kind, 900, rng), rng)
        assert np.bincount(group).min() >= 1
        assert len(group) / 3.0 <= group.max() + 1 <= len(group) / 1.8


def test_the_flows_of_groups_are_sums():
    B = csr_array(np.array([[3.0, -1.0, -1.0], [-2.0, 4.0, 0.0], [-1.0, -2.0, 1.5]]))
    joined = aggregation._joined(B, np.array([0, 0, 1])).toarray()
    assert joined.tolist() == [[4.0, -1.0], [-3.0, 1.5]]
