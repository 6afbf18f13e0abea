"""Eigenvalues known in closed form; the eigen route against the direct one; refusals."""

import sys
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from evenbreak.chains import (
    Chain,
    chain_from_arrays,
    chain_of,
    limit_matrix,
    spectrum,
    stochastic_limit,
)
from evenbreak.chains.spectrum import reversible_classes, symmetric_form
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.games import (
    Ahead,
    Drill,
    OneBall,
    Race,
    Rack,
    Series,
    loser_breaks,
    winner_breaks,
)
from evenbreak.handicaps import Ladder, chart, system_of
from evenbreak.ratings.scale import scale_of
from rows import each_of
from tiers import examples


def ladder(n, pull=10.0, stay=0.0):
    """A walk of +-1 on n rungs that is pulled to the middle: period 2 unless it may stay."""
    i = np.arange(n)
    up = 1.0 / (1.0 + np.exp((i - n / 2) / pull))
    up[0], up[-1] = 1.0, 0.0
    sources = np.concatenate([i[:-1], i[1:], i])
    targets = np.concatenate([i[1:], i[:-1], i])
    chances = np.concatenate([up[:-1] * (1 - stay), (1 - up[1:]) * (1 - stay), np.full(n, stay)])
    return chain_from_arrays(list(range(n)), sources, targets, chances, start=0)


def unbalanced(chain):
    """The chain with a third of the arcs out of state 0 led to state 2, so not reversible."""
    triples = zip(chain.arcs.sources, chain.arcs.targets, chain.arcs.chances, strict=True)
    ways = [(j, i, p) for j, i, p in triples if j]
    ways += [(0, 1, chain.matrix[1, 0] * 2 / 3), (0, 2, chain.matrix[1, 0] / 3)]
    loops = [(j, j, p) for j, p in enumerate(chain.matrix.diagonal()) if p]
    return chain_of(ways + loops, start=0)


def blocks(coupling):
    """Two blocks of three states that mix at once, and a rare change of block."""
    inside = [
        (b + j, b + i, (1 - coupling) / 3) for b in (0, 3) for j in range(3) for i in range(3)
    ]
    return chain_of(inside + [(j, (j + 3) % 6, coupling) for j in range(6)], start=0)


@st.composite
def chains(draw):
    """Random chains with one to several closed classes."""
    n = draw(st.integers(1, 9))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    A = rng.random((n, n)) * (rng.random((n, n)) < draw(st.sampled_from([0.15, 0.3, 0.9])))
    A[rng.integers(n, size=n), range(n)] += rng.random(n) + 0.1
    j, i = np.nonzero(A.T)
    return chain_from_arrays(list(range(n)), j, i, (A / A.sum(axis=0))[i, j], start=0)


@each_of(
    "chain",
    [
        *(ladder(n, stay=stay) for n in (7, 61, 121) for stay in (0.0, 1e-17, 1e-9, 0.1)),
        *(unbalanced(ladder(n)) for n in (7, 15)),
        *(chain_of([(k, (k + 1) % n, 1.0) for k in range(n)]) for n in (3, 7, 30)),
    ],
)
def test_no_eigenvalue_is_beyond_the_unit_circle(chain):
    values = spectrum(chain).values.tolist()
    assert max(map(abs, values)) <= 1.0
    assert values[0] == 1.0


