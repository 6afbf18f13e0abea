"""Solve many linear systems with the same sparse matrix by conjugate gradients."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse

from evenbreak.arrays import Floats
from evenbreak.errors import AccuracyError

AT_ONCE = 32
"""Columns solved together: few enough to stay in the processor's cache."""


def solve_columns(matrix: Any, diagonal: Floats, right: Floats, accuracy: float) -> Floats:
    """Return the solution for each column, with the matrix scaled to a unit diagonal.

    The norm of each residual is at most `accuracy` times the norm of its column.
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
        solution[:, part] = solve_unit(unit, scale[:, None] * columns[:, part], accuracy)
    solution *= scale[:, None]
    return solution.reshape(right.shape)


def solve_unit(matrix: Any, right: Floats, accuracy: float) -> Floats:
    """Return the solution for each column; the matrix has a unit diagonal.

    Raises AccuracyError if ten steps per unknown are too few because rounding makes the matrix
    nearly singular.
    """
    residual, direction = right.copy(), right.copy()
    solution = np.zeros_like(residual)
    square = _products(residual, residual)
    enough = accuracy**2 * square
    for _ in range(10 * len(right) + 1):
        if (square <= enough).all():
            return solution
        image = matrix @ direction
        curvature = _products(direction, image)
        length = np.divide(square, curvature, out=np.zeros_like(square), where=curvature > 0)
        solution += length * direction
        image *= length
        residual -= image
        before, square = square, _products(residual, residual)
        direction *= np.divide(square, before, out=np.zeros_like(square), where=before > 0)
        direction += residual
    raise AccuracyError("the ratings' covariance couldn't be calculated. Give a smaller prior_sd.")


def energies(matrix: Any, right: Any, accuracy: float) -> Floats:
    """Return xᵀ A⁻¹ x for each column x; A (or a product with it) is symmetric positive definite.

    Each step of conjugate gradients adds the contribution of one more direction (Hestenes & Stiefel
    1952), so neither the solution nor full precision is needed. What further steps would add is
    estimated from the last two steps. A column is done when a step adds no more than the fraction
    `accuracy` of the sum, and the squared residual is no more than the same fraction of the square
    of x.

    >>> energies(np.diag([2.0, 4.0]), np.array([[1.0, 0.0], [1.0, 1.0]]), 1e-9).round(6)
    array([0.75, 0.25])
    """
    sums, residual, direction = np.zeros(right.shape[1]), right, right.copy()
    left = np.arange(len(sums))
    square = _products(residual, residual)
    enough, gain = accuracy * square, np.zeros(len(sums))
    for _ in range(2 * len(right) + 100):
        image = matrix @ direction
        length = _ratio(square, _products(direction, image))
        image *= length
        residual = residual - image
        last, gain = gain, (length * square).astype(np.float64)
        sums[left] += gain
        before, square = square, _products(residual, residual)
        going = (gain > accuracy * sums[left]) | (square > enough)
        if not going.any():
            break
        if 2 * going.sum() < len(left):
            sums[left[~going]] += _rest(last, gain)[~going]
            left, gain, square, before, enough = (
                part[going] for part in (left, gain, square, before, enough)
            )
            residual, direction = residual[:, going], direction[:, going]
        direction *= _ratio(square, before)
        direction += residual
    sums[left] += _rest(last, gain)
    return sums


def _rest(last: Floats, gain: Floats) -> Floats:
    """Return what further steps would add to a sum if each adds the same fraction of the last."""
    part = np.minimum(_ratio(gain, last), 0.75)
    return np.asarray(gain * part / (1.0 - part))


def _ratio(top: Any, bottom: Any) -> Any:
    """Return the ratio, or 0 where there is nothing left to divide."""
    return np.divide(top, bottom, out=np.zeros_like(top), where=bottom > 0)


def _products(left: Floats, right: Floats) -> Floats:
    """Return the column-by-column inner products of two matrices."""
    return np.asarray(np.einsum("ij,ij->j", left, right))
