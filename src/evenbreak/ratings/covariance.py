"""Joint uncertainty of the ratings: the inverse of the curvature at the mode.

The Hessian of the negative log-posterior is a weighted Laplacian of who met whom plus τ on the
diagonal, and, where a break advantage is estimated too, one more row and column b with the corner
c. By the Schur complement s = c - bᵀH⁻¹b,

    covariance of the ratings = H⁻¹ + H⁻¹b bᵀH⁻¹ / s,    variance of the advantage = 1 / s.

Levels that players share, such as those of teams (see `evenbreak.ratings.beginning`), are
further unknowns of H. If θ is the skills and b the levels, the law of total variance gives

    cov(θ) = cov(θ | b) + cov(θ, b) cov(b)⁻¹ cov(b, θ),

where cov(θ | b) is the inverse of the Laplacian plus τ alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse.linalg import LinearOperator
from scipy.special import expit

from evenbreak.arrays import Floats, Ints, Places
from evenbreak.chains.arcs import sums
from evenbreak.ratings.beginning import PriorMeans
from evenbreak.ratings.conjugate_gradients import solve_columns, solve_unit
from evenbreak.ratings.drawn_differences import DrawnDifferences
from evenbreak.ratings.inverse_diagonal import inverse_diagonal
from evenbreak.ratings.sampled_diagonal import InverseDiagonal

_DENSE_UP_TO = 2000
"""Players up to which the Hessian is factorized once; beyond that, each answer is iterated."""

_SOLVED_UP_TO = 100
"""Unknowns up to which a Newton step is solved exactly, which is then faster than iterating."""


class Pattern:
    """Entries of a symmetric matrix: the sorted pairs (low, high) who met, and the diagonal."""

    def __init__(self, size: int, low: Places, high: Places) -> None:
        starts = np.searchsorted(low, np.arange(size + 1))
        place = np.arange(1.0, len(low) + size + 1)
        upper = sparse.csr_array((place[: len(low)], high, starts), shape=(size, size))
        self._whole = sparse.csr_array(upper + upper.T + sparse.diags_array(place[len(low) :]))
        self._whole.sort_indices()
        self._place = self._whole.data.astype(np.intp) - 1

    def matrix(self, of_pairs: Floats, diagonal: Floats) -> sparse.csr_array:
        """Return the matrix with these entries."""
        data = np.concatenate([of_pairs, diagonal])[self._place]
        whole = self._whole
        return sparse.csr_array((data, whole.indices, whole.indptr), shape=whole.shape)


@dataclass(frozen=True, eq=False)
class Curvature:
    """The Hessian of the negative log-posterior at its mode, in natural log-odds.

    Pairs (low, high) are sorted, with their curvature, 0 or more, as weights; `precision` is τ, the
    prior precision of a rating. `border` and `corner` are the second derivatives in a rating and
    the break advantage, and in the advantage twice; None where it is not estimated. A `pattern` of
    the same pairs is reused.
    """

    size: int
    low: Places
    high: Places
    weight: Floats
    precision: float
    border: Floats | None = None
    corner: float | None = None
    means: PriorMeans | None = None
    pattern: Pattern | None = None

    @cached_property
    def matrix(self) -> sparse.csc_array:
        """The ratings' block: shape (size, size), symmetric.

        Its row sums are all `precision`, unless earlier results add to them.
        """
        return sparse.csc_array(self._rows.T)  # symmetric

    @cached_property
    def _rows(self) -> sparse.csr_array:
        return self._pattern.matrix(-self.weight, self._diagonal)

    @cached_property
    def _pattern(self) -> Pattern:
        return self.pattern or Pattern(self.size, self.low, self.high)

    @cached_property
    def _diagonal(self) -> Floats:
        low, high = (np.bincount(ends, self.weight, self.size) for ends in (self.low, self.high))
        beforehand = 0.0 if self.means is None else self.means.information
        return np.asarray(low + high + self.precision + beforehand)

    @cached_property
    def _across(self) -> Floats:
        """The mixed second derivatives in ratings and levels: shape (size, levels)."""
        design = np.zeros((self.size, 0)) if self.means is None else self.means.design
        return np.asarray(-self.precision * design)

    @cached_property
    def _levels(self) -> Floats:
        """The second derivatives in pairs of levels."""
        if self.means is None:
            return np.zeros((0, 0))
        return np.asarray(np.diag(self.means.precision) - self.means.design.T @ self._across)

    @cached_property
    def with_levels(self) -> tuple[sparse.csr_array, Floats]:
        """The sparse block of the ratings and levels, and its diagonal."""
        matrix = self._rows
        if not len(self._levels):
            return matrix, self._diagonal
        blocks: Any = [[matrix, self._across], [self._across.T, self._levels]]
        diagonal = np.append(self._diagonal, np.diagonal(self._levels))
        return sparse.csr_array(sparse.block_array(blocks)), diagonal

    @cached_property
    def _factor(self) -> Any:
        return cho_factor(self._whole, lower=True)

    @cached_property
    def _border(self) -> Floats | None:
        """The border, extended to the levels, which don't interact with the break advantage."""
        if self.border is None:
            return None
        return np.append(self.border, np.zeros(len(self._levels)))

    @cached_property
    def _with_border(self) -> Floats | None:
        return None if self._border is None else self._solve(self._border)

    @cached_property
    def border_variance(self) -> float | None:
        """The variance of the break advantage, or None if it was not estimated."""
        if self._border is None or self.corner is None or self._with_border is None:
            return None
        return 1.0 / (self.corner - float(self._border @ self._with_border))

    @cached_property
    def _with_levels(self) -> Floats:
        """Covariance of every rating and level with each level, given the break advantage."""
        levels = len(self._levels)
        if self.size + levels <= _DENSE_UP_TO:
            return np.asarray(
                cho_solve(self._factor, np.eye(self.size + levels, levels, -self.size))
            )
        matrix = sparse.csr_array(self.matrix)
        follow = solve_columns(matrix, self._diagonal, -self._across, 1e-12)
        own = np.linalg.inv(self._levels + self._across.T @ follow)
        return np.vstack([follow @ own, own])

    @cached_property
    def level_covariance(self) -> Floats:
        """The covariance of the levels."""
        covariance = self._with_levels[self.size :]
        if self._with_border is not None and self.border_variance is not None:
            with_border = self._with_border[self.size :]
            covariance = covariance + np.outer(with_border, with_border) * self.border_variance
        return np.asarray(covariance)

    @cached_property
    def by_levels(self) -> Floats:
        """The A for which AAᵀ is what uncertain levels add to the covariance of the ratings."""
        if not len(self._levels):
            return np.zeros((self.size, 0))
        root = np.linalg.cholesky(self._with_levels[self.size :])
        return np.asarray(np.linalg.solve(root, self._with_levels[: self.size].T).T)

    @cached_property
    def given_levels(self) -> InverseDiagonal:
        """Variance of each rating given the levels and the advantage, exact or approximate."""
        even = self.means is None or self.means.known is None
        return inverse_diagonal(self.matrix, self.precision if even else None)

    @cached_property
    def _shared(self) -> Floats:
        """The F for which FFᵀ is what levels and advantage add to the ratings' covariance."""
        if self._with_border is None or self.border_variance is None:
            return self.by_levels
        by_border = self._with_border[: self.size] * np.sqrt(self.border_variance)
        return np.column_stack([self.by_levels, by_border])

    def variances(self) -> Floats:
        """Return the variance of each rating."""
        return np.asarray(self.given_levels.value + (self._shared**2).sum(1))

    def with_means(self, group: Ints) -> Floats:
        """Return the covariance of each rating with the mean of its group, all in one solve.

        No players from different groups may have met.
        """
        share = 1.0 / np.bincount(group)[group]
        alone = self._solve(np.append(share, np.zeros(len(self._levels))))[: self.size]
        alone -= self.by_levels @ (share @ self.by_levels)
        means = [np.bincount(group, share * column)[group] for column in self._shared.T]
        return np.asarray(alone + sum(self._shared.T * np.reshape(means, self._shared.T.shape)))

    def times(self, contrast: Floats) -> Floats:
        """Return the covariance of each rating with a weighted sum of the ratings.

        The variance of the sum itself is `contrast @ times(contrast)`.
        """
        product = self._solve(np.append(contrast, np.zeros(len(self._levels))))[: self.size]
        if self._with_border is not None and self.border_variance is not None:
            with_border = self._with_border[: self.size]
            product = product + with_border * (with_border @ contrast) * self.border_variance
        return product

    def drawn(self, differences: DrawnDifferences) -> Floats:
        """Return the approximate variance of each difference, given the break advantage."""
        return differences.variances(*self.with_levels, self.weight, self.precision, self.means)

    def difference_variances(self, first: Places, second: Places) -> Floats:
        """Return the variance of the rating difference of each pair, all at once.

        For up to 2,000 players the full covariance is formed; for more, the variances are sampled.
        """
        if len(self._levels) + self.size > _DENSE_UP_TO:
            drawn = self.drawn(DrawnDifferences(self.size, self.low, self.high, first, second))
            if self._with_border is None or self.border_variance is None:
                return drawn
            apart = self._with_border[first] - self._with_border[second]
            return np.asarray(drawn + apart**2 * self.border_variance)
        covariance = np.asarray(cho_solve(self._factor, np.eye(len(self._whole))))
        if self._with_border is not None and self.border_variance is not None:
            covariance += np.outer(self._with_border, self._with_border) * self.border_variance
        own = np.diagonal(covariance)
        return np.asarray(own[first] + own[second] - 2.0 * covariance[first, second])

    def _solve(self, right: Floats) -> Floats:
        if len(right) <= _DENSE_UP_TO:
            return np.asarray(cho_solve(self._factor, right))
        return self._iterate(right, 1e-12)

    @cached_property
    def _whole(self) -> Floats:
        """The Hessian of ratings and levels."""
        n = self.size
        whole = np.zeros((n + len(self._levels),) * 2)
        whole[self.low, self.high] = whole[self.high, self.low] = -self.weight
        whole[np.arange(n), np.arange(n)] = self._diagonal
        whole[:n, n:], whole[n:, :n], whole[n:, n:] = self._across, self._across.T, self._levels
        return whole

    def newton_step(self, gradient: Floats, slope: float, accuracy: float) -> tuple[Floats, float]:
        """Return the Newton step in ratings and levels, and in the break advantage.

        `gradient` and `slope` are the first derivatives in these, `accuracy` is the relative
        residual.
        """
        step = -self._for_step(gradient, accuracy)
        if self._border is None or self.corner is None:
            return step, 0.0
        bordered = self._for_step(self._border, accuracy)
        rest = self.corner - float(self._border @ bordered)
        if rest <= 0.0:  # not convex here: down along the slope, as if all of the corner were left
            rest = abs(self.corner) + float(self._border @ bordered)
        shift = -(slope + float(self._border @ step)) / rest
        return step - bordered * shift, shift

    def _for_step(self, right: Floats, accuracy: float) -> Floats:
        if len(right) <= _SOLVED_UP_TO:
            return np.asarray(cho_solve(self._factor, right))
        return self._iterate(right, accuracy)

    def _iterate(self, right: Floats, accuracy: float) -> Floats:
        """Return H⁻¹ times a vector by conjugate gradients, H scaled to a unit diagonal."""
        scale = 1.0 / np.sqrt(self._diagonal)
        off = -self.weight * scale[self.low] * scale[self.high]
        unit: Any = self._pattern.matrix(off, np.ones(self.size))
        if len(self._levels):
            of_levels = 1.0 / np.sqrt(np.diagonal(self._levels))
            unit = with_levels(
                unit,
                self._across * scale[:, None] * of_levels,
                self._levels * of_levels[:, None] * of_levels,
            )
            scale = np.append(scale, of_levels)
        return scale * solve_unit(unit, (scale * right)[:, None], accuracy)[:, 0]


