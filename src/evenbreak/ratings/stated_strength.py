"""How strong a league takes its players to be, by the races that it makes them play.

A race m:n is even where the first player wins a game with the chance p for which W(p; m, n) = 1/2;
the difference of strength that it implies is ln p/(1 - p). The players' strengths are those whose
differences come nearest to the implied ones, by least squares over all matches so far.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import cg
from scipy.special import betaincinv, logit

from evenbreak.arrays import Floats
from evenbreak.ratings.results import Results

RIDGE = 0.01
"""A weight, in matches, towards 0: it decides between groups that never met."""

_SOLVED_UP_TO = 100
"""Players up to which the equations are solved exactly, which is faster than to iterate."""


def implied_difference(results: Results) -> Floats:
    """Return by how much a is stronger than b if the race is even, in log-odds; NaN without one.

    >>> season = Results.from_names(["A", "A"], ["B", "B"], [7, 5], [2, 5], race_a=[7, 5],
    ...     race_b=[3, 5])
    >>> implied_difference(season).round(3)
    array([0.914, 0.   ])
    """
    race_a, race_b = results.races
    stated = (race_a > 0) & (race_b > 0)
    p = betaincinv(np.where(stated, race_a, 1), np.where(stated, race_b, 1), 0.5)
    return np.where(stated, logit(p), np.nan)


def has_handicaps(results: Results) -> bool:
    """Return whether any stated race is uneven."""
    race_a, race_b = results.races
    return bool(((race_a > 0) & (race_b > 0) & (race_a != race_b)).any())


class StatedStrength:
    """How strong players are by the races seen so far.

    Parameters
    ----------
    results
        the matches that will be seen.
    """

    def __init__(self, results: Results) -> None:
        self._players = len(results.players)
        self._a, self._b = results.player_a, results.player_b
        self._implied = implied_difference(results)
        self._stated = ~np.isnan(self._implied)
        self._seen = np.zeros(len(results), dtype=bool)
        self._last = np.zeros(self._players)
        self._up_to_date = False

    def see(self, rows: Any) -> None:
        """Take in the races of some matches."""
        self._up_to_date &= bool(self._seen[rows].all())
        self._seen[rows] = True

    def strength(self) -> Floats:
        """Return each player's strength in natural log-odds, 0 where no race says anything."""
        if self._up_to_date:
            return self._last
        self._up_to_date = True
        rows = self._seen & self._stated
        matches, players = int(rows.sum()), self._players
        sign = np.repeat([1.0, -1.0], matches)
        ends = np.concatenate([self._a[rows], self._b[rows]])
        which = np.tile(np.arange(matches), 2)
        contrast = sparse.coo_array((sign, (which, ends)), shape=(matches, players)).tocsr()
        normal = contrast.T @ contrast + RIDGE * sparse.eye_array(players)
        right = contrast.T @ self._implied[rows]
        if players <= _SOLVED_UP_TO:
            self._last = np.linalg.solve(normal.toarray(), right)
        else:
            self._last, _ = cg(normal, right, self._last, rtol=1e-8)
        return self._last
