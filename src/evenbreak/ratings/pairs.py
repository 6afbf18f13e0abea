"""Who won how many games, and who played whom how often: all that the plain model needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.special import expit

from evenbreak.arrays import Floats, Ints, Places
from evenbreak.ratings.covariance import Curvature
from evenbreak.ratings.prior_means import PriorMeans


@dataclass(frozen=True, eq=False)
class PairCounts:
    """Games won and lost by each player, and games played by each pair.

    `games` is an upper triangular CSR matrix of shape (players, players); `low` and
    `high` are the two players of each pair, in the order of `games.data`.
    """

    won: Ints
    lost: Ints
    games: sparse.csr_array
    low: Places
    high: Places

    @property
    def graph(self) -> sparse.csr_array:
        """Who met whom: shape (players, players), upper triangular."""
        return self.games

    @property
    def amount(self) -> float:
        """How many games there are."""
        return float(self.games.sum())

    def curvature(
        self,
        skill: Floats,
        advantage: float,  # noqa: ARG002
        precision: float,
        break_precision: float | None,  # noqa: ARG002
        means: PriorMeans | None = None,
    ) -> Curvature:
        """Return the Hessian of the negative log-posterior; the break does not matter here."""
        difference = skill[self.low] - skill[self.high]
        weight = self.games.data * expit(difference) * expit(-difference)
        return Curvature(len(skill), self.low, self.high, weight, precision, means=means)


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
