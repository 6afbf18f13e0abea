"""Many linear systems with one sparse matrix, by conjugate gradients."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse

from evenbreak.arrays import Floats

AT_ONCE = 32
"""Columns solved together: few enough to stay in the processor's cache."""


def solve_columns(matrix: Any, diagonal: Floats, right: Floats, accuracy: float) -> Floats:
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


def _products(left: Floats, right: Floats) -> Floats:
    """Return the product of each column of one with that of the other."""
    return np.asarray(np.einsum("ij,ij->j", left, right))
