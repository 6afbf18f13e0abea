"""Leading pairs and the roots of 1, by hand and by their equations."""

import numpy as np
import pytest

from evenbreak.chains import chain_of, spectrum
from evenbreak.chains.eigenpairs import UnitPairs, leading_pairs, roots_of_one
from evenbreak.errors import AccuracyError

# From S play goes to the absorbing state W, or to a ring of three with a uniform law.
RING = [("a", "b", 1.0), ("b", "c", 1.0), ("c", "a", 1.0)]
CHAIN = chain_of([("S", "W", 0.25), ("S", "S", 0.5), ("S", "b", 0.25), *RING])


def test_the_other_roots_of_1_solve_their_equations() -> None:
    values, left, right = roots_of_one(CHAIN, UnitPairs(CHAIN), 2).in_complex()
    M = CHAIN.matrix.toarray()
    assert values**3 == pytest.approx(np.ones(2), abs=1e-14)
    assert values[0] == pytest.approx(values[1].conj(), abs=1e-14)
    assert left @ M == pytest.approx(values[:, None] * left, abs=1e-14)
    assert M @ right == pytest.approx(right * values, abs=1e-14)
    assert left @ right == pytest.approx(np.eye(2), abs=1e-14)


def test_leading_pairs_begin_with_eigenvalue_1() -> None:
    pairs, missed = leading_pairs(CHAIN, UnitPairs(CHAIN), 5)
    assert missed < 1e-14
    assert pairs.left.dtype == pairs.right.dtype == float
    assert pairs.left @ pairs.right == pytest.approx(np.eye(5), abs=1e-12)
    values, left, right = pairs.in_complex()
    assert values[:2].tolist() == [1.0, 1.0]
    assert np.abs(values[2:4]) == pytest.approx([1.0, 1.0])
    assert values[4] == pytest.approx(0.5)
    assert left @ right == pytest.approx(np.eye(5), abs=1e-12)
    M = CHAIN.matrix.toarray()
    assert M @ right == pytest.approx(right * values, abs=1e-14)
    assert left @ M == pytest.approx(values[:, None] * left, abs=1e-14)


@pytest.mark.parametrize("k", [2, 3, 4])
def test_conjugate_pairs_are_never_parted(k: int) -> None:
    pairs, _ = leading_pairs(CHAIN, UnitPairs(CHAIN), k)
    assert len(pairs.values) == (2 if k == 2 else 4)


def test_a_defective_matrix_has_too_few_vectors() -> None:
    path = chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0)])
    with pytest.raises(AccuracyError, match="defective"):
        leading_pairs(path, UnitPairs(path), 3)


@pytest.mark.parametrize("k", [20, 40])
def test_the_roots_of_a_large_class_are_exact_and_in_their_places(monkeypatch, k: int) -> None:
    """Those of modulus 1 are known whatever the number of states; those nearest to 1 come first."""
    draw = np.random.default_rng(0)
    period, size = 8, 10
    arcs = []
    for phase in range(period):
        for state in range(size):
            chances = draw.dirichlet(np.ones(size))
            next_phase = (phase + 1) % period
            arcs += [((phase, state), (next_phase, to), p) for to, p in enumerate(chances)]
    chain = chain_of(arcs)
    dense = spectrum(chain, k=period)
    monkeypatch.setattr("evenbreak.chains.eigenpairs.DENSE", 10)
    found = spectrum(chain, k=k)
    roots = np.exp(2j * np.pi * np.arange(period) / period)
    on_circle = found.values[np.abs(found.values) > 0.99]
    assert len(on_circle) > 2
    for value in on_circle:
        assert np.abs(value - roots).min() < 1e-15
    assert (np.diff(np.abs(found.values - 1.0)) > -1e-15).all()
    assert np.abs(found.values).max() <= 1.0
    for value, one in zip(found.values, found.right.T, strict=True):
        if abs(abs(value) - 1.0) < 1e-15:
            same = int(np.argmin(np.abs(dense.values - value)))
            np.testing.assert_allclose(one, dense.right[:, same], rtol=1e-13)
