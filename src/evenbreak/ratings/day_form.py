"""Form of the day: how much the chances of a game vary from match to match about the ratings.

In match i the log-odds of every game are c + e, where e, the same in all games of the match, is
normal. Its variance is v more than that of the ratings' difference, and c is such that the chance
of a game is as the ratings say (see `evenbreak.matches.form`). v is estimated by maximum
likelihood, with e and the uncertainty of the ratings integrated out; its standard error is the
sandwich's.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.special import expit, log_expit, logsumexp

from evenbreak.arrays import Floats
from evenbreak.matches.form import centre_of_form
from evenbreak.ratings.decay import until
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.doubtful_scores import doubtful_scores
from evenbreak.ratings.estimates import Estimate, with_error
from evenbreak.ratings.fit import weights_of
from evenbreak.ratings.fitted import DayForm, Ratings
from evenbreak.ratings.results import Results

NODES = 15
"""Nodes of the Gauss-Hermite rule."""

LARGEST = 4.0
"""The largest variance that is looked for."""

LONGEST = 50
"""Matches with more games are left out."""

FEWEST_DAYS = 20
"""Dates from which the matches of a date may depend on each other."""

FEWEST = 100
"""Matches from which the variance is estimated."""

MOST_PLAYERS = 2000
"""Players up to which each match is compared with the ratings from all others."""

_STEP = 1e-3


def form_variance(
    difference: Floats, sd: Floats, won: Floats, lost: Floats, cluster: NDArray[np.int64]
) -> Estimate:
    """Return the variance of form that makes the scores of some matches most likely.

    Parameters
    ----------
    difference, sd
        what ratings that do not know the match say: the log-odds of a game, and how far they may
        be off.
    won, lost
        the games of each match.
    cluster
        matches with the same number may depend on each other.
    """
    points, weights = normal_nodes()

    def log_likelihood(v: float) -> Floats:
        x = log_odds_of(difference, sd, v)[:, None] + np.sqrt(sd**2 + v)[:, None] * points
        log = won[:, None] * log_expit(x) + lost[:, None] * log_expit(-x) + np.log(weights)
        return np.asarray(logsumexp(log, axis=1))

    likeliest = minimize_scalar(
        lambda v: -float(log_likelihood(v).sum()), bounds=(0.0, LARGEST), method="bounded"
    )
    v = float(likeliest.x) if likeliest.x > _STEP else 0.0
    here, above, below = (log_likelihood(max(v, _STEP) + step) for step in (0.0, _STEP, -_STEP))
    bend = float((2.0 * here - above - below).sum()) / _STEP**2
    _, cluster = np.unique(cluster, return_inverse=True)
    slopes = np.bincount(cluster, (above - below) / (2.0 * _STEP))
    error = math.sqrt(float(((slopes - slopes.mean()) ** 2).sum())) / bend if bend > 0 else math.inf
    return with_error(v, error)


def log_odds_of(difference: Floats, sd: Floats, v: float) -> Floats:
    """Return the mean log-odds of a game with form, for which its chance stays as it is."""
    return centre_of_form(difference, sd, math.sqrt(v))


def normal_nodes() -> tuple[Floats, Floats]:
    """Return the nodes and weights of the rule that integrates over strengths."""
    points, weights = np.polynomial.hermite_e.hermegauss(NODES)
    return points, weights / math.sqrt(2.0 * math.pi)


def day_form(results: Results, ratings: Ratings) -> DayForm | None:
    """Return the form of the day in the results that a league was rated by.

    Each match is compared with the ratings that all other matches give.

    Parameters
    ----------
    results, ratings
        the results, and what `fit` made of them.

    Returns
    -------
    DayForm or None
        None with fewer than 100 matches of two games or more whose scores are known, with more than
        2,000 players, or where the break matters.

    Notes
    -----
    The ratings without a match are one Newton step from those with it. With V the variance of the
    difference d, and w of n games won, which have the curvature k = n p (1 - p), it is

        d - V (w - n p) / (1 - V k),    with the variance V / (1 - V k).
    """
    check_results(results)
    if len(ratings.players) > MOST_PLAYERS or ratings.break_advantage is not None:
        return None
    in_time = results if ratings.as_of is None else results.select(until(results, ratings.as_of))
    played = in_time.played().results
    weight, _ = weights_of(played, in_time.won_only(), ratings.half_life, ratings.as_of)
    games = played.score_a + played.score_b
    counted = (games > 1) & (games <= LONGEST) & ~doubtful_scores(played)
    if counted.sum() < FEWEST:
        return None
    scored, weight = played.select(counted), weight[counted]
    a, b = scored.player_a, scored.player_b
    difference = ratings.scale.log_odds(ratings.rating[a] - ratings.rating[b])
    variance = ratings.difference_variances(a, b)
    won, lost = scored.score_a.astype(float), scored.score_b.astype(float)
    p = expit(difference)
    left = 1.0 - np.minimum(variance * weight * (won + lost) * p * (1.0 - p), 0.99)
    without = difference - variance * weight * (won - (won + lost) * p) / left
    varies = form_variance(without, np.sqrt(variance / left), won, lost, _clusters(scored))
    return DayForm(varies, len(scored))


def _clusters(results: Results) -> NDArray[np.int64]:
    """Return a number for the matches of each date, and for each match if there are few dates."""
    if results.date is None or np.isnat(results.date).any():
        return np.arange(len(results))
    days, cluster = np.unique(results.date, return_inverse=True)
    return cluster if len(days) >= FEWEST_DAYS else np.arange(len(results))
