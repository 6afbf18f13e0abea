"""How much stronger players are per unit of difference in their league's handicaps.

A unit is a class, a rating point, or the difference that a race makes up for. In match i, games are
won with the log-odds k x + e, where x is the league's figure and e is normal with mean 0 and
variance v and the same in all games of the match: players differ from their league's figures, and
from day to day. k and v are estimated by maximum likelihood. The end of a race depends only on its
games, so races of any kind may be mixed. Matches that share a player are not independent, so the
standard error is the dyadic sandwich estimate: products of slopes are summed over all pairs of
matches with a player in common (Aronow, Samii & Assenova 2015, "Cluster-robust variance estimation
for dyadic data").
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import expit, log_expit, logsumexp, ndtri, stdtrit

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.estimates import CONFIDENCE, Estimate, with_error
from evenbreak.ratings.integrated import normal_nodes
from evenbreak.ratings.levels import implied_difference
from evenbreak.ratings.results import Results

NODES = 15
"""Nodes of the Gauss-Hermite rule."""

_STEP = 1e-4
_BOX = [(-50.0, 50.0), (0.0, 3.0)]


def handicap_slope(results: Results, x: Floats) -> Estimate | None:
    """Return k with its 95% interval; None if the matches do not determine it.

    x is how much stronger a is supposed to be than b in each match with games.

    >>> season = Results.from_names(["Ann"] * 4, ["Bo", "Cy"] * 2, [7, 5, 7, 6], [5, 7, 4, 7])
    >>> round(handicap_slope(season, np.ones(4)).value, 3)
    0.083
    """
    from scipy.optimize import minimize

    size = float(np.abs(x).max(initial=0.0))
    if size == 0.0:
        return None
    games = results.score_a.astype(float), results.score_b.astype(float)
    rows, of_row = np.unique(np.column_stack([x / size, *games]), axis=0, return_inverse=True)
    many = np.bincount(of_row.ravel())
    model = _Model(*rows.T)

    def loss(at: Floats) -> tuple[float, Floats]:
        whole, slopes = model.at(at)
        return -float(many @ whole), -(many @ slopes)

    likeliest = minimize(loss, np.array([0.0, 0.3]), jac=True, method="L-BFGS-B", bounds=_BOX).x
    free = np.array([True, likeliest[1] > 10 * _STEP])
    bend = np.column_stack([_bend(model, many, likeliest, k) for k in range(2)])[np.ix_(free, free)]
    if abs(likeliest[0]) > 0.99 * _BOX[0][1] or not (np.linalg.eigvalsh(bend) > 0.0).all():
        return None
    slopes = model.at(likeliest)[1][of_row.ravel()][:, free]
    inverse = np.linalg.inv(bend)
    # Few players may make the first come out too small by luck, even below that of pairs alone.
    variance = max(
        float((inverse @ scores @ inverse)[0, 0]) for scores in _spreads(results, slopes)
    )
    # A few players vary more than their sum of squares shows: Student's t, in normal units.
    freedom = max(_players(results) - 2, 1)
    wider = stdtrit(freedom, 0.5 + CONFIDENCE / 2) / ndtri(0.5 + CONFIDENCE / 2)
    return with_error(float(likeliest[0]) / size, float(wider) * math.sqrt(variance) / size)


def race_share(results: Results) -> Estimate | None:
    """Return how much players differ per unit of difference that their races make up for.

    It is 1 if races are fair, and above 1 if they make up for too little. It is also what a head
    start says about its players before their games. None if no race is uneven or the results don't
    show it.

    >>> season = Results.from_names(["Ann"] * 4, ["Bo", "Cy"] * 2, [7, 5, 7, 6], [4, 5, 4, 5],
    ...     race_a=[7] * 4, race_b=[5] * 4)
    >>> round(race_share(season).value, 2)
    0.92
    """
    season = results.played().results
    implied = implied_difference(season)
    stated = ~np.isnan(implied)
    return handicap_slope(season.select(stated), implied[stated])


def _bend(model: _Model, many: Ints, at: Floats, k: int) -> Floats:
    """Return a column of the negative Hessian of the log-likelihood."""
    step = np.zeros(2)
    step[k] = _STEP
    below = np.maximum(at - step, [low for low, _ in _BOX])
    change = model.at(below)[1] - model.at(at + step)[1]
    return np.asarray(many @ change / (at + step - below)[k])


class _Model:
    """Log-likelihood of matches, given the league's figures and the games won and lost."""

    def __init__(self, x: Floats, won: Floats, lost: Floats) -> None:
        self._x, self._won, self._lost = (column[:, None] for column in (x, won, lost))
        points, weights = normal_nodes(NODES)
        self._points, self._weights = points, np.log(weights)

    def at(self, k_and_sd: Floats) -> tuple[Floats, Floats]:
        """Return the log-likelihood of each match, and its derivatives in k and in √v."""
        k, sd = k_and_sd
        d = k * self._x + sd * self._points
        log = self._won * log_expit(d) + self._lost * log_expit(-d) + self._weights
        whole = logsumexp(log, axis=1)
        pull = np.exp(log - whole[:, None]) * (self._won - (self._won + self._lost) * expit(d))
        return whole, np.column_stack([pull.sum(1) * self._x[:, 0], pull @ self._points])


def _spreads(results: Results, slopes: Floats) -> tuple[Floats, Floats]:
    """Return the covariance of the summed slopes, where matches that share a player are correlated.

    In the second version, only matches of the same two players are correlated.
    """
    a, b = results.player_a, results.player_b
    both = np.minimum(a, b) * len(results.players) + np.maximum(a, b)
    pairs, of_match = np.unique(both, return_inverse=True)
    of_pair = _summed(of_match, slopes, len(pairs))
    many = len(results.players)
    of_player = _summed(a, slopes, many) + _summed(b, slopes, many)
    players = _players(results)
    few = players / max(players - 2, 1)
    alone = few * of_pair.T @ of_pair
    return few * of_player.T @ of_player - alone, alone


def _summed(group: Ints, values: Floats, many: int) -> Floats:
    return np.column_stack([np.bincount(group, column, many) for column in values.T])


def _players(results: Results) -> int:
    return len(np.union1d(results.player_a, results.player_b))
