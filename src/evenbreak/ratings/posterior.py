"""The mode of the Bradley-Terry posterior, by a sparse Newton method.

With skills θ in natural log-odds, player i beats j with chance 1 / (1 + exp(θj - θi)).
Games are independent given the skills, and every skill has the prior N(0, 1/τ). Up to a
constant the negative log-posterior is

    f(θ) = Σ_{i<j} n_ij log(exp θi + exp θj) - Σ_i w_i θi + (τ/2) Σ_i θi²

so win totals w and pair counts n are all that it needs. Its Hessian is the Laplacian of
the graph of play, weighted by n_ij p_ij p_ji, plus τI: a symmetric M-matrix.

This is the fast route where all games count alike: it never evaluates f, so it does a fraction
of the work of the general one (see `evenbreak.ratings.mixed_posterior`).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.special import expit

from evenbreak.arrays import Floats
from evenbreak.ratings.covariance import Curvature, sums_by_player
from evenbreak.ratings.newton import Mode, damped, find_zero, step_accuracy, tolerance
from evenbreak.ratings.pairs import PairCounts


def find_mode(pairs: PairCounts, precision: float) -> Mode:
    """Return the skills that are most likely a posteriori, in natural log-odds.

    Each Newton system is solved by conjugate gradients, more exactly as the steps get
    shorter.

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
    The model: Bradley & Terry (1952).
    """
    # The prior weighs as much as 4τ games between equals: a start near the mode.
    start = np.log((pairs.won + 2.0 * precision) / (pairs.lost + 2.0 * precision))
    games = pairs.games.data
    ends = len(pairs.won), pairs.low, pairs.high
    # Written over in each step, since allocating them each time takes a tenth longer.
    p_low, surplus = np.empty_like(games), np.empty_like(games)

    def gradient_at(skill: Floats) -> tuple[Floats, Callable[[], Floats]]:
        expit(skill[pairs.low] - skill[pairs.high], out=p_low)
        np.multiply(games, p_low, out=surplus)
        gradient = sums_by_player(*ends, surplus, games - surplus) - pairs.won + precision * skill

        def step() -> Floats:
            curvature = Curvature(*ends, surplus * (1.0 - p_low), precision)
            full, _ = curvature.newton_step(gradient, 0.0, step_accuracy(gradient))
            return damped(full, pairs.low, pairs.high)

        return gradient, step

    most = float((pairs.won + pairs.lost).max(initial=0))
    return find_zero(start, gradient_at, tolerance(precision, most))
