"""Limits, absorption, visits and stationary laws of whole chains, against exact arithmetic."""

import random
from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import (
    Chain,
    absorption,
    chain_of,
    expected_visits,
    factorisation,
    limit_matrix,
    propagate,
    stationary_laws,
    stochastic_limit,
)
from evenbreak.errors import AccuracyError, ChainError


def random_chain(draw):
    """Return a chain of any structure: closed classes, cycles, absorbing and lone states."""
    n = draw.randint(1, 16)
    matrix = np.zeros((n, n))
    decades = draw.choice([0.3, 12])
    for j in range(n):
        targets = draw.sample(range(n), draw.randint(0, min(3, n)))
        weights = [10.0 ** -draw.uniform(0, decades) for _ in targets]
        matrix[targets, j] = np.array(weights) / (sum(weights) or 1.0)
        if not targets:
            matrix[j, j] = 1.0
    return Chain(range(n), csc_array(matrix), 0)


@pytest.mark.parametrize("seed", range(60))
def test_every_start_of_random_chains(seed):
    chain = random_chain(random.Random(seed))
    columns = oracle.columns_of(chain)
    table = limit_matrix(chain).toarray()
    for start in range(len(chain)):
        density = {start: Fraction(1)}
        exact = oracle.limit(columns, density)
        limit = stochastic_limit(chain, start)
        assert oracle.worst_relative_error(limit.probability, exact) < 5e-15
        assert oracle.worst_relative_error(table[:, start], exact) < 5e-15
        reached = {c: p for c, p in oracle.absorption(columns, density).items() if p}
        ends = absorption(chain, start)
        for states, mass in reached.items():
            label = chain.structure.label[min(states)]
            assert ends[label] == pytest.approx(float(mass), rel=5e-15)
        assert np.count_nonzero(ends) == len(reached)
        periods = [oracle.period(chain, states) for states in reached]
        assert limit.period == np.lcm.reduce(periods)
        assert limit.is_cesaro == (limit.period > 1)
        assert limit.residual is None
        visits = expected_visits(chain, start)
        for j, x in oracle.visits(columns, density).items():
            assert visits[j] == pytest.approx(float(x), rel=5e-15)
        closed = {j for states in reached for j in states}
        assert set(np.flatnonzero(np.isinf(visits)).tolist()) == closed


def test_a_density_is_the_mixture_of_its_states():
    chain = random_chain(random.Random(11))
    rng = np.random.default_rng(0)
    v = rng.dirichlet(np.ones(len(chain)))
    mixed = limit_matrix(chain) @ v
    assert stochastic_limit(chain, v).probability == pytest.approx(mixed, rel=1e-13)
    as_mapping = dict(enumerate(v.tolist()))
    assert stochastic_limit(chain, as_mapping).to_dict() == pytest.approx(
        dict(enumerate(mixed.tolist())), rel=1e-13
    )


def test_the_limit_answers_by_state():
    matrix = csc_array([[0.0, 0, 0], [0.25, 1, 0], [0.75, 0, 1]])
    limit = stochastic_limit(Chain(("start", "W", "L"), matrix, "start"))
    assert limit["W"] == 0.25
    assert limit.to_dict() == {"start": 0.0, "W": 0.25, "L": 0.75}
    with pytest.raises(ChainError):
        limit["draw"]


@pytest.mark.parametrize("length", [1, 2, 3, 6])
def test_a_circle_spends_as_long_everywhere(length):
    circle = Chain(range(length), csc_array(np.roll(np.eye(length), 1, axis=0)), 0)
    limit = stochastic_limit(circle)
    assert limit.probability == pytest.approx(np.full(length, 1 / length), rel=1e-15)
    assert limit.period == length


def test_the_period_is_that_of_the_classes_reached():
    blocks = np.zeros((8, 8))
    blocks[0, 1] = blocks[1, 0] = 1.0
    blocks[3, 2] = blocks[4, 3] = blocks[2, 4] = 1.0
    blocks[5, 5] = 1.0
    blocks[[0, 2], 6] = 0.5
    blocks[[0, 5], 7] = 0.5
    chain = Chain(range(8), csc_array(blocks))
    assert [stochastic_limit(chain, j).period for j in (0, 3, 5, 6, 7)] == [2, 3, 1, 6, 2]


