"""Limits of whole chains, against exact arithmetic."""

import random
from fractions import Fraction

import networkx as nx
import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import (
    Chain,
    absorption,
    chain_from_arrays,
    chain_of,
    expected_visits,
    factorization,
    limit_matrix,
    limit_of,
    propagate,
    stochastic_limit,
)
from evenbreak.chains.ways import WAYS
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.game import graph_of
from evenbreak.games import Drill, OneBall, Race, Rack
from rows import each_of


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


@pytest.mark.slow
@each_of("seed", range(60))
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
            label = min(states) if len(states) == 1 else tuple(sorted(states))
            assert ends[label] == pytest.approx(float(mass), rel=5e-15)
        assert np.count_nonzero(ends) == len(reached)
        periods = [oracle.period(chain, states) for states in reached]
        assert limit.period == np.lcm.reduce(periods)
        assert limit.is_cesaro == (limit.period > 1)
        assert (limit.bound or 0.0) < 1e-15
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

    class Fail(factorization.CertifiedSolve):
        def __init__(self, *_args, **_kinds):
            raise AssertionError("a class out of reach was factored")

    monkeypatch.setattr("evenbreak.chains.transient._FEW_ARCS", 0)
    monkeypatch.setattr(factorization, "CertifiedSolve", Fail)
    assert stochastic_limit(chain, 71).probability[70:77] == pytest.approx(np.full(7, 1 / 7))
    with pytest.raises(AssertionError, match="out of reach"):
        stochastic_limit(chain, 77)


def torus(k, rng):
    place = np.arange(k * k).reshape(k, k)
    rows = np.concatenate([np.roll(place, s, axis).ravel() for s in (1, -1) for axis in (0, 1)])
    columns = np.tile(place.ravel(), 4)
    chances = rng.random(4 * k * k)
    chances /= np.bincount(columns, chances)[columns]
    return Chain(range(k * k), csc_array((chances, (rows, columns))), 0)


@pytest.mark.parametrize("much", [-1.0, np.inf])
def test_a_large_class_carries_a_proved_bound(monkeypatch, much):
    chain = torus(16, np.random.default_rng(2))
    exact = stochastic_limit(chain)
    assert exact.bound is None
    monkeypatch.setattr(factorization, "_FEW", 0)
    monkeypatch.setattr(factorization, "_MUCH_WORK", much)
    proved = stochastic_limit(Chain(chain.states, chain.matrix, 0))
    assert 0.0 < proved.bound < 5e-16
    assert proved.probability == pytest.approx(exact.probability, rel=2e-14)
    assert f"bound={proved.bound:.3g}" in repr(proved)


@pytest.mark.slow_after(40)
@pytest.mark.parametrize("plain", [True, False])
@pytest.mark.parametrize("seed", range(60))
def test_arcs_down_to_the_smallest_floats_are_answered_right_or_refused(monkeypatch, seed, plain):
    """Where products of arcs underflow, no answer may be wrong without a word."""
    if not plain:
        monkeypatch.setattr("evenbreak.chains.transient._FEW_ARCS", 0)
        monkeypatch.setattr(factorization, "SMALL", 1 + seed % 3)
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
        listed = {"rack": 0.0, "won": 0.75, "lost": 0.25}
        assert dict(self.limit) == listed == self.limit
        assert list(self.limit) == ["rack", "won", "lost"]
        assert len(self.limit) == 3
        assert list(self.limit.values()) == [0.0, 0.75, 0.25]
        assert self.limit.to_dict() == listed

    def test_one_by_one(self):
        assert "won" in self.limit
        assert "drawn" not in self.limit
        assert [] not in self.limit
        assert self.limit.get("won") == 0.75
        assert self.limit.get("drawn") is None
        with pytest.raises(ChainError, match="state 'drawn' isn't in the chain"):
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


# The limits from all states at once: column j is the limit from state j.


RUIN = chain_of([(1, 0, 0.5), (1, 2, 0.5), (2, 1, 0.25), (2, 3, 0.75)])
ROUND = chain_of([("S", "A", 0.25), ("S", "end", 0.75), ("A", "B", 1.0), ("B", "A", 1.0)])


@pytest.mark.parametrize("chain", [RUIN, ROUND], ids=["two ends", "an end and a cycle"])
def test_each_column_is_the_limit_from_its_state(chain):
    table = limit_matrix(chain).toarray()
    for column, state in enumerate(chain.states):
        assert table[:, column] == pytest.approx(stochastic_limit(chain, state).probability)


def test_it_is_a_projection_that_the_chain_leaves_alone():
    table, matrix = limit_matrix(ROUND).toarray(), ROUND.matrix.toarray()
    assert np.allclose(table @ table, table, atol=1e-15)
    assert np.allclose(matrix @ table, table, atol=1e-15)


def test_only_closed_classes_have_entries():
    table = limit_matrix(RUIN)
    assert table.nnz == 6  # 0 and 3 from themselves, and both from 1 and 2


def test_a_matrix_that_would_fill_the_memory_is_refused():
    states = np.arange(8_000)
    chain = chain_from_arrays(
        states.tolist(), np.tile(states, 2), np.append((states + 1) % 8_000, (states + 7) % 8_000),
        np.full(16_000, 0.5),
    )  # fmt: skip
    with pytest.raises(InputError, match="64,000,000"):
        limit_matrix(chain)


# The limit of a game is the same by every way.


DRILL = Drill([0.9, 0.6, 0.2])


@pytest.mark.parametrize("via", [None, *WAYS])
def test_every_way_of_a_drill(via) -> None:
    limit = limit_of(DRILL, via=via)
    # By hand: the shares of levels 1, 2 and 3 are as 0.4 * 0.8 : 0.9 * 0.8 : 0.9 * 0.6.
    assert limit.to_dict() == pytest.approx({1: 32 / 158, 2: 72 / 158, 3: 54 / 158}, rel=1e-14)


@pytest.mark.parametrize("via", ["elimination", "eigen"])
def test_a_graph_and_a_start(via) -> None:
    game = OneBall(0.5, 0.25)
    graph: nx.DiGraph = graph_of(game)
    assert limit_of(graph, via=via)["W"] == pytest.approx(0.8, rel=1e-15)
    assert limit_of(game, start="S2", via=via)["W"] == pytest.approx(0.6, rel=1e-15)
    assert limit_of(graph, start="S2", via=via)["W"] == pytest.approx(0.6, rel=1e-15)


def test_a_start_that_others_do_not_lead_to() -> None:
    with pytest.raises(ChainError, match="9"):
        limit_of(graph_of(DRILL), start=9, via="eigen")
    assert graph_of(OneBall(0.5, 1.0), start="S2").nodes["S2"]["kind"] == "start"


def test_a_way_that_does_not_exist_names_those_that_do() -> None:
    with pytest.raises(InputError, match=r"elimination.*power"):
        limit_of(DRILL, via="power")
    with pytest.raises(ChainError, match="Use elimination"):
        limit_of(Race(2, 2, Rack(0.4)), via="kernel")
