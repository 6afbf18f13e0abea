"""The two solves of the transient part, by each method, against exact arithmetic."""

import random
from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import (
    Chain,
    TransientPart,
    dense_elimination,
    dissection,
    factorization,
    stochastic_limit,
    transient,
)
from evenbreak.chains.certified import CertifiedSolve, NotCertifiedError
from evenbreak.chains.dissection import FrontElimination
from evenbreak.chains.elimination import DecimalElimination, PlainElimination, decimal_law
from evenbreak.chains.factorization import TriangularSolve
from evenbreak.errors import AccuracyError


class Refused(CertifiedSolve):
    """Proves nothing."""

    def __init__(self, *_, **__):
        raise NotCertifiedError


ALL = {"is_dense": lambda *_: False, "_NARROW": 0, "SMALL": 1}
METHODS = {
    "plain Python": {"plain": 10**6},
    "one substitution": {"SMALL": 64},
    "small classes up to 3": {**ALL, "SMALL": 3, "_FEW": 99},
    "decimal numbers": {**ALL, "_NARROW": 100, "CertifiedSolve": Refused},
    "fronts": {**ALL, "_FEW": 99},
    "fronts, since nothing is proved": {**ALL, "_FEW": 0, "CertifiedSolve": Refused},
    "factors, proved": {**ALL, "_FEW": 0},
    "iterations, proved": {**ALL, "_FEW": 0, "_MUCH_WORK": -1},
}


@pytest.fixture(params=METHODS)
def method(request, monkeypatch):
    use(monkeypatch, **METHODS[request.param])


each_method = pytest.mark.usefixtures("method")


def use(monkeypatch, plain=0, **plan):
    monkeypatch.setattr(transient, "_FEW_ARCS", plain)
    for name, value in plan.items():
        monkeypatch.setattr(factorization, name, value)
    # Fronts and blocks so small that a dozen states fill several.
    monkeypatch.setattr(dissection, "_LEAF", 3)
    monkeypatch.setattr(dense_elimination, "_ONE_BY_ONE", 2)


def random_chain(draw, decades):
    """Return a chain of several classes; the last state absorbs and all lead there."""
    n = draw.randint(2, 16)
    labels = draw.sample(range(n), n)
    matrix = np.zeros((n, n))
    for place, j in enumerate(labels[:-1]):
        targets = {draw.choice(labels[place + 1 :])}
        targets |= set(draw.choices(labels[max(0, place - 4) :], k=draw.randint(0, 4))) - {j}
        weights = [10.0 ** -draw.uniform(0, decades) for _ in targets]
        total = sum(weights) * draw.choice([1.0, 1.1, 1e6])
        for i, weight in zip(targets, weights, strict=True):
            matrix[i, j] = weight / total
        matrix[j, j] = max(0.0, 1.0 - matrix[:, j].sum())
    matrix[labels[-1], labels[-1]] = 1.0
    return Chain(range(n), csc_array(matrix), labels[0])


def exact_solves(chain, b):
    """Return (I - T)^-1 b and (I - T)^-T b over the transient states, exactly."""
    columns, states = oracle.columns_of(chain), chain.transient.states.tolist()
    matrix = [
        [
            sum(columns[j].values(), Fraction(0)) if i == j else -columns[j].get(i, Fraction(0))
            for j in states
        ]
        for i in states
    ]
    right = [Fraction(x) for x in b.tolist()]
    transposed = [list(row) for row in zip(*matrix, strict=True)]
    return oracle.solve(matrix, right), oracle.solve(transposed, right)


@pytest.mark.slow_after(48)
@each_method
@pytest.mark.parametrize("decades", [0.5, 12])
@pytest.mark.parametrize("seed", range(8))
def test_visits_and_values(seed, decades):
    draw = random.Random(seed)
    chain = random_chain(draw, decades)
    part = chain.transient
    b = np.array([draw.choice([0.0, draw.random()]) for _ in part.states])
    visits, values = exact_solves(chain, b)
    assert oracle.worst_relative_error(part.visits(b), visits) < 5e-15
    assert oracle.worst_relative_error(part.values(b), values) < 5e-15
    assert part.bound is None or part.bound < 5e-15
    both = np.column_stack((b, b[::-1]))
    assert part.visits(both)[:, 0] == pytest.approx(part.visits(b), rel=1e-14)
    assert part.values(both)[:, 1] == pytest.approx(part.values(b[::-1]), rel=1e-14)


def test_each_method_is_what_it_says(monkeypatch):
    """The fixture would prove nothing if all of its cases ran the same code."""
    ring = np.roll(np.eye(9), 1, axis=0) * 0.5 + np.roll(np.eye(9), 3, axis=0) * 0.25
    chain = Chain(range(10), csc_array(np.block([[ring, np.zeros((9, 1))], [np.full(9, 0.25), 1]])))
    kinds = {}
    for name, settings in METHODS.items():
        with monkeypatch.context() as patch:
            use(patch, **settings)
            part = TransientPart(chain.arcs, np.arange(9))
            part.visits(np.ones(9))
            factor = part._factor
            pieces = getattr(factor, "_pieces", [])
            kinds[name] = type(pieces[0].solver) if pieces else type(factor)
    assert kinds == {
        "plain Python": PlainElimination,
        "one substitution": TriangularSolve,
        "small classes up to 3": FrontElimination,
        "decimal numbers": DecimalElimination,
        "fronts": FrontElimination,
        "fronts, since nothing is proved": FrontElimination,
        "factors, proved": CertifiedSolve,
        "iterations, proved": CertifiedSolve,
    }


