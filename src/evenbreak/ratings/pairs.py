"""Who won how many games, and who played whom how often: all that the plain model needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class PairCounts:
    """Games won and lost by each player, and games played by each pair.

    `games` is an upper triangular CSR matrix of shape (players, players); `low` and
    `high` are the two players of each pair, in the order of `games.data`.
    """

    won: Ints
    lost: Ints
    games: sparse.csr_array
    low: NDArray[np.intp]
    high: NDArray[np.intp]


def count_pairs(
    players: int, player_a: Ints, player_b: Ints, score_a: Ints, score_b: Ints
) -> PairCounts:
    """Return the games won and lost, and the games of each pair, in some matches.

    >>> counts = count_pairs(3, np.array([0, 2]), np.array([1, 0]), np.array([7, 5]),
    ...                      np.array([4, 7]))
    >>> counts.won, counts.low, counts.high, counts.games.data
    (array([14, 4, 5]), array([0, 0]), array([1, 2]), array([11., 12.]))
    """
    won = np.bincount(player_a, score_a, players) + np.bincount(player_b, score_b, players)
    lost = np.bincount(player_a, score_b, players) + np.bincount(player_b, score_a, players)
    low = np.minimum(player_a, player_b).astype(np.int32)
    high = np.maximum(player_a, player_b).astype(np.int32)
    games = sparse.coo_array(
        ((score_a + score_b).astype(np.float64), (low, high)), shape=(players, players)
    ).tocsr()
    return PairCounts(
        won.astype(np.int64),
        lost.astype(np.int64),
        games,
        np.repeat(np.arange(players), np.diff(games.indptr)),
        games.indices.astype(np.intp),
    )


def sums_by_player(
    players: int,
    low: NDArray[np.intp],
    high: NDArray[np.intp],
    for_low: Floats,
    for_high: Floats | None = None,
) -> Floats:
    """Return for each player the sum over their pairs.

    Parameters
    ----------
    players
        how many there are.
    low, high
        the two players of each pair.
    for_low, for_high
        what each pair adds to its low and its high player; the same where only one is given.

    >>> sums_by_player(3, np.array([0, 0]), np.array([1, 2]), np.array([1.0, 10.0]))
    array([11., 1., 10.])
    """
    total: Floats = np.bincount(low, for_low, players).astype(np.float64)
    total += np.bincount(high, for_low if for_high is None else for_high, players)
    return total
