"""The chain of a ladder over all rating errors, whichever of them its start can reach.

A ladder as a game begins at no error, and by steps of 3 it never comes to an error of 1. A
newcomer may begin anywhere; so the chain here has every error from -widest to widest.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.chains import Chain, chain_from_arrays
from evenbreak.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.handicaps.ladder import Ladder

__all__ = ["chain_of_errors", "error_on", "has_parity", "move_matrix", "unit_of"]


def move_matrix(ladder: Ladder, factor: int = 1) -> NDArray[np.float64]:
    """Return P(error j after the match | error i before it), shape (errors, errors).

    Rows are the errors before. Moves are multiplied by the factor of a newcomer. A move beyond
    an end is not made.
    """
    if factor == 1 or not ladder.drift:
        return _matrix(ladder.steps * factor, ladder.kernel)
    # The factor is one of the match's moves, not of the skill that grows meanwhile.
    steady = replace(ladder, drift=0.0)
    shift, chance = -np.sign(ladder.drift), abs(ladder.drift)
    grown = np.tile([1.0 - chance, chance], (len(ladder.errors), 1))
    by_match = _matrix(steady.steps * factor, steady.kernel)
    return np.asarray(by_match @ _matrix(np.array([0, int(shift)]), grown))


def _matrix(steps: NDArray[np.int64], kernel: NDArray[np.float64]) -> NDArray[np.float64]:
    many = len(kernel)
    place = np.arange(many)
    matrix = np.zeros((many, many))
    for step, chance in zip(steps.tolist(), kernel.T, strict=True):
        to = place + step
        matrix[place, np.where((to < 0) | (to >= many), place, to)] += chance
    return matrix


def chain_of_errors(ladder: Ladder) -> Chain:
    """Return the chain of a ladder, its states all errors in points in their order."""
    matrix = move_matrix(ladder)
    before, after = np.nonzero(matrix)
    # Chances that add up to 1 may come out above it by a rounding.
    chances = np.minimum(matrix[before, after], 1.0)
    return chain_from_arrays(ladder.errors.tolist(), before, after, chances, start=0)


def unit_of(ladder: Ladder) -> int:
    """Return the number of points of which all moves that can happen are multiples."""
    return math.gcd(*ladder.steps[(ladder.kernel > 0.0).any(axis=0)].tolist())


def has_parity(ladder: Ladder) -> bool:
    """Return whether an error away from the ends comes back to itself in even matches only.

    It does where all moves are odd multiples of one number: +-1, +-3, or +1 and -3.
    """
    unit = unit_of(ladder)
    moves = ladder.steps[(ladder.kernel > 0.0).any(axis=0)]
    return unit > 0 and bool((moves // unit % 2).all())


def error_on(widest: int, start: Any, what: str = "rating error") -> int:
    """Return `start` as an int if it is a whole number from -widest to widest.

    Raises
    ------
    InputError
        if it is none.
    """
    try:
        error = int(start)
        right = bool(error == start) and not isinstance(start, str | bytes)
    except (TypeError, ValueError, OverflowError):
        right = False
    if not right or abs(error) > widest:
        raise InputError(
            f"start is {start!r}; give a {what} in whole points from {-widest} to {widest}, or a "
            "larger widest"
        )
    return error
