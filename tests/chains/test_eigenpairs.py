"""Leading pairs and the roots of 1, by hand and by their equations."""

import time
from fractions import Fraction

import numpy as np
import pytest

import oracle
from evenbreak.chains import Chain, chain_from_arrays, chain_of, spectrum, stochastic_limit
from evenbreak.chains.eigenpairs import UnitPairs, leading_pairs, limit_by, roots_of_one
from evenbreak.errors import AccuracyError
from evenbreak.games import BREAK_FORMATS, CATALOG, Ahead, Drill, OneBall, Race, Rack
from rows import each_of
from tries import tries

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


# The vectors of eigenvalue 1 and their limit: against fractions, within bounds that are sharp.


SHARP = 1e-14


def test_they_are_laws_and_chances() -> None:
    units = UnitPairs(CHAIN)
    by_state = dict(zip(CHAIN.states, zip(units.right, units.left.T, strict=True), strict=True))
    won = int(np.argmax(by_state["W"][0]))
    assert by_state["W"][0][won] == 1.0
    assert [by_state[s][0][1 - won] for s in "abc"] == pytest.approx([1 / 3] * 3, rel=1e-15)
    assert by_state["S"][1] == pytest.approx([0.5, 0.5], rel=1e-15)
    assert units.error < SHARP


def errors_from(chain: Chain, density: np.ndarray, exact: list[Fraction]) -> list[tuple]:
    """Return the true sum of errors and the bound, of the limit by one solve and by all vectors."""
    units, limit = UnitPairs(chain), stochastic_limit(chain, density, via="eigen")
    found = [
        (limit.probability, limit.bound),
        (limit_by(units.right, units.left, density), units.error),
    ]
    return [
        (
            float(sum(abs(Fraction(p) - q) for p, q in zip(limit.tolist(), exact, strict=True))),
            error,
        )
        for limit, error in found
    ]


def periodic(draw: np.random.Generator) -> np.ndarray:
    """Two or three groups of states, each entered from the one before."""
    d, m = int(draw.integers(2, 4)), int(draw.integers(1, 4))
    A = np.zeros((d * m, d * m))
    for phase in range(d):
        here, there = phase * m, (phase + 1) % d * m
        A[there : there + m, here : here + m] = draw.random((m, m)) + 0.01
    return A


def falling_apart(draw: np.random.Generator) -> np.ndarray:
    """Blocks that are rarely left, and may not be come back to."""
    k, m = int(draw.integers(2, 4)), int(draw.integers(1, 4))
    rare = 10.0 ** -draw.uniform(3.0, 11.0)
    A = np.kron(np.eye(k), draw.random((m, m)) + 0.1)
    return A + rare * draw.random(A.shape) * (draw.random(A.shape) < 0.3)


def passing_through(draw: np.random.Generator) -> np.ndarray:
    """A few arcs out of each state, over six decades, and several ways to end."""
    n = int(draw.integers(3, 11))
    A = 10.0 ** -draw.uniform(0.0, 6.0, (n, n)) * (draw.random((n, n)) < 2.0 / n)
    A[:, : int(draw.integers(1, 3))] = 0.0
    return A


KINDS = {kind.__name__: kind for kind in (periodic, falling_apart, passing_through)}


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS.keys())
def test_the_bounds_hold_against_fractions_and_are_sharp(kind) -> None:
    for seed in range(tries("limits by eigenvectors", 25, parts=3)):
        draw = np.random.default_rng(seed)
        A = kind(draw)
        A[:, A.any(axis=0)] /= A.sum(axis=0)[A.any(axis=0)]
        target, source = np.nonzero(A)
        chain = chain_from_arrays(range(len(A)), source, target, A[target, source], 0)
        density = draw.dirichlet(np.ones(len(A)))
        columns = oracle.columns_of(chain)
        exact = oracle.limit(columns, {j: Fraction(p) for j, p in enumerate(density.tolist())})
        for missed, bound in errors_from(chain, density, exact):
            assert missed <= bound <= SHARP, seed


def test_many_ways_into_one_class_are_added_up_without_loss() -> None:
    """From S to any of 300 states of a ring, or to W: what ends in the ring is a long sum."""
    n, draw = 300, np.random.default_rng(0)
    chances = draw.dirichlet(np.ones(n + 1))
    arcs = [("S", k, p) for k, p in enumerate(chances[:n].tolist())]
    chain = chain_of([*arcs, ("S", "W", chances[n]), *((k, (k + 1) % n, 1.0) for k in range(n))])
    columns = oracle.columns_of(chain)
    out = columns[chain.index("S")]
    share = sum(p for i, p in out.items() if i != chain.index("W")) / sum(out.values())
    exact = [share / n if isinstance(state, int) else Fraction(0) for state in chain.states]
    exact[chain.index("W")] = 1 - share
    for missed, bound in errors_from(chain, chain.density("S"), exact):
        assert missed <= bound <= SHARP


