"""The matrices in symbols are those of the games, and their eigenvalues those of the chains."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.game import Game
from evenbreak.games import Ahead, OneBall, Rack, Series
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.source_text.section5.matrices import MATRICES

P1, P2 = 0.4, 0.8
VALUES = {"p1": P1, "p2": P2, "q1": 1 - P1, "q2": 1 - P2, "p": 0.3, "q": 0.7, "sqrt": math.sqrt}


def value(formula: str) -> float:
    return float(eval(re.sub(r"(?<=\w) (?=\w)", "*", formula), dict(VALUES)))  # noqa: S307


def matrix_of(name: str) -> Any:
    return np.array([[value(entry) for entry in row] for row in MATRICES[name].entries])


def matrix_of_game(game: Game, states: list[Any]) -> Any:
    chain = chain_of(game)
    order = [chain.index(state) for state in states]
    return chain.matrix.toarray()[np.ix_(order, order)]


@pytest.mark.parametrize("name", MATRICES)
def test_columns_sum_to_1_and_eigenvalues_are_those_of_the_matrix(name: str) -> None:
    matrix = matrix_of(name)
    assert matrix.sum(axis=0) == pytest.approx(1.0)
    given = sorted(map(value, MATRICES[name].eigenvalues))
    assert sorted(np.linalg.eigvals(matrix).real) == pytest.approx(given, abs=1e-7)


def test_the_one_ball_game() -> None:
    states = list(MATRICES["M"].states)
    game = OneBall(P1, P2)
    assert matrix_of("M") == pytest.approx(matrix_of_game(game, states))
    chain = chain_of(game)
    limits = [[stochastic_limit(chain, source)[to] for source in states] for to in states]
    assert matrix_of("limit of M^n") == pytest.approx(np.array(limits))
    far = np.linalg.matrix_power(matrix_of("M"), 60)
    assert matrix_of("limit of M^n") == pytest.approx(far, abs=1e-12)


@pytest.mark.parametrize("name", ["winner", "loser", "alternate"])
def test_break_formats(name: str) -> None:
    game = Series(Rack(P1, P2), breaks=BREAK_FORMATS[name])
    matrix = matrix_of(f"M, {name} breaks")
    assert matrix == pytest.approx(matrix_of_game(game, [1, 2]))


@pytest.mark.parametrize("m", range(1, 6))
def test_a_lead_of_six_games(m: int) -> None:
    n = 6 - m
    named = MATRICES["M, six games between the ends"].states
    leads = [(max(lead, 0), max(-lead, 0)) for lead in range(-n, m + 1)]
    expected = matrix_of_game(Ahead(m, n, Rack(0.3)), leads)
    assert matrix_of("M, six games between the ends") == pytest.approx(expected)
    assert named[leads.index((0, 0))] == f"{m}:{n}"
