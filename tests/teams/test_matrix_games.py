"""Matrix games against linear programs, and against games whose solution is known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import linprog

from evenbreak.errors import InputError
from evenbreak.teams import matrix_game


def by_linear_program(game: np.ndarray) -> float:
    m, n = game.shape
    found = linprog(
        np.r_[np.zeros(m), -1.0],
        A_ub=np.c_[-game.T, np.ones(n)],
        b_ub=np.zeros(n),
        A_eq=[[1.0] * m + [0.0]],
        b_eq=[1.0],
        bounds=[(0, None)] * m + [(None, None)],
    )
    return float(-found.fun)


@pytest.mark.parametrize("shape", [(2, 2), (5, 5), (3, 7), (8, 4)])
def test_values_are_those_of_linear_programs(shape: tuple[int, int]) -> None:
    games = np.random.default_rng(3).normal(size=(6, *shape))
    solved = matrix_game(games)
    assert solved.value == pytest.approx([by_linear_program(game) for game in games], abs=1e-9)


@given(arrays(float, (3, 4), elements=st.integers(0, 2).map(float)))
def test_both_mixtures_guarantee_the_value(game: np.ndarray) -> None:
    value, rows, columns = matrix_game(game)
    assert rows.sum() == pytest.approx(1.0)
    assert columns.sum() == pytest.approx(1.0)
    assert (rows @ game).min() >= value - 1e-9
    assert (game @ columns).max() <= value + 1e-9


def test_a_saddle_point_is_found_to_the_last_digit() -> None:
    solved = matrix_game([[0.3, 0.1], [0.4, 0.2]])
    assert (float(solved.value), solved.rows.tolist()) == (0.2, [0.0, 1.0])


def test_matching_pennies_with_unequal_stakes() -> None:
    solved = matrix_game([[2.0, 0.0], [0.0, 1.0]])
    assert solved.value == pytest.approx(2 / 3)
    assert solved.rows == pytest.approx([1 / 3, 2 / 3])


def test_payoffs_need_rows_and_columns() -> None:
    with pytest.raises(InputError, match="shape"):
        matrix_game([1.0, 2.0])
    with pytest.raises(InputError, match="payoff"):
        matrix_game([[np.nan]])