def test_classes_out_of_reach_are_not_solved(monkeypatch):
    """The ring of 70 states is above the size of a small class, and must not be touched."""
    ring = np.roll(np.eye(70), 1, axis=0) * 0.5 + np.roll(np.eye(70), -2, axis=0) * 0.5
    matrix = np.zeros((78, 78))
    matrix[:70, :70] = ring
    matrix[70:77, 70:77] = np.roll(np.eye(7), 1, axis=0)
    matrix[[0, 70], 77] = 0.5
    chain = Chain(range(78), csc_array(matrix))

    def fail(*_args):
        raise AssertionError("a class out of reach was factored")

    monkeypatch.setattr("evenbreak.chains.transient._FEW_ARCS", 0)
    monkeypatch.setattr(factorisation, "DecimalElimination", fail)
    assert stochastic_limit(chain, 71).probability[70:77] == pytest.approx(np.full(7, 1 / 7))
    with pytest.raises(AssertionError, match="out of reach"):
        stochastic_limit(chain, 77)


def test_laws_of_all_closed_classes_stand_side_by_side():
    matrix = np.array([[0.5, 0.25, 0], [0.5, 0.75, 0], [0, 0, 1.0]])
    chain = Chain(range(3), csc_array(matrix))
    assert stationary_laws(chain) == pytest.approx([1 / 3, 2 / 3, 1.0])


def two_step_walk(n, up, down, shuffle):
    """Return a walk by one and two steps, not a line, its states shuffled; one closed class."""
    matrix = np.zeros((n, n))
    i = np.arange(n)
    for step, share in ((1, 0.6), (2, 0.4)):
        matrix[i[step:], i[:-step]] = share * up[:-step]
        matrix[i[:-step], i[step:]] = share * down[step:]
    place = np.random.default_rng(shuffle).permutation(n)
    matrix = oracle.with_loops(csc_array(matrix[place][:, place]))
    return Chain(range(n), matrix, 0), np.argsort(place)


