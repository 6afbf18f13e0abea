"""The witness itself, on chains that can be solved by hand."""

from fractions import Fraction

import oracle
from evenbreak.chains import chain_of

HALF = Fraction(1, 2)


def test_gamblers_ruin_by_hand() -> None:
    # From 1 of 3 with p = 2/3 up: (1 - r) / (1 - r^3) with r = 1/2 is 4/7.
    up, down = Fraction(2, 3), Fraction(1, 3)
    columns = [{}, {2: up, 0: down}, {3: up, 1: down}, {}]
    assert oracle.limit(columns, {1: Fraction(1)}) == [Fraction(3, 7), 0, 0, Fraction(4, 7)]
    assert oracle.visits(columns, {1: Fraction(1)}) == {1: Fraction(9, 7), 2: Fraction(6, 7)}


def test_self_loops_are_what_is_left_over() -> None:
    # Left with 1/4 and 1/2: two thirds of the time where it is left less often.
    columns = [{1: Fraction(1, 4)}, {0: HALF}]
    assert oracle.limit(columns, {1: Fraction(1)}) == [Fraction(2, 3), Fraction(1, 3)]


def test_several_closed_classes_and_a_density() -> None:
    columns = [{1: HALF, 3: HALF}, {2: Fraction(1)}, {1: Fraction(1)}, {}, {3: Fraction(1)}]
    density = {0: HALF, 4: HALF}
    assert oracle.closed_classes(columns) == [{1, 2}, {3}]
    assert oracle.absorption(columns, density) == {
        frozenset({1, 2}): Fraction(1, 4),
        frozenset({3}): Fraction(3, 4),
    }
    quarter = Fraction(1, 8)
    assert oracle.limit(columns, density) == [0, quarter, quarter, Fraction(3, 4), 0]


def test_solve_needs_a_row_exchange() -> None:
    zero, one = Fraction(0), Fraction(1)
    assert oracle.solve([[zero, 2 * one], [3 * one, one]], [one, one]) == [Fraction(1, 6), HALF]


def test_period() -> None:
    ring = chain_of([("A", "B", 1), ("B", "C", 1), ("C", "A", 1)])
    chord = chain_of([("A", "B", 0.5), ("A", "C", 0.5), ("B", "C", 1), ("C", "A", 1)])
    square = chain_of(
        [(k, (k + 1) % 4, 0.5) for k in range(4)]
        + [(k, k - 1, 0.5) for k in (1, 2, 3)]
        + [(0, 3, 0.5)]
    )
    assert [oracle.period(c, set(range(len(c)))) for c in (ring, chord, square)] == [3, 1, 2]


def test_errors_are_seen() -> None:
    assert oracle.worst_relative_error([0.5, 0.0], [HALF, Fraction(0)]) == 0.0
    assert oracle.worst_relative_error([0.5000001], [HALF]) > 1e-7
    assert oracle.worst_relative_error([float("nan")], [HALF]) == float("inf")
    assert oracle.worst_relative_error([1e-300], [Fraction(0)]) == float("inf")
    assert oracle.worst_relative_error([-1e-320], [Fraction(1, 10**320)]) == float("inf")
    assert oracle.worst_relative_error([0.0], [Fraction(1, 10**320)]) == 0.0
