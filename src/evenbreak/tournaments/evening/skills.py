"""What tonight's games say of the players' skills.

Each skill is normal around its rating, with the rating's standard error, and a game between two
players is won with the chances of the scale. The posterior is approximated by a normal
distribution at its mode (Laplace's method).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.ratings.scale import Scale

_STEPS = 50
_FARTHEST = 2.0  # how many doublings of the odds one step may go


class Games(NamedTuple):
    """The games between two players, by position, and how many each of them won."""

    one: int
    other: int
    won: int
    lost: int


def skills_tonight(
    ratings: Floats, errors: Floats, games: Sequence[Games], scale: Scale
) -> tuple[Floats, Floats]:
    """Return the mean and the covariance of the players' skills, given tonight's games.

    Parameters
    ----------
    ratings, errors
        the ratings and their standard errors; a rating with the error 0 is right.
    games
        what was played.
    scale
        the scale of the ratings.

    >>> from evenbreak.ratings.scale import scale_of
    >>> even = np.array([500.0, 500.0]), np.array([100.0, 0.0])
    >>> mean, spread = skills_tonight(*even, [Games(0, 1, 7, 2)], scale_of("fargo"))
    >>> mean.round(), np.sqrt(spread[0, 0]).round()
    (array([584., 500.]), np.float64(71.0))
    """
    slope = math.log(2.0) / scale.points_per_doubling
    unsure = errors > 0.0
    precision = np.zeros(len(errors))
    precision[unsure] = errors[unsure] ** -2.0
    mean = ratings.astype(float).copy()
    covariance = np.zeros((len(mean), len(mean)))
    if not unsure.any():
        return mean, covariance
    free = np.ix_(unsure, unsure)
    for _ in range(_STEPS):
        gradient = precision * (ratings - mean)
        curvature = np.diag(precision)
        for one, other, won, lost in games:
            p = float(scale.win_probability(mean[one] - mean[other]))
            pull = slope * (won - (won + lost) * p)
            gradient[one] += pull
            gradient[other] -= pull
            bend = slope**2 * (won + lost) * p * (1.0 - p)
            both = [one, other]
            curvature[np.ix_(both, both)] += bend * np.array([[1.0, -1.0], [-1.0, 1.0]])
        step = np.linalg.solve(curvature[free], gradient[unsure])
        most = _FARTHEST * scale.points_per_doubling
        mean[unsure] += step * min(1.0, most / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < 1e-9 * scale.points_per_doubling:
            break
    covariance[free] = np.linalg.inv(curvature[free])
    return mean, covariance
