"""The chance and the length of each race at each rating difference.

Arrays have races as rows and differences as columns: shape (races, differences). If X is the number
of the first k games that player 1 would win if all were played,

    W(p; m, n) = I_p(m, n)
    E[games]   = (m / p) I_p(m + 1, n) + (n / q) I_q(n + 1, m)
    P(games <= k) = P(X >= m) + P(k - X >= n),  k < m + n - 1

(the mean follows from k C(k - 1, m - 1) = m C(k, m)).
"""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import betainc, betaincinv

from evenbreak.arrays import Floats
from evenbreak.games.race import Race
from evenbreak.matches.length import match_length
from evenbreak.matches.parameters import in_shape
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import Scale


@overload
def even_doublings(m: float, n: float) -> float: ...
@overload
def even_doublings(m: ArrayLike, n: ArrayLike) -> Floats: ...
def even_doublings(m: Any, n: Any) -> Any:
    """Return how many doublings of a game's odds make the race m:n even.

    Multiplied by the points that double the odds, this is the rating difference at which the race
    is even: positive if player 1 needs more games.

    Notes
    -----
    Source: P5.5, solved for p at W(p; m, n) = 1/2. Both p and 1 - p are found by inverting
    the incomplete beta function, so that neither loses precision.

    >>> round(100.0 * even_doublings(7, 4), 2)
    86.09
    """
    mine, theirs = np.asarray(m, dtype=float), np.asarray(n, dtype=float)
    odds = np.asarray(betaincinv(mine, theirs, 0.5)) / betaincinv(theirs, mine, 0.5)
    return in_shape(np.log2(odds), odds.shape)


def win_grid(scale: Scale, m: ArrayLike, n: ArrayLike, differences: ArrayLike) -> Floats:
    """Return P(player 1 wins m:n | player 1 is rated higher by each of the differences).

    m and n have shape (races,), the result (races, differences).

    >>> from evenbreak.ratings import SCALES
    >>> win_grid(SCALES["npl"], [4, 2], [2, 1], [0, 30]).round(3).tolist()
    [[0.188, 0.461], [0.25, 0.444]]
    """
    points = np.asarray(differences, dtype=float)
    return np.asarray(race_win_probability(scale.win_probability(points), *_columns(m, n)))


def mean_games_grid(scale: Scale, m: ArrayLike, n: ArrayLike, differences: ArrayLike) -> Floats:
    """Return the mean length in games; parameters and shape as for `win_grid`."""
    p, q, m, n = _chances_and_columns(scale, m, n, differences)
    return np.asarray(m * betainc(m + 1, n, p) / p + n * betainc(n + 1, m, q) / q)


def ends_within_grid(
    scale: Scale, m: ArrayLike, n: ArrayLike, differences: ArrayLike, games: int
) -> Floats:
    """Return P(the match takes at most `games` games); other parameters as for `win_grid`."""
    p, q, m, n = _chances_and_columns(scale, m, n, differences)
    won_1 = np.where(m <= games, betainc(m, np.maximum(games - m + 1, 1), p), 0.0)
    won_2 = np.where(n <= games, betainc(n, np.maximum(games - n + 1, 1), q), 0.0)
    return np.where(m + n - 1 <= games, 1.0, won_1 + won_2)


def games_quantiles(
    scale: Scale, m: int, n: int, differences: ArrayLike, q: float
) -> NDArray[np.int64]:
    """Return the fewest games within which m:n ends with probability q, by difference."""
    points = np.asarray(differences, dtype=float)
    return match_length(Race(m, n, scale.rack(points))).quantile(q).astype(np.int64)


def even_differences(scale: Scale, m: ArrayLike, n: ArrayLike) -> Floats:
    """Return the differences at which the races are even, in points; shape (races,)."""
    return np.asarray(scale.points_per_doubling * even_doublings(m, n), dtype=float)


def _columns(m: ArrayLike, n: ArrayLike) -> tuple[NDArray[Any], NDArray[Any]]:
    return np.asarray(m)[:, np.newaxis], np.asarray(n)[:, np.newaxis]


def _chances_and_columns(
    scale: Scale, m: ArrayLike, n: ArrayLike, differences: ArrayLike
) -> tuple[Floats, Floats, NDArray[Any], NDArray[Any]]:
    points = np.asarray(differences, dtype=float)
    return scale.win_probability(points), scale.win_probability(-points), *_columns(m, n)
