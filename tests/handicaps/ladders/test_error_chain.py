"""The chain of all rating errors: its matrix, its unit and its period."""

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import Ladder
from evenbreak.handicaps.ladders.error_chain import (
    chain_of_errors,
    error_on,
    move_matrix,
    period_of,
    unit_of,
)


def test_the_matrix_has_the_moves_and_holds_the_ends():
    ladder = Ladder("npl", widest=5)
    matrix = move_matrix(ladder)
    np.testing.assert_allclose(matrix.sum(axis=1), 1.0)
    assert matrix[5, 6] == pytest.approx(ladder.wins[5])
    assert matrix[0, 0] == pytest.approx(1.0 - ladder.wins[0])


def test_a_newcomer_moves_by_the_factor():
    ladder = Ladder("npl", widest=9)
    matrix = move_matrix(ladder, 3)
    assert np.flatnonzero(matrix[9]).tolist() == [6, 12]
    assert matrix[9, 12] == pytest.approx(ladder.wins[9])


def test_every_error_is_a_state_even_where_the_start_cannot_reach_it():
    chain = chain_of_errors(Ladder("step 3", widest=6))
    assert list(chain.states) == list(range(-6, 7))


@pytest.mark.parametrize(
    ("system", "unit", "period"),
    [("npl", 1, 2), ("step 3", 3, 2), ("step 2 1", 1, 3), ("step 1 3", 1, 4), ("margin 2", 1, 1)],
)
def test_unit_and_period(system, unit, period):
    ladder = Ladder(system)
    assert (unit_of(ladder), period_of(ladder)) == (unit, period)


def test_drift_leaves_the_period_alone():
    assert period_of(Ladder("npl", drift=0.1)) == 2


@pytest.mark.parametrize("start", [11, 0.5, "x", None, float("nan")])
def test_an_error_off_the_ladder_is_refused(start):
    assert error_on(10, np.int64(-10)) == -10
    with pytest.raises(InputError, match="start must"):
        error_on(10, start)
