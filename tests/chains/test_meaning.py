"""What a limit means in unusual chains: periods, classes, cycles, games that never end."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import oracle
from evenbreak.chains import (
    absorption,
    chain_of,
    expected_visits,
    limit_matrix,
    stochastic_limit,
)
from evenbreak.games import Ahead, Drill, OneBall, Rack, Series, alternate_breaks, winner_breaks
from tiers import examples


def ring(n: int) -> list[tuple[int, int, float]]:
    return [(k, (k + 1) % n, 1.0) for k in range(n)]


def test_nobody_ever_makes_the_ball() -> None:
    limit = stochastic_limit(chain_of(OneBall(0, 0)))
    assert limit.to_dict() == {"S1": 0.5, "S2": 0.5}
    assert (limit.period, limit.is_cesaro) == (2, True)


def test_a_match_of_perfect_breakers_never_ends() -> None:
    match = Ahead(2, 2, Rack(1, 1), breaks=alternate_breaks)
    chain = chain_of(match)
    limit = stochastic_limit(chain)
    assert not any(match.winner(state) for state in chain.states)
    assert limit.to_dict() == {(0, 0, 1): 0.5, (1, 0, 2): 0.5}
    assert limit.period == 2


@pytest.mark.parametrize("n", [2, 3, 5, 12])
def test_a_deterministic_loop_is_averaged(n: int) -> None:
    limit = stochastic_limit(chain_of(ring(n)), 0)
    assert limit.probability.tolist() == [1 / n] * n
    assert (limit.period, limit.is_cesaro) == (n, True)


def test_a_loop_of_three_with_a_stay_has_period_one() -> None:
    limit = stochastic_limit(chain_of([(0, 0, 0.5), (0, 1, 0.5), (1, 2, 1), (2, 0, 1)]), 0)
    assert limit.probability.tolist() == [0.5, 0.25, 0.25]
    assert (limit.period, limit.is_cesaro) == (1, False)


def test_three_float_arcs_that_miss_1_keep_their_period() -> None:
    arcs = [("A", target, p) for target, p in zip("BCD", (0.7, 0.2, 0.1), strict=True)]
    assert stochastic_limit(chain_of([*arcs, *((s, "A", 1) for s in "BCD")]), "A").period == 2


def test_the_period_is_of_the_classes_reached() -> None:
    arcs = [("S", "A0", 0.5), ("S", "B0", 0.5), ("T", "B0", 1)]
    arcs += [("A0", "A1", 1), ("A1", "A0", 1), ("B0", "B1", 1), ("B1", "B2", 1), ("B2", "B0", 1)]
    chain = chain_of(arcs)
    assert [stochastic_limit(chain, s).period for s in ("S", "T", "A1")] == [6, 3, 2]
    assert stochastic_limit(chain, "S")["A0"] == 0.25


def test_a_transient_cycle_of_period_two_has_a_proper_limit() -> None:
    limit = stochastic_limit(chain_of(OneBall(0.4, 0.8)))
    assert limit.period == 1
    assert limit["W"] == pytest.approx(0.4 / (1 - 0.6 * 0.2), rel=1e-15)
    assert limit["S1"] == limit["S2"] == 0.0


def test_unreachable_states_have_no_chance() -> None:
    chain = chain_of([("A", "A", 1), ("B", "A", 0.5), ("B", "C", 0.5)])
    assert stochastic_limit(chain, "A").to_dict() == {"A": 1.0, "B": 0.0, "C": 0.0}
    assert stochastic_limit(chain, {"A": 0.5, "B": 0.5})["A"] == 0.75


def test_one_state() -> None:
    limit = stochastic_limit(chain_of([("A", "A", 1)], start="A"))
    assert limit.to_dict() == {"A": 1.0}
    assert (limit.period, limit.is_cesaro) == (1, False)


def test_a_tie_goes_on_for_ever_between_two_who_never_break_and_run() -> None:
    limit = stochastic_limit(chain_of(Series(Rack(1, 1), breaks=winner_breaks, first_breaker=2)))
    assert limit.to_dict() == {2: 1.0}


def test_drills_that_always_or_never_succeed() -> None:
    assert stochastic_limit(chain_of(Drill([1, 1, 1]))).to_dict() == {1: 0.0, 2: 0.0, 3: 1.0}
    assert stochastic_limit(chain_of(Drill([0, 0, 0]))).to_dict() == {1: 1.0}
    swing = stochastic_limit(chain_of(Drill([1, 0])))
    assert swing.to_dict() == {1: 0.5, 2: 0.5}
    assert swing.is_cesaro


# Laws ----------------------------------------------------------------------------------


@st.composite
def chains(draw: st.DrawFn) -> list[tuple[int, int, float]]:
    """Return any small chain: sparse, so that classes, cycles and dead ends come up."""
    n = draw(st.integers(1, 7))
    triples = []
    for j in range(n):
        row = draw(st.dictionaries(st.integers(0, n - 1), st.integers(1, 9), max_size=3))
        total = sum(row.values())
        triples += [(j, i, weight / total) for i, weight in row.items()]
    return triples or [(0, 0, 1.0)]


@pytest.mark.slow
@settings(max_examples=examples(150), deadline=None)
@given(chains())
def test_limits_of_any_small_chain(triples: list[tuple[int, int, float]]) -> None:
    chain = chain_of(triples)
    columns = oracle.columns_of(chain)
    matrix = limit_matrix(chain).toarray()
    for j, state in enumerate(chain.states):
        limit = stochastic_limit(chain, state)
        exact = oracle.absorption(columns, {j: Fraction(1)})
        periods = [oracle.period(chain, states) for states, mass in exact.items() if mass]
        assert limit.period == np.lcm.reduce(periods)
        truth = oracle.limit(columns, {j: Fraction(1)})
        assert oracle.worst_relative_error(limit.probability, truth) <= 1e-14
        assert oracle.worst_relative_error(matrix[:, j], truth) <= 1e-14
        assert absorption(chain, state).sum() == pytest.approx(1.0, abs=1e-14)


@settings(max_examples=examples(60), deadline=None)
@given(chains())
def test_the_limit_is_the_average_of_one_period_of_powers(
    triples: list[tuple[int, int, float]],
) -> None:
    chain = chain_of(triples)
    matrix = limit_matrix(chain).toarray()
    assert np.allclose(chain.matrix @ matrix, matrix, atol=1e-14)
    assert np.allclose(matrix @ matrix, matrix, atol=1e-14)
    # After 2^14 steps a chain of so few states and such arcs has forgotten all but its phase.
    far = np.linalg.matrix_power(chain.matrix.toarray(), 1 << 14)
    period = int(np.lcm.reduce(chain.structure.periods[chain.structure.closed]))
    average, power = np.zeros_like(far), far
    for _ in range(period):
        average += power / period
        power = chain.matrix @ power
    assert np.allclose(average, matrix, atol=1e-9)


def test_a_class_reached_with_a_chance_below_all_floats_is_reached():
    chain = chain_of(
        [
            ("s", "t", 1e-200),
            ("s", "end", 1 - 1e-200),
            ("t", "u", 1e-200),
            ("t", "end", 1 - 1e-200),
            ("u", "w", 1.0),
            ("w", "u", 1.0),
        ]
    )
    limit = stochastic_limit(chain, {"s": 1.0})
    assert (limit["end"], limit["u"], limit.period) == (1.0, 0.0, 2)
    assert stochastic_limit(chain, "s").period == 2
    assert expected_visits(chain, "s")["u"] == np.inf
