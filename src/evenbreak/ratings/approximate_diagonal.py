"""The diagonal of the inverse of a league's Hessian, where no elimination order keeps it sparse.

All rows of H sum to τ, so 1/τ is the eigenvalue of H⁻¹ for the constant vector and, with
a weak prior, its largest by far. It is put aside exactly: with u the vector of ones,

    diag H⁻¹ = diag (H + αuuᵀ)⁻¹ + α / (τ² + ατn)

and, scaled to a unit diagonal by S, what is left is I - W with the spectral radius ρ of W
small in a league where everybody may meet everybody. Eliminating all others but i,

    ((I - W)⁻¹)ᵢᵢ = 1 / (1 - Σⱼₖ Wᵢⱼ Cⱼₖ Wₖᵢ),

C being the inverse without row i, whose eigenvalues lie between 1/(1+ρ) and 1/(1-ρ). So
the sum is known within that factor of Σⱼ Wᵢⱼ², which is small where players have many
games. Within those bounds C is taken as its diagonal, and that as the answer sought: the
cavity approximation, exact but for cycles of opponents (Thouless, Anderson & Palmer 1977).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.linalg import lapack
from scipy.sparse.linalg import LinearOperator, eigsh

from evenbreak.arrays import Floats
from evenbreak.errors import AccuracyError

_LARGE = 2000
"""From this many rows on, answers may be approximate, because they are much faster."""

_WELL_MIXED = 0.002
"""How far from certain an answer by cavities may be. As ρ² is at least the sum of any row of
squares, no such sum is then above .015, and every round comes 60 times nearer."""
_ROUNDS = 6


def approximate_diagonal(matrix: sparse.csc_array, row_sum: float | None) -> Floats:
    """Return the diagonal of the inverse; parameters and errors of `inverse_diagonal`."""
    if matrix.shape[0] >= _LARGE and row_sum is not None:
        league = _Levelled.of(matrix, row_sum)
        for diagonal_of in (_by_cavities, _in_single_precision):
            diagonal = diagonal_of(league)
            if diagonal is not None:
                return diagonal * league.scale**2 + league.level
    return _in_double_precision(matrix)


@dataclass(frozen=True, eq=False)
class _Levelled:
    """S (H + αuuᵀ) S = I - W, where W is `pull` - r rᵀ off the diagonal and 0 on it."""

    pull: sparse.csc_array
    r: Floats
    scale: Floats
    level: float

    @classmethod
    def of(cls, matrix: sparse.csc_array, row_sum: float) -> _Levelled:
        size = matrix.shape[0]
        degree = matrix.diagonal()
        alpha = float(degree.mean()) / size
        scale = 1.0 / np.sqrt(degree + alpha)
        pull = sparse.diags_array(degree) - matrix
        pull = sparse.diags_array(scale) @ pull @ sparse.diags_array(scale)
        level = alpha / (row_sum * (row_sum + alpha * size))
        return cls(sparse.csc_array(pull), np.sqrt(alpha) * scale, scale, level)


def _by_cavities(league: _Levelled) -> Floats | None:
    """Return the diagonal of (I - W)⁻¹, or None if it is not known within 0.2%."""
    r, pull = league.r, league.pull
    rr, size = r * r, len(r)
    w = LinearOperator((size, size), lambda v: pull @ v - r * (r @ v) + rr * v, dtype=np.float64)
    start = np.cos(np.arange(size))
    largest = eigsh(w, 1, which="LM", tol=0.01, v0=start, return_eigenvectors=False)
    radius = 1.05 * abs(float(largest[0]))  # Lanczos comes from below
    squares = pull.multiply(pull) - 2.0 * (sparse.diags_array(r) @ pull @ sparse.diags_array(r))

    def squared(v: Floats) -> Floats:
        product: Floats = squares @ v + rr * (rr @ v) - rr * rr * v
        return product

    total = float(squared(np.ones(size)).max())
    unknown = 2.0 * radius * total / (1.0 - radius**2) if radius < 0.5 else 1.0
    if unknown > _WELL_MIXED * (1.0 - total / (1.0 - radius)):
        return None
    diagonal = np.ones(size)
    for _ in range(_ROUNDS):
        diagonal = 1.0 / (1.0 - squared(diagonal))
    return diagonal


def _in_single_precision(league: _Levelled) -> Floats | None:
    """Return the diagonal of (I - W)⁻¹, or None if single precision may not be enough."""
    r = league.r.astype(np.float32)
    block = np.multiply.outer(r, r).T
    column = np.repeat(np.arange(len(r)), np.diff(league.pull.indptr))
    block[league.pull.indices, column] -= league.pull.data.astype(np.float32)
    np.fill_diagonal(block, 1.0)
    norm = float(np.abs(block).sum(axis=0).max())
    factor, failed = lapack.spotrf(block, lower=1, overwrite_a=1)
    if failed:
        return None
    reciprocal_condition, _ = lapack.spocon(factor, norm, uplo="L")
    if reciprocal_condition < 1e-3:
        return None
    inverse, _ = lapack.strtri(factor, lower=1, overwrite_c=1)
    return _square_sums(inverse)


def _in_double_precision(matrix: sparse.csc_array) -> Floats:
    factor, failed = lapack.dpotrf(matrix.toarray(order="F"), lower=1, overwrite_a=1)
    if failed:
        raise not_definite()
    inverse, _ = lapack.dtrtri(factor, lower=1, overwrite_c=1)
    return _square_sums(inverse)


def _square_sums(lower: NDArray[Any]) -> Floats:
    """Return the sum of the squares of every column of a lower triangle."""
    columns = (lower[k:, k] for k in range(len(lower)))
    return np.array([column @ column for column in columns], dtype=np.float64)


def not_definite() -> AccuracyError:
    """Return the error of a Hessian that rounding has made singular."""
    return AccuracyError("the posterior's Hessian is singular to rounding; give a smaller prior_sd")