class TestKnown:
    @pytest.mark.parametrize(("breaks", "second"), [(winner_breaks, 0.4), (loser_breaks, -0.4)])
    def test_series(self, breaks, second):
        """P5.24: the eigenvalues are (1, p1 + p2 - 1) and (1, 1 - p1 - p2)."""
        found = spectrum(chain_of(Series(Rack(0.9, 0.5), breaks=breaks)))
        np.testing.assert_allclose(found.values, [1.0, second], rtol=1e-14)
        assert found.gap == pytest.approx(0.6, rel=1e-14)

    def test_one_ball(self):
        """The text before P5.23: the eigenvalues are 1, 1 and +-sqrt(q1 q2)."""
        chain = chain_of(OneBall(0.3, 0.6))
        found = spectrum(chain)
        root = np.sqrt(0.7 * 0.4)
        np.testing.assert_allclose(found.values, [1.0, 1.0, root, -root], rtol=1e-14)
        W, L = chain.index("W"), chain.index("L")
        assert {tuple(np.flatnonzero(R.round(14))) for R in found.right[:, :2].T} == {(W,), (L,)}
        assert found.gap == pytest.approx(1 - root, rel=1e-14)

    def test_ahead_has_two_unit_eigenvalues(self):
        """The text after Fig. 5.10; the rest are 2 sqrt(p q) cos(k pi / 6)."""
        p = 0.6
        found = spectrum(chain_of(Ahead(3, 3, Rack(p))))
        rest = 2 * np.sqrt(p * (1 - p)) * np.cos(np.arange(1, 6) * np.pi / 6)
        np.testing.assert_allclose(np.sort(found.values), np.sort([1, 1, *rest]), atol=1e-14)
        assert found.units == 2

    def test_drill_has_one_unit_eigenvalue(self):
        found = spectrum(chain_of(Drill([0.9**i for i in range(9)])))
        assert found.units == 1
        assert np.sum(found.values > 1 - 1e-9) == 1

    def test_a_cycle_has_the_roots_of_one(self):
        found = spectrum(chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)], start=0))
        np.testing.assert_allclose(found.values**3, 1.0, atol=1e-14)
        np.testing.assert_allclose(found.limit(), 1 / 3, rtol=1e-14)
        assert found.gap == 1.0

    def test_nobody_ever_makes_it(self):
        found = spectrum(chain_of(OneBall(0, 0)))
        np.testing.assert_allclose(found.values, [1, -1], atol=1e-15)
        np.testing.assert_allclose(found.limit(), [0.5, 0.5], atol=1e-15)

    def test_one_state(self):
        found = spectrum(chain_of([("s", "s", 1.0)], start="s"))
        assert found.values.tolist() == [1.0]
        assert found.limit().tolist() == [1.0]

    def test_reals_where_all_are_real(self):
        assert spectrum(chain_of(OneBall(0.3, 0.6))).right.dtype == float
        assert spectrum(chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)])).right.dtype == complex


class TestLaws:
    @settings(max_examples=examples(60), deadline=None)
    @given(chains())
    def test_biorthogonal_eigenvectors(self, chain):
        try:
            found = spectrum(chain)
        except AccuracyError:
            assume(False)
        M = chain.matrix.toarray()
        np.testing.assert_allclose(found.left @ found.right, np.eye(len(chain)), atol=1e-8)
        np.testing.assert_allclose(M @ found.right, found.right * found.values, atol=1e-8)
        np.testing.assert_allclose(found.left @ M, found.values[:, None] * found.left, atol=1e-8)
        np.testing.assert_allclose(
            (found.right * found.values) @ found.left, M, atol=1e-7 * np.abs(found.left).max()
        )

    @settings(max_examples=examples(60), deadline=None)
    @given(chains())
    def test_the_two_routes_agree(self, chain):
        found = spectrum(chain, k=int(chain.structure.closed.sum()))
        direct = limit_matrix(chain).toarray()
        for state in chain.states:
            np.testing.assert_allclose(
                found.limit(state), direct[:, chain.index(state)], rtol=0, atol=found.limit_error
            )

    @settings(max_examples=examples(40), deadline=None)
    @given(chains())
    def test_unit_vectors_are_laws_and_chances(self, chain):
        found = spectrum(chain, k=int(chain.structure.closed.sum()))
        np.testing.assert_allclose(found.right.sum(axis=0), 1.0, rtol=1e-12)
        np.testing.assert_allclose(found.left.sum(axis=0), 1.0, rtol=1e-9)
        recurrent = chain.structure.recurrent
        np.testing.assert_allclose(found.right[~recurrent], 0.0, atol=1e-9)


