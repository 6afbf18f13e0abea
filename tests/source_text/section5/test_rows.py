"""The matrices in symbols are those of the games, and the page has their eigenvalues."""

from __future__ import annotations

import math
import re
from importlib.resources import files
from typing import Any

import numpy as np
import pytest

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.game import Game
from evenbreak.games import Ahead, OneBall, Rack, Series
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.source_text.published import Row, formulas

P1, P2 = 0.4, 0.8
VALUES = {"p1": P1, "p2": P2, "q1": 1 - P1, "q2": 1 - P2, "p": 0.3, "q": 0.7, "sqrt": math.sqrt}


def value(formula: str) -> float:
    return float(eval(re.sub(r"(?<=\w) (?=\w)", "*", formula), dict(VALUES)))  # noqa: S307


def entries_of(name: str) -> dict[tuple[str, str], str]:
    """Return the entries of a matrix in symbols by target and source."""
    rows = [row for problem in ("P5.23", "P5.24", "P5.27") for row in formulas(problem)]
    entries = {}
    for row in rows:
        if row.quantity == f"formula: {name}":
            _, target, _, source = row.inputs.split()
            entries[target, source] = row.computed
    return entries


def states_of(name: str) -> list[str]:
    return list(dict.fromkeys(target for target, _ in entries_of(name)))


def matrix_of(name: str) -> Any:
    entries, states = entries_of(name), states_of(name)
    return np.array([[value(entries[to, source]) for source in states] for to in states])


def matrix_of_game(game: Game, states: list[Any]) -> Any:
    chain = chain_of(game)
    order = [chain.index(state) for state in states]
    return chain.matrix.toarray()[np.ix_(order, order)]


PAGE = files("evenbreak.source_text").joinpath("templates/section5.md").read_text("utf-8")
MATRICES = re.findall(r"\{\{matrix (.*)\}\}", PAGE)


def test_a_row_may_do_without_a_note() -> None:
    assert Row("mean", "", 1.5).note == ""


@pytest.mark.parametrize("name", MATRICES)
def test_columns_sum_to_1_and_eigenvalues_are_those_of_the_matrix(name: str) -> None:
    matrix = matrix_of(name)
    assert matrix.sum(axis=0) == pytest.approx(1.0)
    (line,) = re.findall(rf"\| {re.escape(name)} \| `(.*)` \|", PAGE)
    given = sorted(map(value, line.split(", ")))
    assert sorted(np.linalg.eigvals(matrix).real) == pytest.approx(given, abs=1e-7)


def test_the_one_ball_game() -> None:
    states = states_of("M")
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
    named = states_of("M, six games between the ends")
    leads = [(max(lead, 0), max(-lead, 0)) for lead in range(-n, m + 1)]
    expected = matrix_of_game(Ahead(m, n, Rack(0.3)), leads)
    assert matrix_of("M, six games between the ends") == pytest.approx(expected)
    assert named[leads.index((0, 0))] == f"{m}:{n}"