def test_a_part_of_the_states_leaks_to_the_others():
    chain = Chain(range(3), csc_array(np.array([[0, 0.5, 0], [0.5, 0, 1], [0.5, 0.5, 0]])))
    part = TransientPart(chain.arcs, np.array([0, 2]))
    assert part.visits(np.array([1.0, 0.0])).tolist() == [1.0, 0.5]
    assert part.values(np.array([0.0, 1.0])).tolist() == [0.5, 1.0]


def test_no_transient_states():
    part = Chain(range(2), csc_array(np.eye(2))).transient
    assert part.visits(np.zeros(0)).shape == (0,)
    assert part.values(np.zeros((0, 3))).shape == (0, 3)
    assert part.bound is None


@each_method
def test_nothing_in_nothing_out():
    chain = random_chain(random.Random(1), 1)
    m = len(chain.transient.states)
    assert not chain.transient.visits(np.zeros(m)).any()
    assert not chain.transient.values(np.zeros(m)).any()


@each_method
def test_what_underflows_on_the_way_is_not_lost():
    """Flows of 1e-150 by 1e-200 vanish in floats; the visits that they lead to need not."""
    matrix = np.zeros((5, 5))
    matrix[1, 0], matrix[4, 0] = 1e-200, 0.5
    matrix[2, 1], matrix[4, 1] = 1e-150, 0.5
    matrix[3, 2], matrix[2, 3] = 1e-300, 0.5
    matrix[4, 3] = 0.5
    chain = Chain(range(5), oracle.with_loops(csc_array(matrix)))
    b = np.array([1.0, 0, 0, 0])
    visits, values = exact_solves(chain, b)
    assert float(visits[2]) == pytest.approx(8e-50)
    assert oracle.worst_relative_error(chain.transient.visits(b), visits) < 5e-15
    assert oracle.worst_relative_error(chain.transient.values(b), values) < 5e-15


@each_method
@pytest.mark.parametrize("chances", [(1e-316, 1e-8), (1e-290, 1e-300), (1e-20, 1e-4)])
def test_what_loses_digits_between_large_classes_is_not_taken_for_proved(chances):
    """Flows below 1e-308 have few digits; visits from a class that is rarely left have all."""
    n, (link, leaving) = 6, chances
    i = np.arange(n)
    ring = np.zeros((n, n))
    ring[(i + 1) % n, i], ring[(i + 2) % n, i] = 0.25, 0.125
    matrix = np.zeros((2 * n + 1, 2 * n + 1))
    matrix[:n, :n] = matrix[n:-1, n:-1] = ring
    matrix[n, 0], matrix[-1, 3], matrix[-1, n + 4] = link, 0.1, leaving
    chain = Chain(range(2 * n + 1), oracle.with_loops(csc_array(matrix)))
    b = np.eye(2 * n)[1]
    visits, values = exact_solves(chain, b)
    normal = [k for k, x in enumerate(visits) if x > 2.0**-1020]
    found = chain.transient.visits(b)[normal]
    assert oracle.worst_relative_error(found, [visits[k] for k in normal]) < 5e-15
    assert oracle.worst_relative_error(chain.transient.values(b), values) < 5e-15


@each_method
def test_more_visits_than_any_float_are_refused():
    matrix = np.array([[1.0, 0, 0], [0, 0.0, 0], [0, 0.0, 1.0]])
    matrix[2, 0] = 1e-310
    matrix[0, 1] = 1.0
    chain = Chain(range(3), csc_array(matrix), 1)
    with pytest.raises(AccuracyError, match="too large for a float"):
        chain.transient.visits(np.array([0.0, 1.0]))


@pytest.mark.slow
def test_twenty_thousand_classes_in_a_row_cost_no_loop_over_classes():
    """Three states to a class, in shuffled order; the exact answer is a geometric law."""
    k = 20_000
    j = np.arange(3 * k)
    ring = j - j % 3 + (j + 1) % 3
    ends = j[2::3][:-1]
    sources = np.concatenate((j, ends, [3 * k - 1]))
    targets = np.concatenate((ring, ends + 1, [3 * k]))
    chances = np.concatenate((np.where(j % 3 == 2, 0.5, 1.0), np.full(k, 0.5)))
    shuffle = np.random.default_rng(1).permutation(3 * k + 1)
    matrix = csc_array((chances, (shuffle[targets], shuffle[sources])), (3 * k + 1, 3 * k + 1))
    chain = Chain(range(3 * k + 1), oracle.with_loops(matrix))
    part = chain.transient
    b = np.zeros(3 * k + 1)
    b[shuffle[0]] = 1.0
    assert part.visits(b[part.states]) == pytest.approx(np.full(3 * k, 2.0), rel=1e-12)
    assert part.values(np.ones(3 * k)).max() == pytest.approx(6.0 * k, rel=1e-12)


@pytest.mark.parametrize("narrow", [True, False])
def test_long_narrow_classes_do_not_add_up_rounding_errors(monkeypatch, narrow):
    """Up by one or two with 0.2, down with 0.2001: equal arcs at each of 3,000 states."""
    if not narrow:
        monkeypatch.setattr(factorization, "_NARROW", 0)
    n = 3_000
    i = np.arange(n)
    rows = np.concatenate([i[s:] for s in (1, 2)] + [i[:-s] for s in (1, 2)])
    columns = np.concatenate([i[:-s] for s in (1, 2)] + [i[s:] for s in (1, 2)])
    chances = np.where(rows > columns, 0.2, 0.2001)
    chain = Chain(range(n), oracle.with_loops(csc_array((chances, (rows, columns)), (n, n))), 0)
    law = stochastic_limit(chain).probability
    worst = np.abs(law / decimal_law(chain.arcs) - 1).max()
    assert worst < (1e-14 if narrow else 1e-12)
