"""Many arcs into or out of one state lose no digits; arcs that miss a sum of 1 are completed."""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import coo_array, csc_array, csc_matrix, csr_array

from evenbreak.chains import (
    Chain,
    absorption,
    chain_from_arrays,
    chain_of,
    expected_visits,
    limit_matrix,
    propagate,
    sensitivity,
    steps_to_absorption,
    stochastic_limit,
)
from evenbreak.chains.arcs import sums
from evenbreak.errors import AccuracyError, ChainError
from rows import each_of


@each_of("count", [3, 100, 10_001, 300_000])
@each_of("decades", [0, 1, 40])
def test_sums_are_right_to_one_rounding(count: int, decades: int) -> None:
    rng = np.random.default_rng(count)
    values = 0.1 * 10.0 ** -(decades * rng.random(count))
    place = rng.integers(0, 2, count)
    found = sums(place, values, 3)
    for k in range(3):
        assert found[k] == pytest.approx(math.fsum(values[place == k]), rel=3e-16, abs=0)


def test_sums_of_nothing_of_the_largest_and_of_the_smallest_floats() -> None:
    none = np.zeros(0)
    assert sums(none.astype(int), none, 2).tolist() == [0.0, 0.0]
    assert sums(np.zeros(8, dtype=int), np.full(8, 2e307), 1)[0] == pytest.approx(1.6e308)
    assert sums(np.zeros(8, dtype=int), np.full(8, 5e-324), 1)[0] == 4e-323


def star(count: int) -> Chain:
    """From s to one target with 0.500025 and to the others with small equal chances."""
    small = 0.499975 / (count - 1)
    chances = np.full(count, small)
    chances[0] = 0.500025
    return chain_from_arrays(
        range(count + 1), np.zeros(count, dtype=int), np.arange(1, count + 1), chances, 0
    )


@pytest.mark.parametrize("count", [20_000, 200_000])
def test_a_state_with_many_arcs(count: int) -> None:
    chain = star(count)
    small = 0.499975 / (count - 1)
    total = Fraction(0.500025) + (count - 1) * Fraction(small)
    limit = stochastic_limit(chain)
    assert limit[1] == pytest.approx(float(Fraction(0.500025) / total), rel=1e-15)
    assert limit[2] == pytest.approx(float(Fraction(small) / total), rel=1e-15)
    assert (limit.bound or 0.0) < 1e-15
    assert math.fsum(limit.probability) == pytest.approx(1.0, abs=1e-15)
    assert math.fsum(propagate(chain)) == pytest.approx(1.0, abs=1e-15)


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(("count", "back"), [(20_000, 0.0), (200_000, 0.0), (20_000, 0.25)])
def test_a_state_with_many_arcs_into_it(count: int, back: float) -> None:
    """From s to `count` states, from each of these to t or back to s."""
    middle = np.arange(1, count + 1)
    s, t = np.zeros(count, dtype=int), np.full(count, count + 1)
    chain = chain_from_arrays(
        range(count + 3),
        np.concatenate((s, middle, middle, middle)),
        np.concatenate((middle, t, t + 1, s)),
        np.concatenate(
            [np.full(count, c) for c in (1 / count, 0.3, 0.7 - back, back)],
        ),
        0,
    )
    limit = stochastic_limit(chain)
    assert limit[count + 1] == pytest.approx(0.3 / (1 - back), rel=2e-15)
    law = limit_matrix(chain)[[count + 1], [0]]
    assert law[0] == pytest.approx(0.3 / (1 - back), rel=2e-15)
    visits = expected_visits(chain)
    assert visits.iloc[:2].tolist() == pytest.approx(
        [1 / (1 - back), 1 / count / (1 - back)], rel=2e-15
    )
    assert steps_to_absorption(chain).mean == pytest.approx(2 / (1 - back), rel=2e-15)


