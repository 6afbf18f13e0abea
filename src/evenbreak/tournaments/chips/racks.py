"""The chances of a rack: P(whoever stays at the table beats the challenger)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import column, floats, number
from evenbreak.errors import InputError
from evenbreak.ratings.scale import Scale, scale_of


def rack_chances(
    ratings: ArrayLike, *, scale: Scale | str | float = "fargo", break_advantage: float = 0.0
) -> Floats:
    """Return P(i, who stays at the table, beats the challenger j), by rating.

    Parameters
    ----------
    ratings
        each player's rating.
    scale
        the scale: a name, or the points that double the odds.
    break_advantage
        by how many points the breaker plays better; the player who stays breaks. Negative
        where the challenger breaks.

    >>> rack_chances([600, 500]).round(3)
    array([[0.5  , 0.667],
           [0.333, 0.5  ]])
    """
    rated = column(ratings, "ratings", np.size(ratings), "players")
    gap = rated[:, None] - rated + number(break_advantage, "break_advantage")
    table: Floats = scale_of(scale).win_probability(gap)
    return table


def checked_racks(racks: ArrayLike, players: int) -> Floats:
    """Return the table of the chances of a rack, if it has the right shape."""
    table = floats(racks, "racks", low=0.0, high=1.0)
    if table.shape != (players, players):
        raise InputError(
            "racks has shape {table_shape}; give a row and a column for each of {players} players",
            table_shape=table.shape,
            players=players,
        )
    return table


def break_matters(racks: Floats) -> bool:
    """Return whether it makes a difference who of two stays and who challenges."""
    return bool(np.abs(racks + racks.T - 1.0)[~np.eye(len(racks), dtype=bool)].max() > 1e-12)
