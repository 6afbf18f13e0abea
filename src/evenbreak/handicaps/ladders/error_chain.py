"""The chain of a ladder over all rating errors, whether or not its start can reach them.

As a game, a ladder starts with no error, and with steps of 3 it never reaches an error of 1. A
newcomer may start anywhere, so this chain has every error from -widest to widest.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.chains import Chain, chain_from_arrays
from evenbreak.checks import whole
from evenbreak.handicaps.ladders.error_walk import walk_matrix
from evenbreak.handicaps.ladders.ladder import Ladder


def move_matrix(ladder: Ladder, factor: int = 1) -> Floats:
    """Return P(error j after the match | error i before it), shape (errors, errors).

    Rows are the errors before. Moves are multiplied by a newcomer's factor; a move beyond an end
    is not made.
    """
    if factor == 1 or not ladder.drift:
        return walk_matrix(ladder.steps * factor, ladder.kernel)
    # The factor applies to the moves, not to the skill that grows meanwhile.
    steady = replace(ladder, drift=0.0)
    shift, chance = -np.sign(ladder.drift), abs(ladder.drift)
    grown = np.tile([1.0 - chance, chance], (len(ladder.errors), 1))
    by_match = walk_matrix(steady.steps * factor, steady.kernel)
    return np.asarray(by_match @ walk_matrix(np.array([0, int(shift)]), grown))


def chain_of_errors(ladder: Ladder) -> Chain:
    """Return a ladder's chain, whose states are all errors in points, in order."""
    matrix = move_matrix(ladder)
    before, after = np.nonzero(matrix)
    # Chances that add up to 1 may exceed it by a rounding error.
    chances = np.minimum(matrix[before, after], 1.0)
    return chain_from_arrays(ladder.errors.tolist(), before, after, chances, start=0)


def unit_of(ladder: Ladder) -> int:
    """Return the greatest common divisor of all possible moves, in points."""
    return math.gcd(*_moves(ladder))


def period_of(ladder: Ladder) -> int:
    """Return the period of the error away from the ends.

    An error returns to itself only after a multiple of this many matches: 2 for moves of +-1 or
    +-3, 3 for +2 and -1, 4 for +1 and -3, 1 for moves of one and two points either way. All moves
    leave the same remainder modulo the common divisor of their differences. Drift of the skill is
    ignored: it breaks the period, but only slowly, by a point now and then.
    """
    if ladder.drift:
        ladder = replace(ladder, drift=0.0, day_sd=0.0, match_sd=0.0)
    moves = _moves(ladder)
    unit = math.gcd(*moves)
    return math.gcd(*(move - moves[0] for move in moves)) // unit if unit and moves[1:] else 1


def _moves(ladder: Ladder) -> list[int]:
    """Return the possible moves."""
    return [int(move) for move in ladder.steps[(ladder.kernel > 0.0).any(axis=0)]]


def error_on(widest: int, start: Any, what: str = "rating error") -> int:
    """Return `start` as an int from -widest to widest; raise InputError if it isn't one."""
    wanted = f"a {what} in whole points from {-widest} to {widest}, or make widest larger"
    return whole(start, "start", at_least=-widest, at_most=widest, wanted=wanted)