class TestRefusals:
    def test_a_race_is_defective(self):
        chain = chain_of(Race(7, 7, Rack(0.6)))
        with pytest.raises(AccuracyError, match="defective"):
            spectrum(chain)
        limit = spectrum(chain, k=14).limit()
        np.testing.assert_allclose(limit, stochastic_limit(chain).probability, atol=1e-14)

    @pytest.mark.parametrize("coupling", [1e-3, 1e-6])
    def test_loosely_coupled_blocks_within_the_estimate(self, coupling):
        chain = blocks(coupling)
        found = spectrum(chain)
        assert error_of(found) <= found.limit_error < 1e-14
        assert found.gap == pytest.approx(2 * coupling, rel=1e-3)

    @pytest.mark.parametrize("coupling", [1e-10, 1e-13])
    def test_barely_coupled_blocks(self, coupling):
        """What LU factors lose, residuals in pairs of floats bring back."""
        found = spectrum(blocks(coupling))
        assert error_of(found) <= found.limit_error < 1e-14

    def test_uncoupled_but_for_rounding(self):
        with pytest.raises(AccuracyError, match="Use elimination"):
            spectrum(blocks(1e-17))

    def test_steep_ladder(self):
        """With one arc that is not balanced, all vectors but that of 1 are hidden by rounding."""
        chain = unbalanced(ladder(120))
        with pytest.raises(AccuracyError, match="independent eigenvectors"):
            spectrum(chain)
        found = spectrum(chain, k=1)
        error = np.abs(found.limit() - stochastic_limit(chain).probability).max()
        assert error <= found.limit_error < 1e-10

    def test_too_many_vectors(self):
        with pytest.raises(ChainError, match="400 pairs of vectors over 80001 states"):
            spectrum(chain_of(Race(200, 200, Rack(0.5, 0.5), breaks=winner_breaks)), k=400)

    def test_k(self):
        chain = chain_of(OneBall(0.3, 0.6))
        with pytest.raises(InputError, match="k must be a whole number, 2 or more; you gave 1"):
            spectrum(chain, k=1)
        with pytest.raises(InputError, match="at most 4, the number of states"):
            spectrum(chain, k=5)


class TestLarge:
    def test_against_the_dense_route(self, monkeypatch):
        chain = unbalanced(ladder(60, pull=30.0, stay=0.25))
        dense = spectrum(chain, k=4)
        for module in ("eigenpairs", "spectrum"):
            monkeypatch.setattr(sys.modules[f"evenbreak.chains.{module}"], "DENSE", 10)
        sparse = spectrum(chain, k=4)
        np.testing.assert_allclose(sparse.values, dense.values, rtol=1e-10)
        np.testing.assert_allclose(
            sparse.right[:, 1:2] @ sparse.left[1:2],
            dense.right[:, 1:2] @ dense.left[1:2],
            atol=1e-9,
        )
        assert sparse.limit_error == pytest.approx(dense.limit_error, rel=1.0)
        assert len(spectrum(chain).values) == 6

    def test_ladder(self):
        chain = ladder(2001, pull=100.0)
        found = spectrum(chain, k=1)
        limit = stochastic_limit(chain).probability
        assert np.abs(found.limit() - limit).max() <= found.limit_error <= 1e-8

    def test_a_long_fair_match(self):
        """The mean length, 490,000 racks, multiplies nothing but roundings."""
        chain = chain_of(Ahead(700, 700, Rack(0.5)))
        found = spectrum(chain, k=4)
        assert found.values[2:] == pytest.approx(np.cos(np.array([1, 2]) * np.pi / 1400), rel=1e-12)
        assert error_of(found) <= found.limit_error <= 1e-8


def error_of(found):
    """Return the largest sum of absolute errors of the limits from all states."""
    units = slice(found.units)
    error = np.abs(found.right[:, units] @ found.left[units] - limit_matrix(found.chain).toarray())
    return error.sum(axis=0).max()


def ring_of_blocks(coupling, k, size, rng):
    """k blocks of random arcs, and one rare arc from each to the next."""
    arcs = []
    for block in range(k):
        chances = rng.random((size, size)) + 0.05
        chances /= chances.sum(axis=1, keepdims=True)
        leave = coupling * rng.random()
        for j in range(size):
            left = leave if j == 0 else 0.0
            arcs += [((block, j), (block, i), chances[j, i] * (1 - left)) for i in range(size)]
        arcs.append(((block, 0), ((block + 1) % k, 0), leave))
    return arcs


COUPLINGS = [10.0**-e for e in range(3, 17)]


