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

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.special import expit

from evenbreak.arrays import Floats, Places
from evenbreak.errors import AccuracyError
from evenbreak.ratings.covariance import Curvature, PairCounts, sums_by_player


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


# Newton's method for the mode of a rating posterior: the loop that all fits share.


MOST_STEPS = 200
GRADIENT_TOLERANCE = 1e-8
_ROUNDING = 1e-14


class Mode(NamedTuple):
    """Where the posterior is highest, the largest entry of its gradient there, and the steps."""

    point: Floats
    gradient: float
    iterations: int


def tolerance(precision: float, most: float, gradient: float = GRADIENT_TOLERANCE) -> float:
    """Return how small the gradient of the negative log-posterior has to become, in games.

    Parameters
    ----------
    precision
        τ, the prior precision of a skill. H >= τI, so a gradient g leaves the skills within
        |g|/τ of the mode.
    most
        the most games of one player; their rounding limits what can be reached.
    gradient
        what is enough where τ is 1 or more.
    """
    return max(gradient * min(1.0, precision), _ROUNDING * most)


def find_zero(
    start: Floats,
    gradient_at: Callable[[Floats], tuple[Floats, Callable[[], Floats]]],
    enough: float,
) -> Mode:
    """Return the point at which a gradient is zero, within `enough` in each entry.

    Parameters
    ----------
    start
        where to begin.
    gradient_at
        the gradient at a point, and what returns the step to take from there.
    enough
        the largest entry of the gradient at which to stop.

    Raises
    ------
    AccuracyError
        if the gradient is still larger after `MOST_STEPS` steps.

    >>> find_zero(np.zeros(2), lambda x: (x - 3.0, lambda: 3.0 - x), 1e-9)
    Mode(point=array([3., 3.]), gradient=0.0, iterations=1)
    """
    point, size = start, 0.0
    for iteration in range(MOST_STEPS):
        gradient, step = gradient_at(point)
        size = float(np.abs(gradient).max(initial=0.0))
        if size <= enough:
            return Mode(point, size, iteration)
        point = point + step()
    raise AccuracyError(
        f"the ratings' gradient is {size:.1e} after {MOST_STEPS} Newton steps; give a smaller "
        "prior_sd"
    )


def step_accuracy(gradient: Floats) -> float:
    """Return how exactly to solve for a Newton step: more exactly as the gradient gets smaller.

    The error of an inexact step adds to the squared error of the exact one.

    >>> step_accuracy(np.array([0.01, -0.02]))
    0.02
    """
    return max(min(0.1, float(np.abs(gradient).max())), 1e-9)


def damped(step: Floats, low: Places, high: Places) -> Floats:
    """Return a Newton step, shortened where it would change a skill difference by much.

    Where the skills of opponents change by at most β, log(1 + β)/β of the step always goes
    down, and so does all of it while β < 1.7. So no search for a step length is needed.

    Notes
    -----
    Generalised self-concordance: Bach (2010); Sun & Tran-Dinh (2019), Theorem 2.
    """
    beta = float(np.abs(step[low] - step[high]).max(initial=0.0))
    return step if beta < 1.7 else step * (math.log1p(beta) / beta)
