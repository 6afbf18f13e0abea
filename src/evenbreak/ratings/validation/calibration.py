"""How good predictions were: losses with bootstrap intervals, calibration and its slope.

A prediction is p, a player's chance of winning a game (or a match), for `games` games of which they
won `won`. In a race the number of games depends on their outcomes, but w - p n still has mean zero
and w log p + (n - w) log(1 - p) is still the log-likelihood, because the end of a race depends only
on the past. With day-to-day form, its mean is not zero, as favorites' bad days last longer, but it
is nearly zero if matches have the same weights as in the ratings (see
`evenbreak.ratings.form_weights`). So the chances are judged with those weights.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import xlog1py, xlogy

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.estimates import Estimate, bootstrap_ratio, logistic_coefficient, wilson
from evenbreak.ratings.form_weights import games_weight
from evenbreak.ratings.validation.walk_forward import Forecasts

TOSS_UP = 1e-9
"""A match with a chance this close to 1/2 has no favorite: it may be a rounded 1/2."""


class CalibrationBin(NamedTuple):
    """Predictions with similar chances for the favorite, and how often the favorite won.

    The upper end belongs to the last bin only; where matches are predicted, games are matches.
    `predicted` is the mean chance over games; `low` to `high` is Wilson's 95% interval, for the
    equivalent number of independent games.
    """

    p_from: float
    p_to: float
    matches: int
    games: int
    predicted: float
    seen: float
    low: float
    high: float


def log_loss(p: Floats, won: Floats, games: Floats) -> Floats:
    """Return the log-loss of each match, in nats, summed over its games.

    >>> log_loss(np.array([0.5]), np.array([2.0]), np.array([3.0])).round(3)
    array([2.079])
    """
    return np.asarray(-xlogy(won, p) - xlog1py(games - won, -p))


def brier(p: Floats, won: Floats, games: Floats) -> Floats:
    """Return the squared error of each match, summed over its games.

    >>> brier(np.array([0.5]), np.array([2.0]), np.array([3.0]))
    array([0.75])
    """
    return won * (1.0 - p) ** 2 + (games - won) * p**2


def calibration(
    p: Floats,
    won: Floats,
    games: Floats,
    *,
    bins: int = 10,
    worth: float = 1.0,
    weight: ArrayLike = 1.0,
) -> list[CalibrationBin]:
    """Return how often favorites won, by their predicted chance from 0.5 to 1, in equal bins.

    Matches without a favorite, p = 0.5, are left out. `worth` is how many independent games a game
    is worth: below 1 where the games of a match vary together. `weight` is each match's in both
    shares.

    >>> rows = calibration(np.array([0.62, 0.39]), np.array([7.0, 3.0]), np.array([12.0, 10.0]))
    >>> [(r.p_from, r.games, round(r.predicted, 3), round(r.seen, 3)) for r in rows]
    [(0.6, 22, 0.615, 0.636)]
    """
    a_leads = p > 0.5
    chance = np.where(a_leads, p, 1.0 - p)
    wins = np.where(a_leads, won, games - won)
    weight = np.asarray(weight)
    edges = np.linspace(0.5, 1.0, bins + 1)
    place = np.minimum(np.searchsorted(edges, chance, side="right") - 1, bins - 1)
    filled = []
    for k in range(bins):
        rows = (place == k) & (np.abs(p - 0.5) > TOSS_UP) & (games > 0)
        n = float(games[rows].sum())
        if n == 0.0:
            continue
        weighed = (weight * games)[rows]
        share = (weight * wins)[rows].sum() / weighed.sum()
        seen, predicted = float(share), float(chance[rows] @ weighed / weighed.sum())
        low, high = wilson(seen, n * worth)
        first, last = round(float(edges[k]), 6), round(float(edges[k + 1]), 6)
        matches = int(rows.sum())
        filled.append(CalibrationBin(first, last, matches, round(n), predicted, seen, low, high))
    return filled


def no_favorites(p: Floats, games: Floats) -> int:
    """Return how many matches with games `calibration` leaves out because p is 1/2.

    >>> no_favorites(np.array([0.5, 0.7]), np.array([9.0, 9.0]))
    1
    """
    return int(((np.abs(p - 0.5) <= TOSS_UP) & (games > 0)).sum())


Of = Literal["game", "match"]
How = Literal["plug-in", "integrated"]

FEWEST_MATCHES = 30
"""Matches with a favorite needed to give a slope."""

WIDEST_SLOPE = 4.0
"""Widest interval with which a slope still says something."""

SUREST = 1e-12
"""Chances are limited to at least this distance from 0 and 1."""


class Scored(NamedTuple):
    """Accuracy of one kind of prediction, for a 'game' or a 'match'.

    `how` is 'plug-in', from the ratings at face value, or 'integrated', averaged over their
    uncertainty. Log-loss, in nats, and Brier score are means; a toss-up has ln 2 and 1/4. The
    calibration slope is 1 if right, below 1 if predictions are too extreme; None if fewer than 30
    matches have a favorite, or if its interval is wider than 4.
    """

    of: Of
    how: How
    prior_sd: float
    log_loss: Estimate
    brier: Estimate
    slope: Estimate | None


@dataclass(frozen=True, eq=False)
class Predictions:
    """One kind of prediction for all matches, from a walk through the season.

    By match: player a's chance, what a won, and the number of games (or races; 0 if there is no
    race); `weight` is used to judge the chances.
    """

    of: Of
    how: How
    walk: Forecasts
    p: Floats
    won: Floats
    trials: Floats
    weight: Floats

    @classmethod
    def of_walk(cls, walk: Forecasts, of: Of, how: How) -> Predictions:
        """Return one kind of prediction from a walk through the season."""
        plain = how == "plug-in"
        if of == "game":
            p = walk.p_game if plain else walk.p_game_integrated
            won, trials = walk.results.score_a.astype(float), walk.games.astype(float)
            weight = games_weight(walk.difference, trials, walk.form)
        else:
            raced = walk.race_a > 0
            p = np.where(raced, walk.p_match if plain else walk.p_match_integrated, 0.5)
            won, trials = np.where(raced, walk.won, 0.0), raced.astype(float)
            weight = np.ones(len(walk))
        # Nothing is certain: the loss of a chance that rounds to 1 would be infinite.
        return cls(of, how, walk, np.clip(p, SUREST, 1.0 - SUREST), won, trials, weight)

    @property
    def losses(self) -> Floats:
        """The log-loss of each match."""
        return log_loss(self.p, self.won, self.trials)

    @property
    def toss_ups(self) -> int:
        """How many matches have no favorite."""
        return no_favorites(self.p, self.trials)

    def scored(self, cluster: Ints, rng: np.random.Generator) -> Scored:
        """Return the accuracy of the predictions; `rng` resamples matches by their `cluster`."""
        x = np.log(self.p) - np.log1p(-self.p)
        by_weight = self.weight * self.won, self.weight * self.trials
        slope = logistic_coefficient(x, *by_weight, cluster)
        favorites = int((self.trials > 0).sum()) - self.toss_ups
        if favorites < FEWEST_MATCHES or (slope and slope.high - slope.low > WIDEST_SLOPE):
            slope = None
        squares = brier(self.p, self.won, self.trials)
        return Scored(
            self.of,
            self.how,
            self.walk.prior_sd,
            bootstrap_ratio(self.losses, self.trials, cluster, rng),
            bootstrap_ratio(squares, self.trials, cluster, rng),
            slope,
        )