@pytest.mark.parametrize("plain", [True, False])
@pytest.mark.parametrize("shuffle", range(4))
@pytest.mark.parametrize("shape", ["slope", "hill", "valley", "cliffs"])
def test_laws_over_more_decades_than_floats(monkeypatch, shape, shuffle, plain):
    if not plain:
        monkeypatch.setattr("evenbreak.chains.transient._FEW_ARCS", 0)
    n = 22
    up, down = np.full(n, 0.4), np.full(n, 1e-40)
    if shape == "slope":
        up, down = down, up
    elif shape == "hill":
        up[n // 2 :], down[n // 2 :] = 1e-40, 0.4
    elif shape == "valley":
        up[: n // 2], down[: n // 2] = 1e-40, 0.4
    else:
        up[::3], down[1::3] = 1e-120, 1e-60
    chain, _ = two_step_walk(n, up, down, shuffle)
    exact = oracle.limit(oracle.columns_of(chain), {0: Fraction(1)})
    assert min(x for x in exact if x) < Fraction(1, 10**100)
    assert oracle.worst_relative_error(stochastic_limit(chain).probability, exact) < 1e-14


def test_a_long_law_over_a_thousand_decades():
    n = 700
    chain, order = two_step_walk(n, np.full(n, 0.004), np.full(n, 0.5), 1)
    law = stochastic_limit(chain).probability[order]
    assert law.sum() == pytest.approx(1.0, rel=1e-14)
    matrix = csc_array(chain.matrix[:, order])[order].toarray()
    flow = np.minimum(law, 1)[None, :] * matrix
    # In a line of cuts, as much goes up as comes down; each entry above 1e-290 shows in one.
    for cut in range(1, 100):
        assert flow[cut:, :cut].sum() == pytest.approx(flow[:cut, cut:].sum(), rel=1e-12)
    assert law[-1] == 0.0


def test_a_law_too_wide_and_too_large_is_refused(monkeypatch):
    monkeypatch.setattr("evenbreak.chains.decimal_elimination._MOST_ARCS", 100)
    n = 60
    chain, _ = two_step_walk(n, np.full(n, 1e-30), np.full(n, 0.5), 2)
    with pytest.raises(AccuracyError, match="span more decades than floats"):
        stochastic_limit(chain)


def test_a_shuffled_line_is_known_for_a_line():
    n = 3_000
    place = np.random.default_rng(3).permutation(n)
    up, down = np.full(n - 1, 0.002), np.full(n - 1, 0.5)
    i = np.arange(n - 1)
    rows, columns = np.concatenate((i + 1, i)), np.concatenate((i, i + 1))
    matrix = csc_array((np.concatenate((up, down)), (place[rows], place[columns])), (n, n))
    law = stochastic_limit(Chain(range(n), oracle.with_loops(matrix)), 0).probability[place]
    for k in (0, 1, 60, 120):
        exact = Fraction(0.002) ** k / Fraction(0.5) ** k * (1 - Fraction(0.002) / Fraction(0.5))
        assert law[k] == pytest.approx(float(exact), rel=1e-13)


def torus(k, rng):
    place = np.arange(k * k).reshape(k, k)
    rows = np.concatenate([np.roll(place, s, axis).ravel() for s in (1, -1) for axis in (0, 1)])
    columns = np.tile(place.ravel(), 4)
    chances = rng.random(4 * k * k)
    chances /= np.bincount(columns, chances)[columns]
    return Chain(range(k * k), csc_array((chances, (rows, columns))), 0)


def test_a_large_class_carries_its_residual_unless_certified(monkeypatch):
    chain = torus(16, np.random.default_rng(2))
    exact = stochastic_limit(chain)
    assert exact.residual is None
    monkeypatch.setattr(factorisation, "_MOST_ENTRIES", 0)
    monkeypatch.setattr("evenbreak.chains.certified_lu.GUARANTEED", 0.0)
    carried = stochastic_limit(Chain(chain.states, chain.matrix, 0))
    assert 0 < carried.residual < 1e-15
    assert carried.probability == pytest.approx(exact.probability, rel=1e-12)
    monkeypatch.undo()
    monkeypatch.setattr(factorisation, "_MOST_ENTRIES", 0)
    certified = stochastic_limit(Chain(chain.states, chain.matrix, 0))
    if np.finfo(np.longdouble).eps < np.finfo(float).eps:  # else it cannot be certified
        assert certified.residual is None
    assert certified.probability == pytest.approx(exact.probability, rel=1e-12)


def test_two_blocks_that_hardly_meet():
    """The odds between the blocks are those of the two arcs that join them."""
    rng = np.random.default_rng(9)
    size, there, back = 80, 1e-10, 3e-10
    matrix = np.zeros((2 * size, 2 * size))
    matrix[:size, :size], matrix[size:, size:] = rng.random((2, size, size))
    np.fill_diagonal(matrix, 0.0)
    matrix /= matrix.sum(axis=0)
    matrix[size, 0], matrix[5, 2 * size - 1] = there, back
    limit = stochastic_limit(Chain(range(2 * size), csc_array(matrix), 0)).probability
    assert limit[0] * there == pytest.approx(limit[-1] * back, rel=1e-13)
    inflow = matrix @ limit
    outflow = matrix.sum(axis=0) * limit
    assert inflow == pytest.approx(outflow, rel=1e-12)


def test_a_hundred_thousand_steps_without_a_cycle():
    """A long way with an exit at each step, numbered backwards: one substitution."""
    n = 100_000
    j = np.arange(n)
    stay = 1 - 1e-5
    entries = np.concatenate((np.full(n, stay), np.full(n, 1e-5), [1.0, 1.0]))
    sources = np.concatenate((j + 2, j + 2, [0, 1]))
    targets = np.concatenate((np.where(j == 0, 1, j + 1), np.zeros(n, int), [0, 1]))
    matrix = csc_array((entries, (targets, sources)), (n + 2, n + 2))
    chain = Chain(range(n + 2), matrix, n + 1)
    limit = stochastic_limit(chain)
    through = float((Fraction(stay) / (Fraction(stay) + Fraction(1e-5))) ** 1000) ** (n / 1000)
    assert limit[1] == pytest.approx(through, rel=1e-11)
    assert limit[0] == pytest.approx(1 - through, rel=1e-11)


@pytest.mark.parametrize("plain", [True, False])
@pytest.mark.parametrize("seed", range(60))
def test_arcs_down_to_the_smallest_floats_are_answered_right_or_refused(monkeypatch, seed, plain):
    """Where products of arcs underflow, no answer may be wrong without a word."""
    if not plain:
        monkeypatch.setattr("evenbreak.chains.transient._FEW_ARCS", 0)
        monkeypatch.setattr(factorisation, "SMALL", 1 + seed % 3)
    draw = random.Random(seed)
    n = draw.randint(3, 10)
    matrix = np.zeros((n, n))
    for j in range(n):
        for i in draw.sample(range(n), draw.randint(0, 3)):
            matrix[i, j] = 10.0 ** -draw.uniform(0.7, 320) if i != j else 0.0
        matrix[j, j] = 1.0 - matrix[:, j].sum()
    chain = Chain(range(n), csc_array(matrix))
    columns = oracle.columns_of(chain)
    for start in range(n):
        exact = oracle.limit(columns, {start: Fraction(1)})
        questions = [
            lambda start=start: stochastic_limit(chain, np.eye(n)[start]).probability,
            lambda start=start: limit_matrix(chain).toarray()[:, start],
        ]
        for question in questions:
            try:
                found = question()
            except AccuracyError:
                continue
            assert oracle.worst_relative_error(found, exact) < 1e-13


def test_a_pivot_below_the_normal_floats_costs_no_digits():
    """State 1 is left to 0 so rarely that, state 2 eliminated, the leak is 1.3e-321."""
    matrix = np.zeros((3, 3))
    matrix[1, 0], matrix[0, 1] = 1.0112438985080776e-63, 6.259655927104364e-250
    matrix[2, 1], matrix[1, 2] = 1.587351888423493e-15, 3.237253001853969e-87
    chain = Chain(range(3), oracle.with_loops(csc_array(matrix)))
    exact = oracle.limit(oracle.columns_of(chain), {0: Fraction(1)})
    found = stochastic_limit(chain, np.array([1.0, 0.0, 0.0])).probability
    assert oracle.worst_relative_error(found, exact) < 1e-14


class TestMapping:
    """A limit reads like a dictionary from states to probabilities."""

    chain = chain_of([("rack", "won", 0.75), ("rack", "lost", 0.25)], start="rack")
    limit = stochastic_limit(chain)

    def test_all_at_once(self):
        told = {"rack": 0.0, "won": 0.75, "lost": 0.25}
        assert dict(self.limit) == told == self.limit
        assert list(self.limit) == ["rack", "won", "lost"]
        assert len(self.limit) == 3
        assert list(self.limit.values()) == [0.0, 0.75, 0.25]
        assert self.limit.to_dict() == told

    def test_one_by_one(self):
        assert "won" in self.limit
        assert "drawn" not in self.limit
        assert [] not in self.limit
        assert self.limit.get("won") == 0.75
        assert self.limit.get("drawn") is None
        with pytest.raises(ChainError, match="state 'drawn' is not in the chain"):
            self.limit["drawn"]

    def test_a_limit_is_a_start(self):
        assert propagate(self.chain, self.limit, 5).tolist() == self.limit.probability.tolist()

    def test_repr(self):
        assert repr(self.limit) == (
            "<Limit over 3 states, period=1: 'won': 0.75, 'lost': 0.25, 'rack': 0>"
        )
        ring = stochastic_limit(chain_of([(k, (k + 1) % 8, 1.0) for k in range(8)]), 0)
        assert repr(ring) == (
            "<Limit over 8 states, period=8: 0: 0.125, 1: 0.125, 2: 0.125, 3: 0.125, 4: 0.125, ...>"
        )
        assert repr(self.chain) == "<Chain of 3 states, 4 arcs, start 'rack'>"
        assert repr(ring.chain) == "<Chain of 8 states, 8 arcs, start None>"
