"""How good one kind of prediction of a season was."""

from __future__ import annotations

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
from evenbreak.ratings.walk_forward import Forecasts

Of = Literal["game", "match"]
How = Literal["plug-in", "integrated"]

FEWEST_MATCHES = 30
"""Matches with a favourite from which a slope is given."""

WIDEST_SLOPE = 4.0
"""A slope with a wider interval says nothing."""

SUREST = 1e-12
"""No chance is taken to be closer to 0 or 1."""


class Scored(NamedTuple):
    """How good one kind of prediction was.

    Parameters
    ----------
    of
        'game' or 'match': what is predicted.
    how
        'plug-in': from the ratings at face value; 'integrated': averaged over their
        uncertainty.
    prior_sd
        the prior that the ratings had.
    log_loss, brier
        the mean over games (or matches), in nats; a toss-up has ln 2 and 1/4.
    slope
        the calibration slope: 1 is right, below 1 the predictions are too extreme. None
        with fewer than 30 matches with a favourite, or where its interval is wider than 4.
    """

    of: Of
    how: How
    prior_sd: float
    log_loss: Estimate
    brier: Estimate
    slope: Estimate | None


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

    def scored(self, cluster: Ints, rng: np.random.Generator) -> Scored:
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
        )
