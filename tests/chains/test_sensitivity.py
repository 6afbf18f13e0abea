"""Derivatives of the limit against exact formulas and against differences of exact limits."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.chains import chain_from_arrays, chain_of, stochastic_limit
from evenbreak.chains.sensitivity import sensitivity
from evenbreak.chains.symbolic import symbolic_limit
from evenbreak.errors import ChainError
from evenbreak.games import OneBall, Race, Rack, Series, alternate_breaks, winner_breaks
from tiers import examples


def exact_derivatives(arcs, start, weights):
    """Derivatives of a limit by sympy, each arc's mass taken from the others in proportion."""
    sympy = pytest.importorskip("sympy", reason="the extra 'symbolic' is not installed")
    x = sympy.symbols("x")
    found = {}
    for source, target, p in arcs:
        shifted = [
            (j, i, q) if j != source else (j, i, q + x if i == target else q - x * q / (1 - p))
            for j, i, q in arcs
        ]
        if p != 1:
            limit = symbolic_limit([(j, i, sympy.sympify(q)) for j, i, q in shifted], start)
            found[source, target] = sum(
                w * sympy.diff(limit[s], x).subs(x, 0) for s, w in weights.items()
            )
    return {arc: float(derivative) for arc, derivative in found.items()}


def fractions(arcs):
    return [(j, i, Fraction(p)) for j, i, p in arcs]


CHAINS = {
    "one-ball": [("S1", "W", "2/5"), ("S1", "S2", "3/5"), ("S2", "L", "4/5"), ("S2", "S1", "1/5")],
    "self-loops": [
        ("a", "a", "1/2"), ("a", "b", "1/8"), ("a", "W", "1/8"), ("a", "L", "1/4"),
        ("b", "a", "1/4"), ("b", "b", "1/4"), ("b", "L", "1/2"),
    ],
    "recurrent": [
        ("W", "b", "1/4"), ("W", "c", "3/4"), ("b", "W", "1/2"), ("b", "b", "1/2"),
        ("c", "b", "1/8"), ("c", "W", "3/8"), ("c", "c", "1/2"),
    ],
    "both": [
        ("s", "W", "1/4"), ("s", "x", "1/2"), ("s", "L", "1/4"), ("W", "y", "1/2"),
        ("W", "W", "1/2"), ("y", "W", "1/4"), ("y", "y", "3/4"), ("x", "s", "1/2"),
        ("x", "W", "1/2"), ("L", "L", "1"),
    ],
    "periodic": [
        ("s", "W", "1/4"), ("s", "L", "3/4"), ("W", "x", "1/2"), ("W", "y", "1/2"),
        ("x", "W", "1"), ("y", "W", "1"),
    ],
}  # fmt: skip


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("name", CHAINS)
@pytest.mark.parametrize("weights", [{"W": 1}, {"W": 2, "L": -3}])
def test_exact(name, weights):
    arcs = fractions(CHAINS[name])
    weights = {s: w for s, w in weights.items() if any(s in arc for arc in arcs)}
    start = arcs[0][0]
    exact = exact_derivatives(arcs, start, weights)
    found = sensitivity(chain_of(arcs), weights, start)
    for source, target, p in arcs:
        expected = exact[source, target] if p != 1 else 0.0
        assert found[source, target] == pytest.approx(expected, rel=1e-13, abs=1e-15)


def test_one_ball_by_hand():
    """W = p1 / (1 - q1 q2): dW/dp1 = p2 / (1 - q1 q2)^2, dW/dp2 = -p1 q1 / (1 - q1 q2)^2."""
    p1, p2 = 0.4, 0.8
    D = (1 - (1 - p1) * (1 - p2)) ** 2
    won = sensitivity(chain_of(OneBall(p1, p2)), "W")
    assert won.value == pytest.approx(p1 / (1 - (1 - p1) * (1 - p2)), rel=1e-15)
    assert won["S1", "W"] == pytest.approx(p2 / D, rel=1e-14)
    assert won["S1", "S2"] == pytest.approx(-p2 / D, rel=1e-14)
    assert won["S2", "L"] == pytest.approx(-p1 * (1 - p1) / D, rel=1e-14)


def test_a_parameter_shared_by_every_rack():
    """dW/dp of a race 7:7 is a density of the beta distribution: 7 C(13, 6) (p q)^6."""
    p = 0.55
    chain = chain_of(Race(7, 7, Rack(p)))
    wins = {(7, b): 1.0 for b in range(7)}
    change = {}
    for a in range(7):
        for b in range(7):
            change[(a, b), (a + 1, b)] = 1.0
            change[(a, b), (a, b + 1)] = -1.0
    slope = sensitivity(chain, wins).along(change)
    assert slope == pytest.approx(7 * 1716 * (p * (1 - p)) ** 6, rel=1e-13)


