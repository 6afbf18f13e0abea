"""Day-to-day form: how much the chance of winning a game varies around the ratings between matches.

In match i the log-odds of every game are c + e, where e is normal and the same in all games of the
match. The variance of e is v more than that of the rating difference, and c is set so that the
chance of winning a game is the one that the ratings give (see `evenbreak.matches.form`). v is
estimated by maximum likelihood, with e and the uncertainty of the ratings integrated out; its
standard error is a sandwich estimate. If v is established, ratings are fitted with it (see
`evenbreak.ratings.form_weights`), and v is estimated once more from the new ratings.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.special import expit, log_expit, logsumexp

from evenbreak.arrays import Floats
from evenbreak.matches.form import center_of_form
from evenbreak.ratings.decay import until
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.doubtful_scores import doubtful_scores
from evenbreak.ratings.estimates import Estimate, with_error
from evenbreak.ratings.fit import fit, weights_of
from evenbreak.ratings.fitted import DayForm, Ratings
from evenbreak.ratings.form_weights import games_weight
from evenbreak.ratings.integrated import normal_nodes
from evenbreak.ratings.results import Results

NODES = 15
"""Nodes of the Gauss-Hermite rule."""

LARGEST = 4.0
"""The largest variance considered."""

LONGEST = 50
"""Matches with more games are left out."""

FEWEST_DAYS = 20
"""Dates needed before matches on the same date are allowed to depend on each other."""

FEWEST = 100
"""Matches needed to estimate the variance."""

MOST = 20_000
"""Most matches used; from more, a random sample, which is enough to find v to within 0.01."""

SEED = 1
"""Seed of the sample, so that the same results always give the same answer."""

_STEP = 1e-3


def form_variance(
    difference: Floats, sd: Floats, won: Floats, lost: Floats, cluster: NDArray[np.int64]
) -> Estimate:
    """Return the form variance that makes the scores of some matches most likely.

    `difference` and `sd` are the log-odds of a game and their standard error, from ratings that
    don't use the match; matches of one cluster may depend on each other.
    """
    points, weights = normal_nodes(NODES)

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
    """Return the mean log-odds of a game with form for which its chance stays the same."""
    return center_of_form(difference, sd, math.sqrt(v))


def day_form(results: Results, ratings: Ratings) -> DayForm | None:
    """Return the day-to-day form in the results that a league's ratings were fitted to.

    Each match is compared with the ratings from all other matches. Scores that can hardly be games
    are left out, from the ratings too: counted as games, they would make their players' ratings
    both wrong and overconfident.

    Parameters
    ----------
    results, ratings
        the results, and the ratings that `fit` returned for them.

    Returns
    -------
    DayForm or None
        None if fewer than 100 matches of two games or more have known scores, or if the break
        matters.

    Notes
    -----
    The ratings without a match are one Newton step from those with it. If V is the variance of the
    difference d, and w of n games were won, which have the weight g and so the curvature
    k = g n p (1 - p), the difference without the match is

        d - V g (w - n p) / (1 - V k),    with the variance V / (1 - V k).
    """
    check_results(results)
    if ratings.break_advantage is not None:
        return None
    doubtful = doubtful_scores(results)
    if doubtful.any():
        results = results.select(~doubtful)
        ratings = _alike(ratings, results, ratings.match_form)
    in_time = results if ratings.as_of is None else results.select(until(results, ratings.as_of))
    played = in_time.played().results
    weight, _ = weights_of(played, in_time.won_only(), ratings.half_life, ratings.as_of)
    games = played.score_a + played.score_b
    counted = np.flatnonzero((games > 1) & (games <= LONGEST))
    if len(counted) < FEWEST:
        return None
    if len(counted) > MOST:
        drawn = np.random.default_rng(SEED).choice(len(counted), MOST, replace=False)
        counted = counted[np.sort(drawn)]
    scored, weight, games = played.select(counted), weight[counted], games[counted]
    a, b = scored.player_a, scored.player_b
    difference = ratings.scale.log_odds(ratings.rating[a] - ratings.rating[b])
    weight = weight * games_weight(difference, games, ratings.match_form)
    variance = ratings.difference_variances(a, b)
    p = expit(difference)
    left = 1.0 - np.minimum(variance * weight * games * p * (1.0 - p), 0.99)
    without = difference - variance * weight * (scored.score_a - games * p) / left
    won, lost = scored.score_a.astype(float), scored.score_b.astype(float)
    varies = form_variance(without, np.sqrt(variance / left), won, lost, _clusters(scored))
    return DayForm(varies, len(scored))


def with_form(results: Results, ratings: Ratings) -> Ratings:
    """Return ratings that allow for day-to-day form, if form is established.

    >>> season = Results.from_names(["Ann"], ["Bo"], [7], [5])
    >>> with_form(season, fit(season)).form is None
    True
    """
    form = day_form(results, ratings)
    if form is None or not form.established:
        return replace(ratings, form=form)
    # Ratings without form are surer than they ought to be, so the first v is slightly high.
    form = day_form(results, _alike(ratings, results, form.used, ratings))
    if form is None or not form.established:
        return replace(ratings, form=form)
    return replace(_alike(ratings, results, form.used, ratings), form=form)


def _alike(ratings: Ratings, results: Results, form: float, near: Ratings | None = None) -> Ratings:
    return fit(
        results,
        prior_sd=ratings.prior_sd,
        scale=ratings.scale,
        anchor=dict(ratings.named) or ratings.anchor,
        half_life=ratings.half_life,
        as_of=ratings.as_of,
        levels=ratings.levels,
        provisional=ratings.least_games,
        form=form,
        near=near,
    )


def _clusters(results: Results) -> NDArray[np.int64]:
    """Return a cluster number for each match: one per date, or one per match if dates are few."""
    if results.date is None or np.isnat(results.date).any():
        return np.arange(len(results))
    days, cluster = np.unique(results.date, return_inverse=True)
    return cluster if len(days) >= FEWEST_DAYS else np.arange(len(results))
