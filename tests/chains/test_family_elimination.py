"""Elimination over arrays: laws as of one chain, and doubts where floats are too short."""

from fractions import Fraction
from typing import Any

import numpy as np

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.chains.family_elimination import family_limits
from evenbreak.chains.family_numbers import Numbers


def test_a_dense_class_and_a_sparse_one_agree_with_one_chain() -> None:
    draw = np.random.default_rng(1)
    for size, kept in ((12, 1.0), (12, 0.15)):
        graph = (draw.random((size, size)) < kept) | np.eye(size, k=1, dtype=bool)
        graph[-1, 0] = True
        tables = draw.random((70, size, size)) ** 6 * graph
        tables /= tables.sum(axis=2, keepdims=True)
        sources, targets = (places.tolist() for places in np.nonzero(graph))
        structure = chain_of(tables[0], rows="from").structure
        chances = [Numbers(p) for p in tables[:, sources, targets].T]
        limits, doubtful = family_limits(structure, sources, targets, chances, 70)
        assert doubtful is None or not doubtful.any()
        for table, limit in zip(tables, by_member(limits), strict=True):
            alone = stochastic_limit(chain_of(table, rows="from"), 0).probability
            np.testing.assert_allclose(limit, alone, rtol=1e-14)


def test_underflow_is_noticed_where_it_happens() -> None:
    up = Numbers(np.array([0.5, 1e-12]))
    sources = [k for k in range(40) for _ in range(2)]
    targets = [place for k in range(40) for place in (max(k - 1, 0), min(k + 1, 39))]
    line = chain_of({k: {max(k - 1, 0): 0.5, min(k + 1, 39): 0.5} for k in range(40)})
    chances = [
        up if t > s or s == t == 39 else 1.0 - up for s, t in zip(sources, targets, strict=True)
    ]
    _, doubtful = family_limits(line.structure, sources, targets, chances, 2)
    assert doubtful is not None
    assert doubtful.tolist() == [False, True]


def test_stiff_dense_classes_are_right_entry_by_entry() -> None:
    tables = 10.0 ** (-12 * np.random.default_rng(3).random((5, 9, 9)))
    tables /= tables.sum(axis=2, keepdims=True)
    sources, targets = (places.ravel().tolist() for places in np.indices((9, 9)))
    structure = chain_of(tables[0], rows="from").structure
    chances = [Numbers(p) for p in tables.reshape(5, -1).T]
    limits, _ = family_limits(structure, sources, targets, chances, 5)
    for table, limit in zip(tables, by_member(limits), strict=True):
        np.testing.assert_allclose(limit, exact_law(table), rtol=3e-15)


def by_member(limits: dict[int, Any]) -> np.ndarray:
    return np.array([limits[k].values for k in range(len(limits))]).T


def exact_law(table: np.ndarray) -> list[float]:
    arcs = [[Fraction(chance) for chance in row] for row in table.tolist()]
    shares = {}
    for k in reversed(range(1, len(arcs))):
        shares[k] = [arcs[j][k] / sum(arcs[k][:k]) for j in range(k)]
        for j in range(k):
            arcs[j] = [arcs[j][i] + shares[k][j] * arcs[k][i] for i in range(k)]
    law = [Fraction(1)]
    for k in range(1, len(arcs)):
        law.append(sum((v * s for v, s in zip(law, shares[k], strict=True)), Fraction(0)))
    return [float(v / sum(law)) for v in law]