def test_the_break_in_the_long_run():
    """W^WB = q2 / (q1 + q2) is the limit of state 1: dW/dp1 = q2 / (q1 + q2)^2."""
    q1, q2 = 0.1, 0.5
    chain = chain_of(Series(Rack(1 - q1, 1 - q2), breaks=winner_breaks))
    share = sensitivity(chain, 1)
    assert share.along({(1, 1): 1, (1, 2): -1}) == pytest.approx(q2 / (q1 + q2) ** 2, rel=1e-13)
    assert share[1, 1] == pytest.approx(q2 / (q1 + q2) ** 2, rel=1e-13)


def test_an_arc_without_others_cannot_change():
    share = sensitivity(chain_of(Series(Rack(0.5), breaks=alternate_breaks)), 1)
    assert share.to_dict() == {(1, 2): 0.0, (2, 1): 0.0}


def test_a_nearly_certain_arc():
    """From s: W with 1 - e, L with e. Nothing is lost to 1 - (1 - e)."""
    e = 1e-13
    won = sensitivity(chain_of([("s", "W", 1 - e), ("s", "L", e)]), "W", "s")
    assert won["s", "W"] == 1.0
    assert won["s", "L"] == -1.0


def test_an_arc_about_to_open():
    """OneBall(1, p2): when player 1 begins to miss, W falls by p2 for each unit."""
    chain = chain_of([("S1", "W", 1.0), ("S2", "L", 0.75), ("S2", "S1", 0.25)])
    won = sensitivity(chain, "W", "S1")
    assert won.along({("S1", "W"): -1, ("S1", "S2"): 1}) == -0.75


@st.composite
def problems(draw):
    """A random chain with weights: sparse enough to have several classes."""
    n = draw(st.integers(2, 7))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    A = rng.integers(1, 9, (n, n)) * (rng.random((n, n)) < draw(st.sampled_from([0.3, 0.5, 0.9])))
    A[rng.integers(n, size=n), range(n)] += 1
    j, i = np.nonzero(A.T)
    p = (A / A.sum(axis=0))[i, j]
    return n, j, i, p, rng.integers(-5, 6, n).astype(float)


def value(n, j, i, p, c):
    return stochastic_limit(chain_from_arrays(list(range(n)), j, i, p), 0).probability @ c


@pytest.mark.slow
@settings(max_examples=examples(50), deadline=None)
@given(problems())
def test_central_differences(problem):
    n, j, i, p, c = problem
    chain = chain_from_arrays(list(range(n)), j, i, p)
    found = sensitivity(chain, c, 0)
    assert found.value == pytest.approx(value(n, j, i, p, c), abs=1e-12)
    for k in range(len(p)):
        others = (j == j[k]) & (np.arange(len(p)) != k)
        if not others.any():
            assert found[int(j[k]), int(i[k])] == 0.0
            continue
        change = np.where(others, -p / p[others].sum(), 0.0)
        change[k] = 1.0
        step = 1e-5
        slope = (value(n, j, i, p + step * change, c) - value(n, j, i, p - step * change, c)) / (
            2 * step
        )
        assert found[int(j[k]), int(i[k])] == pytest.approx(slope, rel=1e-6, abs=1e-6)
        along = found.along({(int(j[m]), int(i[m])): change[m] for m in np.flatnonzero(change)})
        assert along == pytest.approx(found[int(j[k]), int(i[k])], rel=1e-9, abs=1e-9)


@settings(max_examples=examples(30), deadline=None)
@given(problems())
def test_the_changes_of_a_state_cancel(problem):
    """Raising every arc of a state in proportion changes nothing: sum p (1 - p) dF/dp = 0."""
    n, j, i, p, c = problem
    found = sensitivity(chain_from_arrays(list(range(n)), j, i, p), c, 0)
    weighted = found.chain.matrix.multiply(found.matrix) - found.chain.matrix.multiply(
        found.chain.matrix.multiply(found.matrix)
    )
    np.testing.assert_allclose(weighted.sum(axis=0), 0.0, atol=1e-9)


def test_refusals():
    chain = chain_of(OneBall(0.4, 0.8))
    won = sensitivity(chain, "W")
    with pytest.raises(ChainError, match="out of 'S1' must sum to 0; they sum to 1"):
        won.along({("S1", "W"): 1})
    with pytest.raises(ChainError, match="leads out of a closed class"):
        won.along({("W", "S1"): 1, ("W", "W"): -1})
    with pytest.raises(ChainError, match="no arc 'S1' -> 'L'"):
        _ = won["S1", "L"]
    with pytest.raises(ChainError, match="state 'X'"):
        sensitivity(chain, "X")
    with pytest.raises(ChainError, match="weights must have finite numbers; one is inf for state"):
        sensitivity(chain, {"W": float("inf")})
    with pytest.raises(ChainError, match=r"weights must have shape \(4,\); its shape"):
        sensitivity(chain, np.ones(3))
