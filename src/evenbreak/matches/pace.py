"""How fast matches are played: minutes per match and per game, their spread, the time in between.

A match of k games takes

    (overhead + per_game k) N A minutes,

where N, the match's random variation, and A, the pace of the evening, are lognormal with mean 1. N
is new in each match; all matches of an evening share A.

Source: 74,755 timed matches from one city's tournaments, 2017 to 2025. The paces were fitted to
those before 2023 and tested on the rest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import FloatOrArray, Floats
from evenbreak.checks import number, plain, positive
from evenbreak.errors import InputError


@dataclass(frozen=True)
class Pace:
    """How long matches take, and how much this varies.

    Parameters
    ----------
    overhead
        minutes per match in addition to its games: warm-up, the lag, the first rack.
    per_game
        mean minutes per game.
    match_sd
        how much matches with the same number of games vary: the standard deviation of the
        logarithm of their minutes.
    evening_sd
        how much whole evenings vary: the standard deviation of the logarithm of an evening's pace.
    discipline
        the game, if this is its usual pace.

    Raises
    ------
    InputError
        if `per_game` is not above 0, or another number is below 0.

    >>> PACES["9-ball"].mean_minutes(9).__round__(2)
    54.02
    """

    overhead: float
    per_game: float
    match_sd: float
    evening_sd: float
    discipline: str | None = None

    def __post_init__(self) -> None:
        positive(self.per_game, "per_game")
        for name in ("overhead", "match_sd", "evening_sd"):
            number(getattr(self, name), name, low=0.0)

    def mean_minutes(self, games: FloatOrArray) -> FloatOrArray:
        """Return the mean times of matches with these numbers of games; 0 for no games."""
        games = np.asarray(games)
        return plain(np.where(games > 0, self.overhead + self.per_game * games, 0.0))

    @property
    def log_sd(self) -> float:
        """How much a match varies if the pace of the evening is not known."""
        return math.hypot(self.match_sd, self.evening_sd)

    def draw(self, games: ArrayLike, rng: np.random.Generator) -> Floats:
        """Return random times of matches with these numbers of games, on a usual evening."""
        minutes: Floats = self.mean_minutes(games) * mean_one(rng, np.shape(games), self.match_sd)
        return minutes


PACES: dict[str, Pace] = {
    "8-ball": Pace(3.8, 9.82, 0.305, 0.128, "8-ball"),
    "9-ball": Pace(3.8, 5.58, 0.275, 0.094, "9-ball"),
    "10-ball": Pace(0.8, 7.07, 0.288, 0.095, "10-ball"),
}
"""The usual pace of each discipline."""

_ANY_MATCH_SD, _ANY_EVENING_SD = 0.29, 0.11  # the means of the three


def pace_of(discipline: str) -> Pace:
    """Return the usual pace of a discipline.

    Raises
    ------
    InputError
        if there is no discipline with this name.
    """
    if discipline not in PACES:
        raise InputError(
            "{discipline} must be one of {paces}; you gave {value!r}",
            value=discipline,
            paces=", ".join(PACES),
        )
    return PACES[discipline]


def own_pace(minutes_per_game: float) -> Pace:
    """Return the pace of matches with these mean minutes per game, everything included.

    They vary as much as the average of the three disciplines.

    >>> own_pace(8).mean_minutes([5, 9]).tolist()
    [40.0, 72.0]
    """
    return Pace(0.0, minutes_per_game, _ANY_MATCH_SD, _ANY_EVENING_SD)


@dataclass(frozen=True)
class Turnover:
    """The time between two matches on a table, lognormal.

    Parameters
    ----------
    mean
        minutes on average.
    log_sd
        the standard deviation of the logarithm.

    Notes
    -----
    The usual turnover has the median 7.5 and the mean 10.8 of the timed matches.
    """

    mean: float = 10.8
    log_sd: float = math.sqrt(2.0 * math.log(10.8 / 7.5))

    def __post_init__(self) -> None:
        number(self.mean, "mean", low=0.0)
        number(self.log_sd, "log_sd", low=0.0)

    def draw(self, shape: int | tuple[int, ...], rng: np.random.Generator) -> Floats:
        """Return random turnovers."""
        return self.mean * mean_one(rng, shape, self.log_sd)


def mean_one(rng: np.random.Generator, shape: int | tuple[int, ...], log_sd: float) -> Floats:
    """Return random factors, lognormal with mean 1."""
    factors: Floats = np.exp(log_sd * rng.standard_normal(shape) - log_sd**2 / 2.0)
    return factors