class TestNearlyDecoupled:
    """The error is within its bound, or the answer is refused: nothing is wrong in silence."""

    @each_of("e", COUPLINGS)
    def test_two_states_that_hardly_move(self, e):
        arcs = [("a", "a", 1 - e), ("a", "b", e), ("b", "b", 1 - 2 * e), ("b", "a", 2 * e)]
        found = spectrum(chain_of(arcs, start="a"))
        np.testing.assert_allclose(found.right[:, 0], [2 / 3, 1 / 3], rtol=1e-15)
        np.testing.assert_allclose(found.limit(), [2 / 3, 1 / 3], rtol=1e-15)
        assert found.limit_error < 1e-14

    @each_of("coupling", COUPLINGS)
    @each_of("k, size", [(2, 2), (2, 5), (3, 3), (5, 4), (2, 25)])
    def test_blocks(self, coupling, k, size):
        chain = chain_of(ring_of_blocks(coupling, k, size, np.random.default_rng(k * size)))
        try:
            found = spectrum(chain, k=1)
        except AccuracyError:
            assert coupling < 1e-10
            return
        assert error_of(found) <= found.limit_error
        assert found.limit_error <= 1e-12 / coupling

    @each_of("coupling", COUPLINGS)
    def test_transient_blocks(self, coupling):
        """Two ways out of a ring that is rarely left: the chances are what is hard."""
        arcs = ring_of_blocks(coupling, 3, 3, np.random.default_rng(7))
        arcs = [(j, i, p) if j != (0, 1) else (j, i, p * (1 - 3 * coupling)) for j, i, p in arcs]
        arcs += [((0, 1), "W", coupling), ((0, 1), "L", 2 * coupling)]
        try:
            found = spectrum(chain_of(arcs), k=2)
        except AccuracyError:
            assert coupling < 1e-10
            return
        assert error_of(found) <= found.limit_error

    @each_of("seed", range(60))
    def test_random_chains_with_arcs_over_many_decades(self, seed):
        rng = np.random.default_rng(seed)
        n = int(rng.integers(2, 20))
        A = rng.random((n, n)) * 10.0 ** -rng.uniform(0, 17, (n, n)) * (rng.random((n, n)) < 0.4)
        A[rng.permutation(n), range(n)] += 10.0 ** -rng.uniform(0, 17, n)
        np.fill_diagonal(A, 0.0)
        A /= np.maximum(A.sum(axis=0), 1.0)
        np.fill_diagonal(A, np.maximum(1.0 - A.sum(axis=0), 0.0))
        j, i = np.nonzero(A.T)
        chain = chain_from_arrays(list(range(n)), j, i, A[i, j], start=0)
        try:
            found = spectrum(chain, k=int(chain.structure.closed.sum()))
        except AccuracyError:
            return
        assert error_of(found) <= found.limit_error

    @each_of("coupling", COUPLINGS)
    def test_all_vectors_leave_those_of_one_alone(self, coupling):
        chain = chain_of(ring_of_blocks(coupling, 3, 3, np.random.default_rng(0)))
        try:
            found = spectrum(chain)
        except AccuracyError:
            assert coupling < 1e-9
            return
        assert error_of(found) <= found.limit_error
        assert np.sum(found.values == 1.0) >= 1
        np.testing.assert_allclose(found.left @ found.right, np.eye(9), atol=1e-8)


