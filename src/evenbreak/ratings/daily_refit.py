"""Ratings refitted day by day, each time from where they stood the day before.

The model is that of `evenbreak.ratings.posterior`. Little changes from one day to the next,
so a few Newton steps from yesterday's mode find today's. Newton systems, and the variances
of today's differences, are solved by conjugate gradients, which here take no longer than a
factorisation and start no threads that wait for each other.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse
from scipy.special import expit

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.covariance import sums_by_player
from evenbreak.ratings.newton import damped, find_zero, step_accuracy, tolerance

GRADIENT = 1e-6
"""How small the gradient has to become, in games, times τ where that is below 1."""


VARIANCE_ACCURACY = 1e-5
"""How exactly to solve for a variance, which is off by the square of what its solution is."""


class DailyRefit:
    """The skills of a league's players in natural log-odds, as results come in.

    Parameters
    ----------
    players
        how many there are, including those who have not played yet.
    player_a, player_b
        the players of each match that will come in, in that order.
    precision
        τ, the prior precision 1/sd² in log-odds.
    """

    def __init__(self, players: int, player_a: Ints, player_b: Ints, precision: float) -> None:
        low, high = np.minimum(player_a, player_b), np.maximum(player_a, player_b)
        pairs, self._pair = np.unique(low * players + high, return_inverse=True)
        self._low, self._high = np.divmod(pairs, players)
        self._a_is_low = player_a == low
        self._games = np.zeros(len(pairs))
        self._low_won = np.zeros(len(pairs))
        self._precision = precision
        self._solve: Callable[[Floats, float], Floats] | None = None
        self.skill = np.zeros(players)

    def learn(self, matches: slice, won_a: Ints, won_b: Ints) -> None:
        """Take in the games won in some of the matches."""
        pair = self._pair[matches]
        low_won = np.where(self._a_is_low[matches], won_a, won_b)
        self._games += np.bincount(pair, won_a + won_b, len(self._games))
        self._low_won += np.bincount(pair, low_won, len(self._games))
        self._find_mode()

    def fade(self, keep: float) -> None:
        """Reduce the weight of everything so far to a part of what it was."""
        self._games *= keep
        self._low_won *= keep
        self._find_mode()

    def difference_variance(self, a: Ints, b: Ints) -> Floats:
        """Return the posterior variance of skill a - skill b, for each pair (Laplace)."""
        if self._solve is None:
            return np.where(a == b, 0.0, 2.0 / self._precision)
        which = np.arange(len(a))
        right = np.zeros((len(self.skill), len(a)))
        right[a, which] += 1.0
        right[b, which] -= 1.0
        solved = self._solve(right, VARIANCE_ACCURACY)
        return np.asarray(solved[a, which] - solved[b, which])

    def _find_mode(self) -> None:
        def gradient_at(skill: Floats) -> tuple[Floats, Callable[[], Floats]]:
            p_low = expit(skill[self._low] - skill[self._high])
            surplus = self._games * p_low - self._low_won
            ends = sums_by_player(len(skill), self._low, self._high, surplus, -surplus)
            gradient = ends + self._precision * skill
            solve = self._solver(self._games * p_low * (1.0 - p_low))
            self._solve = solve
            accuracy = step_accuracy(gradient)
            return gradient, lambda: damped(-solve(gradient, accuracy), self._low, self._high)

        most = float(self._ends(self._games).max())
        enough = tolerance(self._precision, most, GRADIENT)
        self.skill = find_zero(self.skill, gradient_at, enough).point

    def _ends(self, each: Floats) -> Floats:
        """Return for each player the sum over their pairs, to a few roundings a pair."""
        low, high = (np.bincount(ends, each, len(self.skill)) for ends in (self._low, self._high))
        return np.asarray(low + high)

    def _solver(self, weight: Floats) -> Callable[[Floats, float], Floats]:
        """Return what solves Hx = b to an accuracy, H the Laplacian of `weight` plus τI."""
        players = len(self.skill)
        diagonal = self._ends(weight) + self._precision
        seen = weight > 0.0
        low, high = self._low[seen], self._high[seen]
        upper = sparse.csr_array((-weight[seen], (low, high)), shape=(players, players))
        whole = sparse.csr_array(upper + upper.T + sparse.diags_array(diagonal))
        return lambda right, accuracy: _conjugate_gradients(whole, diagonal, right, accuracy)


def _conjugate_gradients(matrix: Any, diagonal: Floats, right: Floats, accuracy: float) -> Floats:
    """Return the solution of each column, the matrix scaled to a unit diagonal.

    What is left over of each column is at most `accuracy` times it.
    """
    columns = right[:, None] if right.ndim == 1 else right
    scale = 1.0 / np.sqrt(diagonal)[:, None]
    residual = scale * columns
    solution = np.zeros_like(residual)
    direction = residual.copy()
    square = (residual**2).sum(0)
    enough = accuracy**2 * square
    for _ in range(2 * len(diagonal) + 100):
        if (square <= enough).all():
            break
        image = scale * (matrix @ (scale * direction))
        curvature = (direction * image).sum(0)
        length = np.divide(square, curvature, out=np.zeros_like(square), where=curvature > 0)
        solution += length * direction
        residual -= length * image
        before, square = square, (residual**2).sum(0)
        direction = residual + direction * np.divide(
            square, before, out=np.zeros_like(square), where=before > 0
        )
    return (scale * solution).reshape(right.shape)
