"""How long a match takes in minutes: a mixture of lognormals over its number of games."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtr, ndtri

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import kind_of, number
from evenbreak.matches.pace import Pace
from evenbreak.matches.quantiles import TIE

_LEAST = 1e-9  # stands for no time at all and for no spread, whose logarithms do not exist
_HALVINGS = 40


@own_arrays
@dataclass(frozen=True, eq=False)
class MatchMinutes:
    """The distribution of a match's minutes.

    Parameters
    ----------
    probability
        P(the match takes the games that belong to `means`), shape `(*parameters, k)`.
    means
        the mean minutes of a match with these games, shape (k,).
    log_sd
        the standard deviation of the logarithm of the minutes around them.
    """

    probability: Floats
    means: Floats
    log_sd: float

    def __repr__(self) -> str:
        law = f"mean {self.mean:.1f}" if np.ndim(self.mean) == 0 else f"{len(self.mean):,} matches"
        return f"<MatchMinutes: {law}>"

    @property
    def mean(self) -> Any:
        """The mean in minutes."""
        return _plain(self.probability @ self.means)

    @property
    def sd(self) -> Any:
        """The standard deviation in minutes."""
        square = self.probability @ (self.means**2 * math.exp(self.log_sd**2))
        return _plain(np.sqrt(np.maximum(square - self.mean**2, 0.0)))

    def cdf(self, minutes: ArrayLike) -> Any:
        """Return P(the match takes at most so many minutes)."""
        ended = ended_by(np.asarray(minutes, dtype=float)[..., np.newaxis], self.means, self.log_sd)
        return _plain((self.probability * ended).sum(axis=-1))

    def quantile(self, q: float) -> Any:
        """Return the minutes within which the match ends with probability q, 0 < q < 1."""
        q = number(q, "q", low=0.0, high=1.0)
        possible = self.means[self.probability.reshape(-1, self.means.size).any(axis=0)]
        # The quantile lies between those of the shortest and of the longest length.
        above = ndtri(q) * self.log_sd - self.log_sd**2 / 2.0
        least, most = (max(_LEAST, end(possible)) * math.exp(above) for end in (np.min, np.max))
        shape = self.probability.shape[:-1]

        def reached(minutes: Floats) -> Any:
            return self.cdf(minutes) >= q * (1.0 - TIE)

        return _plain(between(np.full(shape, least), np.full(shape, most), reached))


def match_minutes(games: ArrayLike, probability: ArrayLike, pace: Pace) -> MatchMinutes:
    """Return the distribution of a match's minutes on an evening whose pace is not known.

    Parameters
    ----------
    games
        its lengths in games, shape (k,).
    probability
        the chance of each, shape `(*parameters, k)`.
    pace
        how fast matches are played.

    >>> from evenbreak.matches import PACES, race_odds
    >>> race = race_odds(7, 5, 0.55)
    >>> minutes = match_minutes(race.games, race.probability, PACES["9-ball"])
    >>> round(minutes.mean, 1), round(minutes.quantile(0.9), 1)
    (54.8, 79.4)
    """
    kind_of(pace, "pace", Pace)
    chances = np.asarray(probability, dtype=float)
    return MatchMinutes(chances, np.atleast_1d(pace.mean_minutes(games)), pace.log_sd)


def ended_by(minutes: ArrayLike, mean: ArrayLike, log_sd: float) -> Floats:
    """Return P(a lognormal time with this mean is over by then)."""
    z = np.log(np.maximum(minutes, _LEAST / 2.0)) - np.log(np.maximum(mean, _LEAST))
    spread = max(log_sd, _LEAST)
    ended: Floats = ndtr((z + spread**2 / 2.0) / spread)
    return ended


def mean_up_to(minutes: ArrayLike, mean: ArrayLike, log_sd: float) -> Floats:
    """Return the mean of a lognormal time with this mean, cut off at these minutes."""
    tilted = np.asarray(mean) * ended_by(minutes, np.asarray(mean) * math.exp(log_sd**2), log_sd)
    cut: Floats = tilted + np.asarray(minutes) * (1.0 - ended_by(minutes, mean, log_sd))
    return cut


def _plain(found: Any) -> Any:
    return found if np.ndim(found) else float(found)


def between(low: Any, high: Any, reached: Callable[[Any], Any]) -> Any:
    """Return where a condition that holds from some point on begins to hold, by halving."""
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        holds = reached(middle)
        low, high = np.where(holds, low, middle), np.where(holds, middle, high)
    return high
