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
from evenbreak.ratings.posterior import damped, find_zero, step_accuracy, tolerance
from evenbreak.ratings.prior_means import PriorMeans

GRADIENT = 1e-6
"""How small the gradient has to become, in games, times τ where that is below 1."""


AT_ONCE = 32
"""Columns solved together: few enough to stay in the processor's cache."""

VARIANCE_ACCURACY = 1e-4
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
    means
        where players are expected to be before any result.
    """

    def __init__(
        self,
        players: int,
        player_a: Ints,
        player_b: Ints,
        precision: float,
        means: PriorMeans | None = None,
    ) -> None:
        low, high = np.minimum(player_a, player_b), np.maximum(player_a, player_b)
        pairs, self._pair = np.unique(low * players + high, return_inverse=True)
        self._low, self._high = np.divmod(pairs, players)
        self._a_is_low = player_a == low
        self._games = np.zeros(len(pairs))
        self._low_won = np.zeros(len(pairs))
        self._precision = precision
        self._means = PriorMeans.none(players) if means is None else means
        self._kept = 1.0
        self._point = np.concatenate([self._means.mean, np.zeros(len(self._means.level_sd))])

    @property
    def skill(self) -> Floats:
        """The skill of each player."""
        return self._point[: len(self._means.mean)]

    def learn(self, matches: slice, won_a: Ints, won_b: Ints) -> None:
        """Take in the games won in some of the matches."""
        pair = self._pair[matches]
        low_won = np.where(self._a_is_low[matches], won_a, won_b)
        self._games += np.bincount(pair, won_a + won_b, len(self._games))
        self._low_won += np.bincount(pair, low_won, len(self._games))

    def begin_day(self, means: PriorMeans | None = None) -> None:
        """Refit, with other means of the priors if there are any; this ends what was learnt."""
        self._means = self._means if means is None else means.faded(self._kept)
        self._find_mode()

    def fade(self, keep: float) -> None:
        """Reduce the weight of everything so far to a part of what it was."""
        self._games *= keep
        self._low_won *= keep
        self._kept *= keep
        self._means = self._means.faded(keep)

    def difference_variance(self, a: Ints, b: Ints) -> Floats:
        """Return the posterior variance of skill a - skill b, for each pair (Laplace)."""
        solve = self._solver(self._curvatures()[1])
        which = np.arange(len(a))
        # Half the memory, and so half the time; the variance is off by the error's square.
        right: Any = np.zeros((len(self._point), len(a)), dtype=np.float32)
        right[a, which] += 1.0
        right[b, which] -= 1.0
        solved = solve(right, VARIANCE_ACCURACY)
        return np.asarray(solved[a, which] - solved[b, which])

    def _find_mode(self) -> None:
        players = len(self.skill)

        def gradient_at(point: Floats) -> tuple[Floats, Callable[[], Floats]]:
            skill, level = point[:players], point[players:]
            surplus, weight = self._curvatures(skill)
            ends = sums_by_player(players, self._low, self._high, surplus, -surplus)
            of_skill, of_level = self._means.slopes(skill, level, self._precision)
            gradient = np.append(ends + of_skill, of_level)

            def step() -> Floats:
                solved = self._solver(weight)(gradient, step_accuracy(gradient))
                return damped(-solved, self._low, self._high)

            return gradient, step

        most = float((self._ends(self._games) + self._means.information).max())
        enough = tolerance(self._precision, most, GRADIENT)
        self._point = find_zero(self._point, gradient_at, enough).point

    def _curvatures(self, skill: Floats | None = None) -> tuple[Floats, Floats]:
        """Return the slope of the negative log-likelihood in each pair's difference, and the bend.

        By default this is at the skills as they stand.
        """
        at = self.skill if skill is None else skill
        p_low = expit(at[self._low] - at[self._high])
        return self._games * p_low - self._low_won, self._games * p_low * (1.0 - p_low)

    def _ends(self, each: Floats) -> Floats:
        """Return for each player the sum over their pairs, to a few roundings a pair."""
        low, high = (np.bincount(ends, each, len(self.skill)) for ends in (self._low, self._high))
        return np.asarray(low + high)

    def _solver(self, weight: Floats) -> Callable[[Floats, float], Floats]:
        """Return what solves Hx = b to an accuracy, H the Hessian of the negative log-posterior.

        Its block of the players is the Laplacian of `weight` plus τI.
        """
        players, design = len(self.skill), self._means.design
        diagonal = self._ends(weight) + self._precision + self._means.information
        seen = weight > 0.0
        low, high = self._low[seen], self._high[seen]
        upper = sparse.csr_array((-weight[seen], (low, high)), shape=(players, players))
        whole = sparse.csr_array(upper + upper.T + sparse.diags_array(diagonal))
        if design.shape[1]:
            across = -self._precision * design
            levels = np.diag(self._means.precision) - design.T @ across
            blocks: Any = [[whole, across], [across.T, levels]]
            whole = sparse.csr_array(sparse.block_array(blocks))
            diagonal = np.append(diagonal, np.diagonal(levels))
        return lambda right, accuracy: _conjugate_gradients(whole, diagonal, right, accuracy)


def _conjugate_gradients(matrix: Any, diagonal: Floats, right: Floats, accuracy: float) -> Floats:
    """Return the solution of each column, the matrix scaled to a unit diagonal.

    What is left over of each column is at most `accuracy` times it.
    """
    columns = right[:, None] if right.ndim == 1 else right
    scale = 1.0 / np.sqrt(diagonal)
    rows = np.repeat(np.arange(len(scale)), np.diff(matrix.indptr))
    unit = sparse.csr_array(
        (matrix.data * scale[rows] * scale[matrix.indices], matrix.indices, matrix.indptr),
        shape=matrix.shape,
        dtype=columns.dtype,
    )
    scale = scale.astype(columns.dtype)
    solution = np.empty_like(columns)
    for first in range(0, columns.shape[1], AT_ONCE):
        part = slice(first, first + AT_ONCE)
        solution[:, part] = _of_unit_diagonal(unit, scale[:, None] * columns[:, part], accuracy)
    solution *= scale[:, None]
    return solution.reshape(right.shape)


def _of_unit_diagonal(matrix: Any, right: Floats, accuracy: float) -> Floats:
    """Return the solution of each column by conjugate gradients."""
    residual, direction = right.copy(), right.copy()
    solution = np.zeros_like(residual)
    square = _products(residual, residual)
    enough = accuracy**2 * square
    for _ in range(2 * len(right) + 100):
        if (square <= enough).all():
            break
        image = matrix @ direction
        curvature = _products(direction, image)
        length = np.divide(square, curvature, out=np.zeros_like(square), where=curvature > 0)
        solution += length * direction
        image *= length
        residual -= image
        before, square = square, _products(residual, residual)
        direction *= np.divide(square, before, out=np.zeros_like(square), where=before > 0)
        direction += residual
    return solution


def _products(one: Floats, other: Floats) -> Floats:
    """Return the product of each column of one with that of the other."""
    return np.asarray(np.einsum("ij,ij->j", one, other))
