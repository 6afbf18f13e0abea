"""How uncertain ratings are together: the inverse of the curvature at the mode.

The Hessian of the negative log-posterior is a weighted Laplacian of who met whom plus τ
on the diagonal, and, where a break advantage is estimated too, one more row and column b
with the corner c. By the Schur complement s = c - bᵀH⁻¹b,

    covariance of the ratings = H⁻¹ + H⁻¹b bᵀH⁻¹ / s,    variance of the advantage = 1 / s.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse.linalg import LinearOperator, cg

from evenbreak.arrays import Floats, Places
from evenbreak.chains.arcs import sums
from evenbreak.errors import AccuracyError
from evenbreak.ratings.inverse_diagonal import inverse_diagonal

_DENSE_UP_TO = 2000
"""Players up to which the Hessian is factorised once; with more, each answer is iterated."""


@dataclass(frozen=True, eq=False)
class Curvature:
    """The Hessian of the negative log-posterior at its mode, in natural log-odds.

    Attributes
    ----------
    size
        how many players there are.
    low, high, weight
        the two players of each pair that met, sorted by the low player and then the high one,
        and the pair's curvature, 0 or more.
    precision
        τ, the prior precision of a rating.
    border, corner
        the second derivatives in a rating and the break advantage, and in the advantage
        twice; None where it is not estimated.
    """

    size: int
    low: Places
    high: Places
    weight: Floats
    precision: float
    border: Floats | None = None
    corner: float | None = None

    @cached_property
    def matrix(self) -> sparse.csc_array:
        """The ratings' block: shape (size, size), symmetric, its row sums all `precision`."""
        upper = self._upper(-self.weight)
        return sparse.csc_array(upper + upper.T + sparse.diags_array(self._diagonal))

    def _upper(self, values: Floats) -> sparse.csr_array:
        """Return an upper triangle with a value for each pair."""
        starts = np.searchsorted(self.low, np.arange(self.size + 1))
        return sparse.csr_array((values, self.high, starts), shape=(self.size, self.size))

    @cached_property
    def _diagonal(self) -> Floats:
        return sums_by_player(self.size, self.low, self.high, self.weight) + self.precision

    @cached_property
    def _factor(self) -> Any:
        return cho_factor(self.matrix.toarray(), lower=True)

    @cached_property
    def _with_border(self) -> Floats | None:
        return None if self.border is None else self._solve(self.border)

    @cached_property
    def border_variance(self) -> float | None:
        """The variance of the break advantage, or None where it is not estimated."""
        if self.border is None or self.corner is None or self._with_border is None:
            return None
        return 1.0 / (self.corner - float(self.border @ self._with_border))

    def variances(self) -> Floats:
        """Return the variance of each rating."""
        variance = inverse_diagonal(self.matrix, self.precision)
        if self._with_border is not None and self.border_variance is not None:
            variance = variance + self._with_border**2 * self.border_variance
        return variance

    def times(self, contrast: Floats) -> Floats:
        """Return the covariance of each rating with a weighted sum of them.

        The variance of the sum itself is `contrast @ times(contrast)`.
        """
        product = self._solve(contrast)
        if self._with_border is not None and self.border_variance is not None:
            shared = float(self._with_border @ contrast) * self.border_variance
            product = product + self._with_border * shared
        return product

    def _solve(self, right: Floats) -> Floats:
        if self.size <= _DENSE_UP_TO:
            return np.asarray(cho_solve(self._factor, right))
        return self._iterate(right, 1e-12)

    def newton_step(self, gradient: Floats, slope: float, accuracy: float) -> tuple[Floats, float]:
        """Return the step of the ratings and of the break advantage that Newton's method takes.

        Parameters
        ----------
        gradient, slope
            the first derivatives in each rating, and in the advantage.
        accuracy
            the relative residual of the linear systems.
        """
        step = -self._iterate(gradient, accuracy)
        if self.border is None or self.corner is None:
            return step, 0.0
        bordered = self._iterate(self.border, accuracy)
        rest = self.corner - float(self.border @ bordered)
        if rest <= 0.0:  # not convex here: down along the slope, as if all of the corner were left
            rest = abs(self.corner) + float(self.border @ bordered)
        shift = -(slope + float(self.border @ step)) / rest
        return step - bordered * shift, shift

    def _iterate(self, right: Floats, accuracy: float) -> Floats:
        """Return H⁻¹ times a vector by conjugate gradients, H scaled to a unit diagonal."""
        scale = 1.0 / np.sqrt(self._diagonal)
        upper = self._upper(self.weight * scale[self.low] * scale[self.high])
        lower = upper.T
        scaled = LinearOperator(upper.shape, lambda v: v - upper @ v - lower @ v, dtype=np.float64)
        solution, failed = cg(scaled, scale * right, rtol=accuracy, atol=0.0)
        if failed:
            raise AccuracyError("the ratings' covariance was not found; give a smaller prior_sd")
        return np.asarray(scale * solution)


def sums_by_player(
    players: int,
    low: Places,
    high: Places,
    for_low: Floats,
    for_high: Floats | None = None,
) -> Floats:
    """Return for each player the sum over their pairs, right to about one rounding.

    A plain sum over 20,000 opponents moves in jumps: each term is rounded the same way.

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
    also = for_low if for_high is None else for_high
    return sums(low, for_low, players) + sums(high, also, players)
