"""Part of a very large season, enough to choose a prior: whole clubs that meet.

Matches drawn one by one would leave each player with few of them, and the prior would seem to
matter more than it does. So whole clubs are drawn, recognized by who plays whom, each with all
matches within it and those against clubs drawn earlier.
"""

from __future__ import annotations

from dataclasses import fields

import numpy as np
from scipy import sparse

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.results import Results
from evenbreak.ratings.sampled_diagonal import SEED, blocks_of


def connected_part(results: Results, matches: int) -> Results:
    """Return the matches among some clubs that meet: as many as asked for, or a few more.

    A season with fewer is returned as it is. The same season always has the same part.

    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> len(connected_part(season, 100))
    2
    """
    counted = results.counted
    if counted.sum() <= matches:
        return results
    a, b = results.player_a[counted], results.player_b[counted]
    size = len(results.players)
    block = blocks_of(size, *_met(size, a, b))
    drawn = _drawn(block[a], block[b], int(block.max()) + 1, matches)[block]
    return _among(results, np.flatnonzero(drawn))


def _met(size: int, a: Ints, b: Ints) -> tuple[Ints, Ints, Floats]:
    """Return the pairs that met, and how often."""
    pair, often = np.unique(np.minimum(a, b) * size + np.maximum(a, b), return_counts=True)
    return pair // size, pair % size, often.astype(np.float64)


def _drawn(a: Ints, b: Ints, blocks: int, matches: int) -> np.ndarray:
    """Return which blocks are drawn: at random, each among those that meet an earlier one."""
    met = sparse.csr_array((np.ones(len(a)), (a, b)), shape=(blocks, blocks))
    met = sparse.csr_array(met + met.T)  # within a block every match counts twice
    order = np.random.default_rng(SEED).permutation(blocks)
    place = np.argsort(order)
    drawn, linked, left = np.zeros(blocks, bool), np.zeros(blocks, bool), np.ones(blocks, bool)
    many = 0.0
    while many < matches and left.any():
        next_in_order = (
            int(np.argmax(linked & left)) if (linked & left).any() else int(left.argmax())
        )
        new = int(order[next_in_order])
        left[next_in_order] = False
        row = slice(met.indptr[new], met.indptr[new + 1])
        others, often = met.indices[row], met.data[row]
        many += float(often[drawn[others]].sum() + often[others == new].sum() / 2.0)
        drawn[new] = True
        linked[place[others]] = True
    return drawn


def _among(results: Results, players: Ints) -> Results:
    """Return the matches that the given players played among themselves."""
    place = np.full(len(results.players), -1)
    place[players] = np.arange(len(players))
    rows = results.select((place[results.player_a] >= 0) & (place[results.player_b] >= 0))
    columns = {field.name: getattr(rows, field.name) for field in fields(rows)}
    columns |= {
        "players": tuple(results.players[k] for k in players.tolist()),
        "player_a": place[rows.player_a],
        "player_b": place[rows.player_b],
    }
    return Results(**columns)
