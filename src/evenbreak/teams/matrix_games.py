"""Matrix games: the value when both sides choose at the same time.

Many games with the same shape are solved together by the simplex method on arrays. Each solution
proves itself: the guarantees of the two mixtures bracket the value, and if the bracket is wider
than rounding allows, the game is solved again with scipy's linear programming.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import floats
from evenbreak.errors import AccuracyError, InputError

_NARROW = 1e-10


class MatrixGame(NamedTuple):
    """Solution of matrix games.

    Parameters
    ----------
    value
        the row player's mean payoff if both play as well as possible.
    rows, columns
        the mixtures: the chance with which each row and each column is chosen, last axis.
    """

    value: Floats
    rows: Floats
    columns: Floats


def matrix_game(payoff: ArrayLike) -> MatrixGame:
    """Return the value of zero-sum games and the optimal mixtures.

    Parameters
    ----------
    payoff
        the row player's payoff, paid by the column player; shape (..., rows, columns).

    Returns
    -------
    MatrixGame
        arrays of shapes (...), (..., rows) and (..., columns). The mixtures' guarantees are within
        1e-10 of the value, relative to the spread of the payoffs.

    Raises
    ------
    InputError
        if the payoffs are not finite numbers in rows and columns.

    >>> rock_paper_scissors = [[0, -1, 1], [1, 0, -1], [-1, 1, 0]]
    >>> game = matrix_game(rock_paper_scissors)
    >>> round(float(game.value), 12), game.rows.round(4).tolist()
    (0.0, [0.3333, 0.3333, 0.3333])
    """
    given = floats(payoff, "payoff")
    if given.ndim < 2 or 0 in given.shape[-2:]:
        raise InputError(
            "{payoff} must have a row and a column for each choice; its shape is {given_shape}",
            given_shape=given.shape,
        )
    games = given.reshape(-1, *given.shape[-2:])
    low = games.min(axis=(1, 2))
    spread = games.max(axis=(1, 2)) - low
    scaled = 1.0 + (games - low[:, None, None]) / np.where(spread > 0.0, spread, 1.0)[:, None, None]
    value, rows, columns = _solved(scaled)
    shape = given.shape[:-2]
    return MatrixGame(
        (low + (value - 1.0) * spread).reshape(shape),
        rows.reshape(*shape, -1),
        columns.reshape(*shape, -1),
    )


def _solved(games: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the values and mixtures of games whose payoffs are from 1 to 2."""
    count, m, n = games.shape
    rows, columns = np.zeros((count, m)), np.zeros((count, n))
    worst, best = games.min(axis=2), games.max(axis=1)
    at, to = worst.argmax(axis=1), best.argmin(axis=1)
    each = np.arange(count)
    rows[each, at] = columns[each, to] = 1.0
    value = games[each, at, to]
    mixed = np.flatnonzero(worst[each, at] < best[each, to])
    if mixed.size:
        rows[mixed], columns[mixed] = _simplex(games[mixed])
        for k in mixed[_gap(games[mixed], rows[mixed], columns[mixed]) > _NARROW]:
            rows[k], columns[k] = _by_programs(games[k])
        value[mixed] = np.einsum("gi,gij,gj->g", rows[mixed], games[mixed], columns[mixed])
        if (_gap(games[mixed], rows[mixed], columns[mixed]) > _NARROW).any():
            raise AccuracyError(
                "a matrix game couldn't be solved to ten digits. Round its payoffs."
            )
    return value, rows, columns


def _gap(games: Floats, rows: Floats, columns: Floats) -> Floats:
    """Return the gap between the two players' guarantees."""
    gets = np.einsum("gi,gij->gj", rows, games).min(axis=1)
    pays = np.einsum("gij,gj->gi", games, columns).max(axis=1)
    return np.asarray(pays - gets)


def _simplex(games: Floats) -> tuple[Floats, Floats]:
    """Return both mixtures: maximize sum(y) over A y <= 1, y >= 0, for all games at once."""
    count, m, n = games.shape
    table = np.zeros((count, m + 1, n + m + 1))
    table[:, :m, :n] = games
    table[:, :m, n : n + m] = np.eye(m)
    table[:, :m, -1] = 1.0
    table[:, m, :n] = -1.0
    basis = np.tile(np.arange(n, n + m), (count, 1))
    open_games = np.arange(count)
    for step in range(20 * (m + n)):
        cost = table[open_games, m, : n + m]
        going = cost.min(axis=1) < -1e-12
        open_games, cost = open_games[going], cost[going]
        if not open_games.size:
            break
        # The steepest column; after many steps the first, by which no game goes in circles.
        enter = cost.argmin(axis=1) if step < 4 * (m + n) else (cost < -1e-12).argmax(axis=1)
        each = np.arange(len(open_games))
        now = table[open_games]
        column = now[each, :, enter]
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(column[:, :m] > 1e-12, now[:, :m, -1] / column[:, :m], np.inf)
        leave = ratio.argmin(axis=1)
        pivot = now[each, leave] / column[each, leave][:, None]
        now -= column[:, :, None] * pivot[:, None, :]
        now[each, leave] = pivot
        table[open_games] = now
        basis[open_games, leave] = enter
    columns = np.zeros((count, n + m))
    np.put_along_axis(columns, basis, table[:, :m, -1], axis=1)
    return _mixture(table[:, m, n : n + m]), _mixture(columns[:, :n])


def _mixture(weights: Floats) -> Floats:
    kept = np.clip(weights, 0.0, None)
    total = kept.sum(axis=1, keepdims=True)
    return np.where(total > 0.0, kept / np.where(total > 0.0, total, 1.0), 1.0 / kept.shape[1])


def _by_programs(game: Floats) -> tuple[Floats, Floats]:
    from scipy.optimize import linprog

    m, n = game.shape
    columns: Any = linprog(-np.ones(n), A_ub=game, b_ub=np.ones(m), method="highs")
    rows: Any = linprog(np.ones(m), A_ub=-game.T, b_ub=-np.ones(n), method="highs")
    return _mixture(rows.x[None])[0], _mixture(columns.x[None])[0]
