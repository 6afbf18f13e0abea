"""The ranking of a group: matches won, then matches won among tied players."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray


def ranked(
    members: Sequence[int], pairs: Sequence[tuple[int, int]], winners: Sequence[int]
) -> list[int]:
    """Return how many players are ranked ahead of each member; tied players share a number.

    Parameters
    ----------
    members
        the players.
    pairs, winners
        the two players and the winner of each match.

    >>> ranked([4, 5, 6], [(4, 5), (5, 6), (4, 6)], [4, 5, 4])
    [0, 1, 2]
    >>> ranked([4, 5, 6], [(4, 5), (5, 6), (4, 6)], [4, 5, 6])
    [0, 0, 0]
    """
    seat = {player: k for k, player in enumerate(members)}
    beats = np.zeros((len(seat), len(seat)), dtype=np.int16)
    for (one, other), won in zip(pairs, winners, strict=True):
        beats[seat[won], seat[other if won == one else one]] += 1
    ahead: list[int] = players_ahead(beats).tolist()
    return ahead


def players_ahead(beats: NDArray[np.int16]) -> NDArray[np.int16]:
    """Return how many players are ranked ahead of each.

    Players are ranked by wins. Ties are broken by wins among the tied players, again among
    those who are still tied, until nothing changes.

    Parameters
    ----------
    beats
        beats[..., i, j]: how often i beat j.
    """
    wins = beats.sum(axis=-1, dtype=np.int16)
    ahead = _ahead(wins, np.ones(beats.shape, dtype=bool))
    while True:
        level = ahead[..., :, None] == ahead[..., None, :]
        among = np.where(level, beats, 0).sum(axis=-1, dtype=np.int16)
        more = _ahead(among, level)
        if not more.any():
            return ahead
        ahead = ahead + more


def _ahead(score: NDArray[np.int16], compared: NDArray[np.bool_]) -> NDArray[np.int16]:
    better = score[..., None, :] > score[..., :, None]
    counted: NDArray[np.int16] = (better & compared).sum(axis=-1, dtype=np.int16)
    return counted