@pytest.mark.parametrize(("m", "n"), [(1, 1), (7, 5), (25, 25)])
def test_the_bound_of_a_race_holds_against_fractions(m, n) -> None:
    """From the first rack, and from any score."""
    chain = chain_of(Race(m, n, Rack(0.55)))
    anywhere = np.full(len(chain), 1.0 / len(chain))
    for density in (chain.density(), anywhere):
        for missed, bound in errors_from(chain, density, exact_limit_of(chain, density)):
            assert missed <= bound <= SHARP


def exact_limit_of(chain: Chain, density: np.ndarray) -> list[Fraction]:
    """Return the limit of a chain without cycles in fractions, by following its states."""
    columns = oracle.columns_of(chain)
    mass = [Fraction(p) for p in density.tolist()]
    for j in chain.structure.order.tolist():  # upstream first
        out = sum(columns[j].values())
        for i, p in columns[j].items():
            mass[i] += mass[j] * p / out
        if out:
            mass[j] = Fraction(0)
    return mass


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("breaks", [None, *BREAK_FORMATS])
def test_a_race_to_150_is_answered_and_its_bound_does_not_grow(breaks) -> None:
    rack = Rack(0.55) if breaks is None else Rack(0.55, 0.5)
    order = {} if breaks is None else {"breaks": BREAK_FORMATS[breaks]}
    chain = chain_of(Race(150, 150, rack, **order))
    limit, bound = UnitPairs(chain).limit(chain.density())
    assert bound < SHARP
    assert np.abs(limit - stochastic_limit(chain).probability).sum() < 1e-13
    found = stochastic_limit(chain, via="eigen")
    assert (found.probability.tolist(), found.bound) == (limit.tolist(), bound)


SLOW = {
    "500 ahead": Ahead(500, 500, Rack(0.5)),
    "200 ahead, breaks": Ahead(200, 200, Rack(0.501, 0.5), breaks=BREAK_FORMATS["winner"]),
    "a long drill": Drill([0.5] * 10_000),
    "a steep drill": Drill([0.9] * 5_000),
    "one ball in a billion": OneBall(1e-9, 1e-9),
}


@each_of("game", [*CATALOG.values(), *SLOW.values()])
def test_every_game_is_answered_within_a_sharp_bound(game) -> None:
    chain = chain_of(game)
    limit, bound = UnitPairs(chain).limit(chain.density())
    assert bound < SHARP
    assert np.abs(limit - stochastic_limit(chain).probability).sum() < SHARP


def test_what_cannot_be_bounded_is_refused_by_name() -> None:
    """Left once in 10^17 steps: 1 less a chance to stay is 0 in floats."""
    chain = chain_of(OneBall(1e-17, 1e-17))
    with pytest.raises(AccuracyError, match="Use elimination"):
        UnitPairs(chain).limit(chain.density())


def test_what_would_take_too_long_is_refused_at_once() -> None:
    """Three arcs at random out of each of 30,000 states: nothing cuts them in two."""
    n, draw = 30_000, np.random.default_rng(0)
    source, target = np.repeat(np.arange(n), 3), draw.integers(0, n, (n, 3))
    target[:, 0] = np.roll(np.arange(n), -1)
    arcs = np.unique(source * n + target.ravel())
    chances = 1.0 / np.bincount(arcs // n)[arcs // n]
    chain = chain_from_arrays(range(n), arcs // n, arcs % n, chances, 0)
    begun = time.process_time()
    with pytest.raises(AccuracyError, match=r"29,999 states that can't be split .*Use elimination"):
        stochastic_limit(chain, via="eigen")
    assert time.process_time() - begun < 3.0


def test_only_what_the_start_reaches_must_be_certain() -> None:
    """Two pairs of states that hardly come apart are no matter for who never comes there."""
    arcs = [("A", "B", 1.0), ("B", "A", 1.0), ("S", "T", 1.0), ("T", "S", 1.0), ("S", "A", 1e-17)]
    chain = chain_of(arcs)
    limit, bound = UnitPairs(chain).limit(chain.density("A"))
    assert bound < SHARP
    assert limit[[chain.index("A"), chain.index("B")]].tolist() == [0.5, 0.5]
    with pytest.raises(AccuracyError):
        UnitPairs(chain).limit(chain.density("S"))


def test_it_needs_no_longer_type_than_a_double(monkeypatch) -> None:
    monkeypatch.delattr(np, "longdouble")
    for game in (Race(7, 5, Rack(0.55)), Ahead(5, 5, Rack(0.6)), Drill([0.5] * 9)):
        chain = chain_of(game)
        limit, bound = UnitPairs(chain).limit(chain.density())
        found = spectrum(chain, k=int(chain.structure.closed.sum()))
        assert np.abs(found.limit() - limit).sum() <= bound + found.limit_error < SHARP