def test_many_arcs_into_one_closed_class() -> None:
    """From s to an end, or to one of 2,000 states that go to the hub of their class and back."""
    count = 2_000
    small, hub, end = 0.499975 / count, count + 1, count + 2
    spoke, s = np.arange(1, count + 1), np.zeros(count, dtype=int)
    chain = chain_from_arrays(
        range(count + 3),
        np.concatenate((s, [0], spoke, s + hub)),
        np.concatenate((spoke, [end], s + hub, spoke)),
        np.concatenate((s + small, [0.500025], s + 1.0, s + 1 / count)),
        0,
    )
    total = Fraction(0.500025) + count * Fraction(small)
    exact = float((1 - Fraction(0.500025) / total) / 2)
    assert stochastic_limit(chain)[hub] == pytest.approx(exact, rel=1e-15)
    assert limit_matrix(chain)[hub, 0] == pytest.approx(exact, rel=1e-15)
    slopes = sensitivity(chain, {end: 1.0, hub: 1.0})
    assert slopes.value == pytest.approx(1.0 - exact, rel=1e-15)


def test_arcs_that_miss_a_sum_of_1_are_scaled() -> None:
    chain = chain_of([("a", "b", 0.9999999995)], start="a")
    assert stochastic_limit(chain)["b"] == 1.0
    assert steps_to_absorption(chain).mean == 1.0
    assert expected_visits(chain)["a"] == 1.0
    assert absorption(chain).to_dict() == {"b": 1.0}


def test_a_listed_self_loop_is_the_rest() -> None:
    matrix = np.array([[0.75, 0.0], [0.2500000005, 1.0]])
    chain = Chain("ab", matrix, "a")
    assert chain.matrix[0, 0] == pytest.approx(0.7499999995, rel=1e-15)
    assert steps_to_absorption(chain).mean == pytest.approx(1 / 0.2500000005, rel=1e-15)


ROWS = [[0.1, 0.6, 0.3], [0.4, 0.2, 0.5], [0.5, 0.2, 0.2]]


@pytest.mark.parametrize(
    "form", [csc_array, csr_array, coo_array, csc_matrix, np.array, list], ids=lambda f: f.__name__
)
def test_any_form_of_the_matrix_is_read_by_its_meaning(form) -> None:
    law = stochastic_limit(Chain("abc", form(ROWS)), "a").probability
    assert law == pytest.approx(np.array(ROWS) @ law, rel=1e-15)


def test_duplicate_entries_are_added_up_and_the_given_matrix_is_left_alone() -> None:
    given = coo_array(([0.25, 0.25, 0.5, 1.0], ([0, 0, 1, 1], [0, 0, 0, 1])))
    assert Chain("ab", given).matrix.toarray().tolist() == [[0.5, 0.0], [0.5, 1.0]]
    unsorted = csc_array(([0.5, 0.25, 0.25, 1.0], [1, 0, 0, 1], [0, 3, 4]), shape=(2, 2))
    assert Chain("ab", unsorted).matrix.toarray().tolist() == [[0.5, 0.0], [0.5, 1.0]]
    assert unsorted.nnz == 4


@pytest.mark.parametrize(
    "wrong", ["text", [["a", "b"], ["c", "d"]], [1.0, 0.0], 3, None, [[1j, 0], [0, 1]]]
)
def test_what_is_not_a_matrix_is_refused(wrong) -> None:
    with pytest.raises(ChainError, match="the matrix must be sparse or"):
        Chain("ab", wrong)


def test_states_listed_twice_are_refused() -> None:
    with pytest.raises(ChainError, match="listed twice"):
        Chain(["a", "a"], np.eye(2))


TINY = 1e-200
"""The square of its inverse is too large for a float."""


@pytest.mark.parametrize(
    "arcs",
    [
        [("s", "a", 1.0), ("a", "s", 1.0 - TINY), ("a", "b", TINY)],
        [("s", "s", 1.0), ("s", "a", TINY), ("a", "s", 1.0), ("a", "b", TINY)],
    ],
)
def test_visits_that_no_float_can_hold_are_on_the_way_only(arcs) -> None:
    chain = chain_of(
        [*arcs, ("b", "a", 1.0), ("b", "lost", TINY), ("b", "won", 3 * TINY)], start="s"
    )
    limit = stochastic_limit(chain)
    assert (limit["lost"], limit["won"]) == pytest.approx((0.25, 0.75), rel=1e-15)
    assert limit_matrix(chain).toarray()[:, 0] == pytest.approx(limit.probability, rel=1e-15)
    with pytest.raises(AccuracyError, match="too large for a float"):
        expected_visits(chain)
