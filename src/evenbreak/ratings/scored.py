"""How good the predictions of a season were, with the prior that suits each kind best."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings.calibration import (
    Estimate,
    bootstrap_ratio,
    brier,
    log_loss,
    logistic_coefficient,
    no_favourites,
)
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.prior import WIDTHS
from evenbreak.ratings.results import Results
from evenbreak.ratings.walk_forward import Forecasts, walk_forward

Of = Literal["game", "match"]
How = Literal["plug-in", "integrated"]

PRIORS = WIDTHS[:9]
"""The prior standard deviations that are tried, in log-odds: 0.09 to 1.39, `PRIOR_SD` too."""

FEWEST_MATCHES = 30
"""Matches with a favourite from which a slope is given."""

WIDEST_SLOPE = 4.0
"""A slope with a wider interval says nothing."""

SUREST = 1e-12
"""No chance is taken to be closer to 0 or 1."""


class Scored(NamedTuple):
    """How good one kind of prediction was, with the prior that suits it best.

    Parameters
    ----------
    of
        'game' or 'match': what is predicted.
    how
        'plug-in': from the ratings at face value; 'integrated': averaged over their
        uncertainty.
    prior_sd
        the prior with the least log-loss, or the one that was given.
    log_loss, brier
        the mean over games (or matches), in nats; a toss-up has ln 2 and 1/4.
    slope
        the calibration slope: 1 is right, below 1 the predictions are too extreme. None
        with fewer than 30 matches with a favourite, or where its interval is wider than 4.
    as_it_went
        the log-loss where each date is predicted with the prior that did best before it;
        None where the prior was given.
    """

    of: Of
    how: How
    prior_sd: float
    log_loss: Estimate
    brier: Estimate
    slope: Estimate | None
    as_it_went: float | None


@dataclass(frozen=True, eq=False)
class Predictions:
    """One kind of prediction of all matches, by a walk through the season.

    Attributes
    ----------
    of, how
        what is predicted, and how, as in `Scored`.
    walk
        the forecasts that they are taken from.
    p, won, trials
        the chance of player a, what a won, and how many games (or races) there were, by
        match; no trials where there is no race.
    """

    of: Of
    how: How
    walk: Forecasts
    p: Floats
    won: Floats
    trials: Floats

    @classmethod
    def of_walk(cls, walk: Forecasts, of: Of, how: How) -> Predictions:
        """Return the predictions of one kind in a walk through a season."""
        plain = how == "plug-in"
        if of == "game":
            p = walk.p_game if plain else walk.p_game_integrated
            won, trials = walk.results.score_a.astype(float), walk.games.astype(float)
        else:
            raced = walk.race_a > 0
            p = np.where(raced, walk.p_match if plain else walk.p_match_integrated, 0.5)
            won, trials = np.where(raced, walk.won, 0.0), raced.astype(float)
        # Nothing is certain: the loss of a chance that rounds to 1 would be infinite.
        return cls(of, how, walk, np.clip(p, SUREST, 1.0 - SUREST), won, trials)

    @property
    def losses(self) -> Floats:
        """The log-loss of each match."""
        return log_loss(self.p, self.won, self.trials)

    @property
    def mean_loss(self) -> float:
        """The log-loss a game (or match)."""
        return float(self.losses.sum() / self.trials.sum())

    @property
    def toss_ups(self) -> int:
        """How many matches have no favourite."""
        return no_favourites(self.p, self.trials)

    def scored(
        self,
        cluster: Ints,
        rng: np.random.Generator,
        as_it_went: float | None = None,
    ) -> Scored:
        """Return how good they were; `rng` resamples matches by their `cluster`."""
        x = np.log(self.p) - np.log1p(-self.p)
        slope = logistic_coefficient(x, self.won, self.trials, cluster)
        favourites = int((self.trials > 0).sum()) - self.toss_ups
        if favourites < FEWEST_MATCHES or (slope and slope.high - slope.low > WIDEST_SLOPE):
            slope = None
        squares = brier(self.p, self.won, self.trials)
        return Scored(
            self.of,
            self.how,
            self.walk.prior_sd,
            bootstrap_ratio(self.losses, self.trials, cluster, rng),
            bootstrap_ratio(squares, self.trials, cluster, rng),
            slope,
            as_it_went,
        )


def best_predictions(
    walks: Sequence[Forecasts], of: Of, how: How, results: Results, half_life: float | None
) -> Predictions:
    """Return the predictions with the prior that suits them best, among `walks` or between them.

    Parameters
    ----------
    walks
        one for each of `PRIORS`, or a single one.
    of, how
        the kind of prediction.
    results, half_life
        what the walks were made of.
    """
    tried = [Predictions.of_walk(walk, of, how) for walk in walks]
    losses = [one.mean_loss for one in tried]
    least = int(np.argmin(losses))
    if 0 < least < len(walks) - 1:
        between = walk_forward(results, prior_sd=_vertex(losses, least), half_life=half_life)
        refined = Predictions.of_walk(between, of, how)
        if refined.mean_loss <= losses[least]:
            return refined
    return tried[least]


def _vertex(losses: list[float], least: int) -> float:
    """Return where the parabola through the least loss and its neighbours is lowest."""
    x = np.log(PRIORS)
    before, at, after = losses[least - 1 : least + 2]
    shift = 0.5 * (before - after) / (before - 2.0 * at + after)
    return float(np.exp(x[least] + shift * (x[1] - x[0])))


def loss_as_it_went(walks: Sequence[Forecasts], of: Of, how: How) -> float | None:
    """Return the log-loss where each date has the prior that did best on earlier dates.

    None where there is only one prior.
    """
    if len(walks) == 1:
        return None
    tried = [Predictions.of_walk(walk, of, how) for walk in walks]
    date_of = walks[0].date_of
    many = int(date_of[-1]) + 1
    by_date = np.array([np.bincount(date_of, one.losses, many) for one in tried])
    before = np.cumsum(by_date, axis=1) - by_date
    # Before the first date all are equal up to rounding: then the default is used.
    equal = np.ptp(before, axis=0) < 1e-9
    chosen = np.where(equal, PRIORS.index(PRIOR_SD), before.argmin(0))
    return float(by_date[chosen, np.arange(many)].sum() / tried[0].trials.sum())
