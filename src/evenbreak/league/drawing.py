"""How a block of matches is drawn: the winner, the final score, or every rack.

Arrays have a row for each pair of players and a column for each replica. `row` is the skill
difference + gap and may have one column for all replicas; `place` is the rating difference +
widest.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools
from evenbreak.league.lookup import Lookup

Score = NDArray[np.int8]


def random_bits(rng: np.random.Generator, shape: tuple[int, ...]) -> NDArray[np.uint32]:
    """Return whole numbers from 0 to 2^32 - 1, each equally likely.

    >>> random_bits(np.random.default_rng(1), (2, 3)).shape
    (2, 3)
    """
    many = math.prod(shape)
    # Twice as fast as `integers`, which returns the same bits.
    raw: Any = rng.bit_generator.random_raw((many + 1) // 2)
    return np.asarray(raw, dtype=np.uint64).view(np.uint32)[:many].reshape(shape)


def draw_winners(wins: NDArray[np.uint32], cell: NDArray[Any], rng: np.random.Generator) -> Bools:
    """Return where player 1 wins; `cell` is the place in `wins`, the chances in 2^32nds."""
    limit = np.empty(cell.shape, dtype=np.uint32)
    np.take(wins, cell, out=limit, mode="wrap")  # all are in range; 'raise' would copy
    return random_bits(rng, cell.shape) < limit


def draw_scores(
    look: Lookup, row: NDArray[Any], place: NDArray[Any], rng: np.random.Generator
) -> Score:
    """Return the final score of each match, drawn with its exact probability."""
    tables, races = look.cumulative
    where = row * int(races.max() + 1) + races.take(place)
    bits = random_bits(rng, where.shape)
    score = np.zeros(where.shape, dtype=np.int8)
    for table in tables[:-1]:
        score += bits > table.take(where)
    return score


def play_racks(
    look: Lookup, row: NDArray[Any], place: NDArray[Any], rng: np.random.Generator
) -> Score:
    """Return the final score of each match, after playing all its racks."""
    m, n = (needs.take(place) for needs in look.needs)
    limit = look.racks.take(row)
    a, b = np.zeros_like(m), np.zeros_like(n)
    going = np.ones(m.shape, dtype=bool)
    while going.any():
        won = random_bits(rng, m.shape) < limit
        a += won & going
        b += ~won & going
        going = (a < m) & (b < n)
    return np.where(a == m, b, n + a)
