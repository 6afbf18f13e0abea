"""The mode of the Bradley-Terry posterior, by a sparse Newton method.

With skills θ in natural log-odds, player i beats j with chance 1 / (1 + exp(θj - θi)).
Games are independent given the skills, and every skill has the prior N(0, 1/τ). Up to a
constant the negative log-posterior is

    f(θ) = Σ_{i<j} n_ij log(exp θi + exp θj) - Σ_i w_i θi + (τ/2) Σ_i θi²

so win totals w and pair counts n are all that it needs. Its Hessian is the Laplacian of
the graph of play, weighted by n_ij p_ij p_ji, plus τI: a symmetric M-matrix.

This is the quick way where all games count alike: without a value of f to compare it takes
a few times less work than the general one (see `evenbreak.ratings.mixed_posterior`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, cg
from scipy.special import expit

from evenbreak.errors import AccuracyError
from evenbreak.ratings.covariance import Curvature

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GRADIENT_TOLERANCE = 1e-8
_MOST_STEPS = 200


@dataclass(frozen=True, eq=False)
class PairCounts:
    """Who won how many games, and which pair played how many: all that the model needs.

    `games` is an upper triangular CSR matrix of shape (players, players); `low` and
    `high` are the two players of each pair, in the order of `games.data`.
    """

    won: Ints
    lost: Ints
    games: sparse.csr_array
    low: NDArray[np.intp]
    high: NDArray[np.intp]


def count_pairs(
    players: int, player_a: Ints, player_b: Ints, score_a: Ints, score_b: Ints
) -> PairCounts:
    """Return win totals and pair counts of matches between `players` players."""
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


class Mode(NamedTuple):
    """Where the posterior is highest, and how well it was found."""

    skill: Floats
    gradient: float
    iterations: int


def curvature(pairs: PairCounts, skill: Floats, precision: float) -> Curvature:
    """Return the Hessian of the negative log-posterior, in natural log-odds."""
    difference = skill[pairs.low] - skill[pairs.high]
    weight = pairs.games.data * expit(difference) * expit(-difference)
    return Curvature(len(skill), pairs.low, pairs.high, weight, precision)


def find_mode(pairs: PairCounts, precision: float) -> Mode:
    """Return the skills that are most likely a posteriori, in natural log-odds.

    Each Newton system is solved by conjugate gradients, more exactly as the steps get
    shorter. The step length needs no search: where the skills of opponents change by at
    most β, log(1 + β)/β of the step always goes down, and so does all of it while β < 1.7.

    Parameters
    ----------
    pairs
        what was played.
    precision
        τ, the prior precision 1/sd² in log-odds.

    Raises
    ------
    AccuracyError
        if the gradient's largest entry does not come down to 1e-8 min(1, τ), or to the
        rounding of the counts if that is more.

    Notes
    -----
    The model: Bradley & Terry (1952). The steps: generalised self-concordance (Bach 2010;
    Sun & Tran-Dinh 2019, Theorem 2).
    """
    # The prior weighs as much as 4τ games between equals: a start near the mode.
    skill = np.log((pairs.won + 2.0 * precision) / (pairs.lost + 2.0 * precision))
    # H >= τI, so a gradient g leaves the skills within |g|/τ of the mode.
    rounding = 1e-14 * float((pairs.won + pairs.lost).max(initial=0))
    tolerance = max(GRADIENT_TOLERANCE * min(1.0, precision), rounding)
    games = pairs.games.data
    for iteration in range(_MOST_STEPS):
        p_low = expit(skill[pairs.low] - skill[pairs.high])
        surplus = games * p_low
        gradient = _ends(pairs, surplus, games - surplus) - pairs.won + precision * skill
        size = float(np.abs(gradient).max(initial=0.0))
        if size <= tolerance:
            return Mode(skill, size, iteration)
        step = _newton_step(pairs, surplus * (1.0 - p_low), gradient, precision)
        beta = float(np.abs(step[pairs.low] - step[pairs.high]).max(initial=0.0))
        skill = skill + (step if beta < 1.7 else step * (math.log1p(beta) / beta))
    raise AccuracyError(
        f"the ratings' gradient is {size:.1e} after {_MOST_STEPS} Newton steps; give a smaller "
        "prior_sd"
    )


def _newton_step(pairs: PairCounts, weight: Floats, gradient: Floats, precision: float) -> Floats:
    """Return -H⁻¹g by conjugate gradients, H scaled to a unit diagonal."""
    scale = 1.0 / np.sqrt(_ends(pairs, weight) + precision)
    upper = _with_data(pairs.games, weight * scale[pairs.low] * scale[pairs.high])
    lower = upper.T
    shape = pairs.games.shape
    scaled = LinearOperator(shape, lambda v: v - upper @ v - lower @ v, dtype=np.float64)
    right = -scale * gradient
    # The error of an inexact step adds to the squared error of the exact one.
    accuracy = min(0.1, float(np.abs(right).max()))
    solution, _ = cg(scaled, right, rtol=max(accuracy, 1e-9), atol=0.0)
    return scale * np.asarray(solution)


def _ends(pairs: PairCounts, low: Floats, high: Floats | None = None) -> Floats:
    """Return for each player the sum over his pairs of `low` or `high`, as he is in them."""
    players = len(pairs.won)
    total: Floats = np.bincount(pairs.low, low, players).astype(np.float64)
    total += np.bincount(pairs.high, low if high is None else high, players)
    return total


def _with_data(matrix: sparse.csr_array, data: Floats) -> sparse.csr_array:
    return sparse.csr_array((data, matrix.indices, matrix.indptr), shape=matrix.shape)