class TestPeriods:
    """Eigenvalues of modulus 1 are known from the structure, with their vectors."""

    @each_of("coupling", [0.1, *COUPLINGS])
    def test_two_pairs_that_are_hardly_joined(self, coupling):
        arcs = [(0, 1, 1 - coupling), (0, 3, coupling), (1, 0, 1.0), (3, 2, 1.0)]
        arcs += [(2, 3, 1 - 2 * coupling), (2, 1, 2 * coupling)]
        chain = chain_of(arcs)
        try:
            found = spectrum(chain)
        except AccuracyError:
            assert coupling < 1e-12
            return
        assert found.values[:2].tolist() == [1.0, -1.0]
        law = found.right[:, 0]
        parity = np.array([{0: 1, 1: -1, 3: -1, 2: 1}[s] for s in chain.states])
        np.testing.assert_array_equal(found.right[:, 1], law * parity)
        np.testing.assert_array_equal(found.left[1], parity)
        assert error_of(found) <= found.limit_error

    @settings(max_examples=examples(40), deadline=None)
    @given(st.lists(st.integers(1, 5), min_size=1, max_size=3), st.integers(0, 2**32 - 1))
    def test_rings_that_are_entered_from_outside(self, sizes, seed):
        rng = np.random.default_rng(seed)
        arcs = [((r, j), (r, (j + 1) % n), 1.0) for r, n in enumerate(sizes) for j in range(n)]
        ways = [(r, 0) for r in range(len(sizes))] + ["S", "T"]
        for state in ("S", "T"):
            chances = rng.dirichlet(np.ones(len(ways)))
            arcs += [(state, way, p) for way, p in zip(ways, chances, strict=True)]
        chain = chain_of(arcs)
        try:
            found = spectrum(chain)
        except AccuracyError:  # S and T may be defective
            found = spectrum(chain, k=sum(sizes))
        on_circle = found.values[: sum(sizes)]
        np.testing.assert_allclose(np.abs(on_circle), 1.0, atol=1e-15)
        roots = np.concatenate([np.exp(2j * np.pi * np.arange(n) / n) for n in sizes])
        assert np.prod(2.5 - on_circle) == pytest.approx(np.prod(2.5 - roots), rel=1e-12)
        assert np.all(np.abs(found.values[sum(sizes) :]) < 1.0 - 1e-9)
        assert found.residual < 1e-9

    def test_transient_states_that_go_round_for_ever_but_for_rounding(self):
        arcs = [("A", "B", 1.0), ("B", "A", 1.0), ("S", "T", 1.0), ("T", "S", 1.0)]
        chain = chain_of([*arcs, ("S", "A", 1e-17)])
        with pytest.raises(AccuracyError, match="Use elimination"):
            spectrum(chain)


# Reversible chains: every eigenvector, real and orthonormal, whatever decades the law spans.


CHARTS = ("npl_8", "npl_10", "npl_12", "npl_20")


