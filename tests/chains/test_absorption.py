"""Where chains end, and the visits before: by hand, by exact arithmetic, and over long ways."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import Chain, absorption, chain_of, expected_visits, stochastic_limit
from evenbreak.chains.absorption import closed_classes_reached

# Up with 2/3 and down with 1/3, between 0 and 4.
RUIN = chain_of(
    [(k, k + 1, 2 / 3) for k in (1, 2, 3)] + [(k, k - 1, 1 / 3) for k in (1, 2, 3)], start=1
)


@pytest.mark.parametrize("start", [1, 2, 3])
def test_gamblers_ruin(start):
    ends = absorption(RUIN, start)
    won = (1 - 0.5**start) / (1 - 0.5**4)
    assert ends[4] == pytest.approx(won, rel=1e-15)
    assert ends[0] == pytest.approx(1 - won, rel=1e-15)


def test_visits_against_fractions():
    visits = expected_visits(RUIN)
    exact = oracle.visits(oracle.columns_of(RUIN), {RUIN.index(1): Fraction(1)})
    for place, number in exact.items():
        assert visits[RUIN.states[place]] == pytest.approx(float(number), rel=1e-15)
    assert np.isinf(visits[[0, 4]]).all()


def test_a_start_in_a_closed_class_stays_there():
    assert absorption(RUIN, 4)[4] == 1.0
    visits = expected_visits(RUIN, 4)
    assert np.isinf(visits[4])
    assert visits.tolist().count(0.0) == 4


def test_an_end_is_reached_however_small_its_chance():
    way = chain_of([("a", "b", 1e-200), ("a", "x", 1.0), ("b", "c", 1e-200), ("b", "x", 1.0)])
    reached = closed_classes_reached(way, way.density("a"))
    assert absorption(way, "a")["c"] == 0.0
    assert reached[way.structure.label[way.index("c")]]


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
