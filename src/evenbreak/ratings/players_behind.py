"""How many players a gain in prediction rests on, and how uncertain the gain is as a result.

A player's matches go well or badly together, so their gains are not independent. If u is the gain
in each match, the variance of the sum over all matches is that of two-way clusters (Aronow, Samii &
Assenova 2015): the covariance of every two matches that have a player in common,

    V = Σ_i (Σ u of player i's matches)² - Σ_ij (Σ u of the matches between i and j)².

The gains are not centered on their mean, because the many players for whom nothing changes would
distort it. So V is somewhat too large, and if n players gain equally, the sum is at most √n
standard errors above 0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints, Places


class PlayersBehind(NamedTuple):
    """The players in some matches."""

    player_a: Ints | Places
    player_b: Ints | Places

    def spread(self, values: ArrayLike) -> float:
        """Return the standard deviation of the sum of some values, one per match.

        >>> two_players = PlayersBehind(np.array([0, 0, 0]), np.array([1, 2, 3]))
        >>> two_players.spread([1.0, 1.0, 1.0])  # all depends on one player
        3.0
        """
        each = np.asarray(values, dtype=float)
        pair = np.sort(np.column_stack(self), axis=1)
        _, place = np.unique(
            pair[:, 0] * (pair.max(initial=0) + 1) + pair[:, 1], return_inverse=True
        )
        together = (self._of_players(each) ** 2).sum() - (np.bincount(place, each) ** 2).sum()
        return math.sqrt(max(float(together), float((each**2).sum())))

    def behind(self, gains: ArrayLike) -> int:
        """Return the smallest number of players without whose matches there is no gain overall.

        Players are left out in order of the gain from their matches.

        >>> PlayersBehind(np.array([0, 0, 2]), np.array([1, 2, 3])).behind([3.0, 2.0, -1.0])
        1
        """
        each = np.asarray(gains, dtype=float)
        of_players = self._of_players(each)
        rank = np.empty(len(of_players), dtype=np.int64)
        rank[np.argsort(-of_players, kind="stable")] = np.arange(len(of_players))
        gone = np.bincount(np.minimum(rank[self.player_a], rank[self.player_b]), each)
        left = each.sum() - np.cumsum(gone)
        enough = 1e-9 * float(np.abs(each).sum())
        return int((left > enough).argmin()) + 1 if each.sum() > enough else 0

    def _of_players(self, each: Floats) -> Floats:
        many = int(max(self.player_a.max(initial=-1), self.player_b.max(initial=-1))) + 1
        return np.asarray(
            np.bincount(self.player_a, each, many) + np.bincount(self.player_b, each, many)
        )
