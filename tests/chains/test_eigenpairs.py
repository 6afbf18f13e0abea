"""The vectors of eigenvalue 1 and of the other roots of 1, by hand and by their equations."""

from fractions import Fraction

import numpy as np
import pytest

from evenbreak.chains import chain_of, spectrum, stochastic_limit
from evenbreak.chains.eigenpairs import (
    UnitPairs,
    leading_pairs,
    roots_of_one,
    rounding_of_limit,
)
from evenbreak.errors import AccuracyError
from evenbreak.games import Race, Rack

WIDE = np.finfo(np.longdouble).eps < np.finfo(float).eps
"""Whether a longdouble is more than a float: neither on Windows nor on Apple's processors."""

# From S play goes to the absorbing state W, or to a ring of three with a uniform law.
RING = [("a", "b", 1.0), ("b", "c", 1.0), ("c", "a", 1.0)]
CHAIN = chain_of([("S", "W", 0.25), ("S", "S", 0.5), ("S", "b", 0.25), *RING])


def test_the_vectors_of_eigenvalue_1_are_laws_and_chances() -> None:
    units = UnitPairs(CHAIN)
    by_state = dict(zip(CHAIN.states, zip(units.right, units.left.T, strict=True), strict=True))
    won = int(np.argmax(by_state["W"][0]))
    assert by_state["W"][0][won] == 1.0
    assert [by_state[s][0][1 - won] for s in "abc"] == pytest.approx([1 / 3] * 3, rel=1e-15)
    assert by_state["S"][1] == pytest.approx([0.5, 0.5], rel=1e-15)
    assert units.error < 1e-14


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


@pytest.mark.parametrize(("m", "n"), [(1, 1), (7, 5), (25, 25)])
def test_the_bound_of_a_limit_holds_against_fractions(m, n) -> None:
    """The sum of all errors of the limit by eigenvectors of a race, from one state and from all."""
    chain = chain_of(Race(m, n, Rack(0.55)))
    found = spectrum(chain, k=m + n)
    anywhere = np.full(len(chain), 1.0 / len(chain))
    for start in (chain.start, anywhere):
        exact = exact_limit_of(chain, start)
        errors = (abs(Fraction(p) - q) for p, q in zip(found.limit(start), exact, strict=True))
        assert float(sum(errors)) <= found.limit_error < (1e-13 if WIDE else 1e-12)


def test_without_extended_precision_the_bound_grows_with_the_states(monkeypatch) -> None:
    bound = rounding_of_limit(5040)
    monkeypatch.setattr("evenbreak.chains.eigenpairs._WIDE_EPS", float(np.finfo(float).eps))
    assert rounding_of_limit(5040) > 5040 * np.finfo(float).eps > (bound if WIDE else 0.0)


def exact_limit_of(chain, start):
    """Return the limit in fractions, of the matrix as its floats are, by following the scores."""
    matrix = chain.matrix
    mass = [Fraction(p) for p in chain.density(start).tolist()]
    for j in chain.structure.order.tolist():  # upstream first
        arcs = range(matrix.indptr[j], matrix.indptr[j + 1])
        moves = {int(matrix.indices[k]): Fraction(float(matrix.data[k])) for k in arcs}
        if j not in moves:
            out = sum(moves.values())
            for i, p in moves.items():
                mass[i] += mass[j] * p / out
            mass[j] = Fraction(0)
    return mass


@pytest.mark.skipif(not WIDE, reason="no extended precision: the bound is above 1e-12, and refused")
def test_a_long_race_is_answered_by_eigenvectors() -> None:
    """Its 5,040 states bring no error of their own: each chance is a sum of few roundings."""
    race = chain_of(Race(70, 70, Rack(0.55)))
    exact = stochastic_limit(race).probability
    found = stochastic_limit(race, via="eigen").probability
    assert np.abs(found - exact).sum() <= UnitPairs(race).error < 1e-13
