"""Newton's method for the mode of a rating posterior: the loop that all fits share."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Places
from evenbreak.errors import AccuracyError

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