def walk(n: int, pull: float, stay: float = 0.25) -> Chain:
    """A walk on n rungs that is pulled to the middle."""
    i = np.arange(n)
    up = (1.0 - stay) / (1.0 + 2.0 ** ((i - n // 2) / pull))
    down = (1.0 - stay) / (1.0 + 2.0 ** ((n // 2 - i) / pull))
    sources = np.concatenate((i[:-1], i[1:], i))
    targets = np.concatenate((i[1:], i[:-1], i))
    loops = np.full(n, stay)
    loops[0] += down[0]
    loops[-1] += up[-1]
    return chain_from_arrays(
        range(n), sources, targets, np.concatenate((up[:-1], down[1:], loops)), n // 2
    )


def grid(side: int, seed: int) -> Chain:
    """A walk on a square grid that is balanced by random weights."""
    draw = np.random.default_rng(seed)
    number = np.arange(side * side).reshape(side, side)
    one = np.concatenate((number[1:].ravel(), number[:, 1:].ravel()))
    other = np.concatenate((number[:-1].ravel(), number[:, :-1].ravel()))
    weight = 2.0 ** draw.integers(-20, 1, side * side)
    sources, targets = np.concatenate((one, other)), np.concatenate((other, one))
    chances = np.minimum(1.0, weight[targets] / weight[sources]) / 8
    loops = 1.0 - np.bincount(sources, chances)
    state = np.arange(side * side)
    return chain_from_arrays(
        range(side * side),
        np.concatenate((sources, state)),
        np.concatenate((targets, state)),
        np.concatenate((chances, loops)),
        0,
    )


def eigenpairs_in_extended_precision(chain: Chain) -> tuple[mpmath.matrix, mpmath.matrix]:
    """Eigenvalues of the symmetric form of a closed line, ascending, and their vectors."""
    with mpmath.workdps(40):
        n = len(chain)
        M = chain.matrix.toarray()
        S = mpmath.zeros(n)
        for j in range(n):
            arcs = [mpmath.mpf(float(M[i, j])) for i in range(n) if i != j]
            S[j, j] = 1 - mpmath.fsum(arcs) if M[j, j] else 0
            for i in range(n):
                if i != j and M[i, j]:
                    S[i, j] = mpmath.sqrt(mpmath.mpf(float(M[i, j])) * mpmath.mpf(float(M[j, i])))
        return mpmath.eigsy(S)


@pytest.mark.slow
@pytest.mark.parametrize(
    "chain",
    [walk(41, 30.0), walk(41, 2.0), *(chain_of(Ladder(chart(c), widest=15)) for c in CHARTS)],
    ids=["gentle", "steep", *CHARTS],
)
def test_against_dense_eigenpairs_in_extended_precision(chain: Chain) -> None:
    found = spectrum(chain)
    values, vectors = eigenpairs_in_extended_precision(chain)
    exact = np.array([float(v) for v in values])
    order = np.argsort(found.values)
    np.testing.assert_allclose(found.values[order], exact, rtol=0, atol=2e-15)
    Q = np.array(vectors.tolist(), dtype=float)
    overlap = np.abs((Q * found.orthonormal[:, order]).sum(axis=0))
    np.testing.assert_allclose(overlap, 1.0, rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", CHARTS)
def test_the_national_pool_leagues_ladders(name: str) -> None:
    chain = chain_of(Ladder(chart(name)))
    found = spectrum(chain)
    n = len(chain)
    assert n == 121
    assert found.values.shape == (n,)
    assert found.values.dtype == float
    assert len(np.unique(found.values.round(12))) == n
    assert found.residual < 1e-14
    np.testing.assert_allclose(
        found.orthonormal.T @ found.orthonormal, np.eye(n), rtol=0, atol=1e-14
    )
    law = stochastic_limit(chain).probability
    np.testing.assert_allclose(found.right[:, 0], law, rtol=2e-15)
    np.testing.assert_allclose(found.limit(), law, rtol=0, atol=1e-15)
    assert found.limit_error < 1e-14
    values, _ = np.linalg.eigh(chain.matrix.toarray() * np.sqrt(law) / np.sqrt(law)[:, None])
    np.testing.assert_allclose(np.sort(found.values), values, rtol=0, atol=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "points", "widest"),
    [*((name, 30, 60) for name in CHARTS), ("npl_20", 120, 960)],
)
def test_chart_ladders_in_extended_precision(name: str, points: int, widest: int) -> None:
    """Residuals r of n orthonormal vectors put each value within r of an eigenvalue of S."""
    system = replace(system_of("npl"), scale=scale_of(str(points)))
    chain = chain_of(Ladder(system, chart(name), widest=widest))
    found = spectrum(chain)
    n = len(chain)
    assert n == 2 * widest + 1
    assert found.values.shape == (n,)
    assert found.values.dtype == float
    Q, M = found.orthonormal, chain.matrix
    np.testing.assert_allclose(Q.T @ Q, np.eye(n), rtol=0, atol=3e-14)
    inside, up, down = (M.diagonal(k).astype(np.longdouble) for k in (0, -1, 1))
    beside = np.sqrt(up) * np.sqrt(down)
    residual = Q * (inside[:, None] - found.values)
    residual[:-1] += beside[:, None] * Q[1:]
    residual[1:] += beside[:, None] * Q[:-1]
    assert np.sqrt((residual**2).sum(axis=0)).max() < 5e-14
    law = stochastic_limit(chain).probability
    np.testing.assert_allclose(found.limit(), law, rtol=0, atol=1e-15)


@pytest.mark.parametrize("n", [511, 1023])
def test_wide_ladders(n: int) -> None:
    chain = walk(n, 30.0)
    found = spectrum(chain)
    assert found.orthonormal.shape == (n, n)
    assert found.residual < 1e-13
    assert found.values[0] == 1.0
    np.testing.assert_allclose(
        found.limit(), stochastic_limit(chain).probability, rtol=1e-13, atol=1e-300
    )


@pytest.mark.slow
def test_a_law_that_no_float_can_hold() -> None:
    chain = walk(1921, 5.0)
    found = spectrum(chain)
    assert found.residual < 1e-13
    np.testing.assert_allclose(found.limit(), stochastic_limit(chain).probability, atol=1e-15)
    with pytest.raises(AccuracyError, match="orthonormal"):
        _ = found.left


@pytest.mark.parametrize("n", [3000, 20_001])
def test_a_few_pairs_of_a_long_line(n: int) -> None:
    chain = walk(n, 300.0)
    found = spectrum(chain)
    assert found.values.shape == (6,)
    assert found.residual < 1e-13
    assert (np.diff(found.values) < 0).all()


def test_a_grid_is_reversible_and_not_a_line() -> None:
    chain = grid(9, seed=1)
    found = spectrum(chain)
    assert found.residual < 1e-14
    M = chain.matrix.toarray()
    np.testing.assert_allclose(M @ found.right, found.right * found.values, atol=1e-14)
    np.testing.assert_allclose((found.right * found.values) @ found.left, M, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.limit(), stochastic_limit(chain).probability, atol=1e-14)


def test_a_match_n_ahead_between_its_two_ends() -> None:
    """P5.27: dense eigensolvers find no 99 vectors of it, the symmetric form has all of them."""
    chain = chain_of(Ahead(50, 50, Rack(0.8)))
    found = spectrum(chain)
    n = len(chain)
    assert found.values.shape == (n,)
    rest = 2 * np.sqrt(0.8 * 0.2) * np.cos(np.arange(1, n - 1) * np.pi / (n - 1))
    np.testing.assert_allclose(np.sort(found.values[2:]), np.sort(rest), rtol=0, atol=1e-14)
    M = chain.matrix.toarray()
    np.testing.assert_allclose(
        M @ found.right, found.right * found.values, atol=1e-13 * abs(found.right).max()
    )
    np.testing.assert_allclose(found.limit(), stochastic_limit(chain).probability, atol=1e-14)


def test_one_ball_has_two_states_between_two_ends() -> None:
    chain = chain_of(OneBall(0.3, 0.6))
    found = spectrum(chain)
    M = chain.matrix.toarray()
    np.testing.assert_allclose(M @ found.right, found.right * found.values, atol=1e-15)
    np.testing.assert_allclose(found.left @ found.right, np.eye(4), atol=1e-15)


@pytest.mark.parametrize("rare", [1e-3, 1e-9, 1e-15, 1e-16, 1e-20, 1e-200])
@pytest.mark.filterwarnings("error")
def test_states_that_are_hardly_ever_left(rare: float) -> None:
    """An eigenvalue may differ from 1 by less than a double can tell."""
    arcs = [
        ("a", "b", rare),
        ("a", "V", rare / 4),
        ("a", "W", rare / 2),
        ("a", "a", 1 - 1.75 * rare),
    ]
    found = spectrum(chain_of([*arcs, ("b", "a", 0.5), ("b", "b", 0.5)], start="a"))
    M = found.chain.matrix.toarray()
    np.testing.assert_allclose(
        M @ found.right, found.right * found.values, atol=1e-15 * abs(found.right).max()
    )
    np.testing.assert_allclose(found.left @ found.right, np.eye(4), atol=1e-14)


def test_weights_of_a_line_are_its_law() -> None:
    chain = walk(200, 3.0)
    form = symmetric_form(chain, np.arange(200))
    assert form is not None
    law = stochastic_limit(chain).probability
    assert form.roots**2 == pytest.approx(law, rel=2e-15, abs=1e-300)


@pytest.mark.parametrize(
    "arcs",
    [
        [(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)],  # one way round
        [(j, (j + s) % 3, 0.5 + s * 0.1) for j in range(3) for s in (1, -1)],  # faster one way
    ],
    ids=["one way", "faster one way"],
)
def test_what_goes_round_is_not_reversible(arcs) -> None:
    chain = chain_of([(j, i, p) for j, i, p in arcs])
    assert symmetric_form(chain, np.arange(3)) is None
    assert spectrum(chain).orthonormal is None


def test_two_transient_classes_are_not_served() -> None:
    arcs = [("s", "t", 0.5), ("s", "end", 0.5), ("t", "end", 1.0)]
    assert reversible_classes(chain_of(arcs)) is None


def test_several_closed_classes() -> None:
    arcs = [("a", "b", 0.5), ("a", "a", 0.5), ("b", "a", 1.0), ("c", "d", 1.0), ("d", "c", 1.0)]
    found = spectrum(chain_of([*arcs, ("e", "e", 1.0)], start="a"))
    assert found.units == 3
    np.testing.assert_allclose(found.values, [1, 1, 1, -1, -0.5], rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.limit(), [2 / 3, 1 / 3, 0, 0, 0], atol=1e-15)
    np.testing.assert_allclose(found.left @ found.right, np.eye(5), atol=1e-15)
