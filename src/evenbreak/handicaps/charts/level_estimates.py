"""Estimate the strength of a chart's skill levels from a league's own results.

A player at level L has the strength s_L + u, where the player's own distance from the middle of the
level, u, is N(0, spread^2); the difference between two strengths gives the log-odds of a game. The
strengths are estimated together with all u, shrunk toward what is known from elsewhere (standard
deviation `PRIOR_SD`), and the spread is estimated by maximum marginal likelihood, with Laplace's
approximation (Breslow & Clayton 1993).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse
from scipy.optimize import minimize_scalar
from scipy.sparse.linalg import splu
from scipy.special import expit

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import SCALES

FARGO = SCALES["fargo"]

PRIOR_SD = 50.0
"""How far a league's levels may be from other leagues' (standard deviation), in points."""

WIDEST, NARROWEST = 300.0, 3.0
"""The spreads of players within a level that are considered, in points."""

_MOST_STEPS, _TINY = 50, 1e-6


def estimated_levels(
    usual: Floats, results: Results, places: tuple[Ints, Ints]
) -> tuple[Floats, Floats, float]:
    """Return the levels' Fargo points, their covariance, and the spread within a level.

    `usual` holds their points without the results; `places` holds the levels of a and b in each
    match.
    """
    season = _Season(usual, results, places)
    low, high = np.log([NARROWEST, WIDEST])
    best: Any = minimize_scalar(
        lambda log_spread: -season.at(np.exp(log_spread))[0],
        bounds=(low, high),
        method="bounded",
        options={"xatol": 0.05},
    )
    spread = float(np.exp(best.x)) if best.x > low + 0.1 else 0.0
    _, points, covariance = season.at(max(spread, NARROWEST))
    return points, covariance, spread


class _Season:
    """A league's games between players at some levels, and the likelihood of a spread."""

    def __init__(self, usual: Floats, results: Results, places: tuple[Ints, Ints]) -> None:
        sides = results.player_a, results.player_b
        who, code = np.unique(np.concatenate(sides), return_inverse=True)
        a, b = np.split(code.ravel(), 2)
        rows, self._levels = np.arange(len(results)), len(usual)
        columns = np.concatenate([*places, self._levels + a, self._levels + b])
        signs = np.repeat([1.0, -1.0, 1.0, -1.0], len(rows))
        shape = len(rows), self._levels + len(who)
        self._contrast = sparse.csr_matrix((signs, (np.tile(rows, 4), columns)), shape=shape)
        self._won = results.score_a.astype(float)
        self._played = self._won + results.score_b
        self._mean = np.concatenate([usual, np.zeros(len(who))]) / FARGO.points_per_log_odds
        self._at = self._mean

    def at(self, spread: float) -> tuple[float, Floats, Floats]:
        """Return the log-likelihood of a spread, the levels' points and their covariance."""
        unit = FARGO.points_per_log_odds
        weight = np.full(len(self._mean), (unit / spread) ** 2)
        weight[: self._levels] = (unit / PRIOR_SD) ** 2
        for _ in range(_MOST_STEPS):
            step = splu(self._curvature(weight)).solve(self._slope(weight))
            while self._value(self._at + step, weight) < self._value(self._at, weight) - _TINY:
                step /= 2.0
            self._at = self._at + step
            if np.abs(step).max() < _TINY:
                break
        curvature = splu(self._curvature(weight))
        log_determinant = np.log(np.abs(curvature.U.diagonal())).sum()
        value = self._value(self._at, weight) + (np.log(weight).sum() - log_determinant) / 2.0
        inverse = curvature.solve(np.eye(len(weight), self._levels))
        return (
            float(value),
            self._at[: self._levels] * unit,
            inverse[: self._levels] * unit**2,
        )

    def _value(self, at: Floats, weight: Floats) -> float:
        odds = self._contrast @ at
        value = self._won @ odds - self._played @ np.logaddexp(0.0, odds)
        return float(value - weight @ (at - self._mean) ** 2 / 2.0)

    def _slope(self, weight: Floats) -> Floats:
        left = self._won - self._played * expit(self._contrast @ self._at)
        return np.asarray(self._contrast.T @ left - weight * (self._at - self._mean))

    def _curvature(self, weight: Floats) -> sparse.csc_matrix:
        p = expit(self._contrast @ self._at)
        of_games = self._contrast.multiply((self._played * p * (1.0 - p))[:, None])
        return sparse.csc_matrix(self._contrast.T @ of_games + sparse.diags(weight))
