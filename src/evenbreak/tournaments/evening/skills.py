"""What tonight's games show about the players' skills.

Each skill is normal around its rating, with the rating's standard error; unrated players' skills
have the same spread as the others' (`skills_before`). The chances in a game between two players are
given by the scale. The posterior is approximated by a normal distribution at its mode (Laplace's
method).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats
from evenbreak.ratings.scale import Scale

_STEPS = 50
_FARTHEST = 2.0  # how many doublings of the odds one step may go
_CENTER, _SPREAD = 2.0, 4.0  # as many rated players the starter's place, and its error, weigh


class Games(NamedTuple):
    """The games between two players, by position, and how many each of them won."""

    one: int
    other: int
    won: int
    lost: int


def skills_before(ratings: Floats, errors: Floats, unrated: Bools) -> tuple[Floats, Floats]:
    """Return the mean and covariance of the players' skills before any game.

    An unrated player is another member of the field: as good on average as the rated players, and
    with the same spread. The starter's rating and error count as a few players in the field, so
    that they decide when few players are rated (the normal-inverse-chi-square posterior). The
    field's center isn't known for certain either, and is the same for all unrated players.
    """
    mean, covariance = ratings.astype(float).copy(), np.diag(errors.astype(float) ** 2)
    field = ratings[~unrated].astype(float)
    if not unrated.any() or not field.size:
        return mean, covariance
    starter, error, rated = float(ratings[unrated][0]), float(errors[unrated][0]), field.size
    center = (_CENTER * starter + field.sum()) / (_CENTER + rated)
    apart = float(((field - field.mean()) ** 2).sum() - (errors[~unrated] ** 2).sum())
    squares = _SPREAD * error**2 + max(apart, 0.0)
    squares += _CENTER * rated / (_CENTER + rated) * (float(field.mean()) - starter) ** 2
    variance = squares / (_SPREAD + rated)
    mean[unrated] = center
    shared = variance / (_CENTER + rated)
    covariance[np.ix_(unrated, unrated)] = shared + variance * np.eye(int(unrated.sum()))
    return mean, covariance


def skills_tonight(
    ratings: Floats, spread: Floats, games: Sequence[Games], scale: Scale, form: float = 0.0
) -> tuple[Floats, Floats]:
    """Return the mean and covariance of the players' skills, given tonight's games.

    `spread` has standard errors (0: exact) or a covariance matrix. `form` is the standard deviation
    of a game's log-odds from match to match: with it, games in a single match count for less than
    the same number of games in several.
    """
    slope = math.log(2.0) / scale.points_per_doubling
    covariance = spread.astype(float) if spread.ndim == 2 else np.diag(spread.astype(float) ** 2)
    mean = ratings.astype(float).copy()
    unsure = np.diag(covariance) > 0.0
    if not unsure.any():
        return mean, np.zeros_like(covariance)
    free = np.ix_(unsure, unsure)
    precision = np.zeros_like(covariance)
    precision[free] = np.linalg.inv(covariance[free])
    for _ in range(_STEPS):
        gradient = precision @ (ratings - mean)
        curvature = precision.copy()
        for one, other, won, lost in games:
            p = float(scale.win_probability(mean[one] - mean[other]))
            says = (won + lost) * p * (1.0 - p)
            weight = 1.0 / (1.0 + says * form**2)
            pull = weight * slope * (won - (won + lost) * p)
            gradient[one] += pull
            gradient[other] -= pull
            both = [one, other]
            bend = weight * slope**2 * says
            curvature[np.ix_(both, both)] += bend * np.array([[1.0, -1.0], [-1.0, 1.0]])
        step = np.linalg.solve(curvature[free], gradient[unsure])
        most = _FARTHEST * scale.points_per_doubling
        mean[unsure] += step * min(1.0, most / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < 1e-9 * scale.points_per_doubling:
            break
    tonight = np.zeros_like(covariance)
    tonight[free] = np.linalg.inv(curvature[free])
    return mean, tonight