def with_levels(matrix: sparse.csr_array, across: Floats, levels: Floats) -> LinearOperator:
    """Return a sparse matrix bordered by a few dense rows and columns, as a linear map."""
    size = len(across)

    def times(v: Floats) -> Floats:
        skill, level = v[:size], v[size:]
        return np.concatenate([matrix @ skill + across @ level, across.T @ skill + levels @ level])

    return LinearOperator((size + len(levels),) * 2, times, matmat=times, dtype=matrix.dtype)


def sums_by_player(
    players: int,
    low: Places,
    high: Places,
    for_low: Floats,
    for_high: Floats | None = None,
) -> Floats:
    """Return the sum over each player's pairs, accurate to about one rounding.

    A plain sum over 20,000 opponents would accumulate error, because each term is rounded the same
    way. Without `for_high`, both players of a pair get the same term.

    >>> sums_by_player(3, np.array([0, 0]), np.array([1, 2]), np.array([1.0, 10.0]))
    array([11., 1., 10.])
    """
    also = for_low if for_high is None else for_high
    return sums(low, for_low, players) + sums(high, also, players)


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

    def curvature(
        self,
        skill: Floats,
        advantage: float,  # noqa: ARG002
        precision: float,
        break_precision: float | None,  # noqa: ARG002
        means: PriorMeans | None = None,
    ) -> Curvature:
        """Return the Hessian of the negative log-posterior, ignoring the break."""
        difference = skill[self.low] - skill[self.high]
        weight = self.games.data * expit(difference) * expit(-difference)
        return Curvature(len(skill), self.low, self.high, weight, precision, means=means)


def count_pairs(
    players: int, player_a: Ints, player_b: Ints, score_a: Ints, score_b: Ints
) -> PairCounts:
    """Return the games won and lost and the games of each pair in the given matches.

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
