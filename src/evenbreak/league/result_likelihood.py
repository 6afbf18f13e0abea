"""The chance of a match result, by how far the player's skill is above the opponent's rating.

Opponents' skills differ from their ratings by independent errors with a known distribution, and
every player's form varies from match to match by a normal deviation of known size.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.handicaps.ladders.form import difference_law
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.stats.summary import Distribution

_UNITS = SCALES["npl"]


def units(points: float, scale: Scale) -> int:
    """Return points of a scale in the whole points in which skills are counted here.

    They are the National Pool League's, 30 of which double the odds of a game.

    >>> from evenbreak.ratings.scale import SCALES
    >>> units(72.0, SCALES["npl"]), units(610.0, SCALES["fargo"])
    (72, 183)
    """
    # Halves upwards, as `evenbreak matchups` rounds.
    return math.floor(points * _UNITS.points_per_doubling / scale.points_per_doubling + 0.5)


class Result(NamedTuple):
    """A match as the watched player sees it.

    Parameters
    ----------
    opponent
        the opponent's rating, in whole points of which 30 double the odds.
    games
        games won and lost; None where only the winner is known.
    race
        games that the player and the opponent needed; None where that is not known.
    won
        whether the player won the match.
    marked
        whether the match is one of those that may have been dumped.
    """

    opponent: int
    games: tuple[int, int] | None
    race: tuple[int, int] | None
    won: bool
    marked: bool = True


class Likelihood:
    """The chance of a result, by how far the player's skill is above the opponent's rating.

    Parameters
    ----------
    scale
        what a difference of skill means for a game.
    error
        the distribution of a player's rating less skill, in points of the scale.
    day_sd
        standard deviation of every player's form, in points of the scale, drawn for each match.

    >>> from evenbreak.ratings.scale import SCALES
    >>> even = Likelihood(SCALES["npl"], Distribution((0,), (1.0,)))
    >>> honest, feigned = even.of((5, 3), (5, 4), won=True, first=0, last=0)
    >>> float(honest[0]) == 0.5**8, float(feigned[0])
    (True, 0.0)
    """

    def __init__(self, scale: Scale, error: Distribution, day_sd: float = 0.0) -> None:
        self.scale = scale
        self.error, lowest = _law_in_units(error, scale)
        size = _UNITS.points_per_doubling / scale.points_per_doubling
        form = difference_law(day_sd * size)
        self.lowest, self.least = lowest, lowest - len(form) // 2
        self.weights = np.convolve(self.error, form)

    def of(
        self,
        games: tuple[int, int] | None,
        race: tuple[int, int] | None,
        *,
        won: bool,
        first: int,
        last: int,
    ) -> tuple[Floats, Floats]:
        """Return the chance of a result if it is honest, and if it is a feigned honest defeat.

        The number of ways in which a score can come about is left out, since it does not depend
        on the skills.

        Parameters
        ----------
        games, race, won
            as of `Result`.
        first, last
            the differences, skill less the opponent's rating, in points.

        Returns
        -------
        two arrays of shape (last - first + 1,)
        """
        points = np.arange(first + self.least, last + self.least + self.weights.size)
        p, q = _UNITS.win_probability(points), _UNITS.win_probability(-points)
        beaten = np.ones_like(p) if race is None else race_win_probability(q, *race[::-1])
        chance = self._chance(p, q, games, race, won=won)
        # A defeat of unknown likelihood weighs no more than honest play, and one too unlikely for
        # a float weighs nothing, so e is never too large.
        feigned = np.zeros_like(p)
        if not won:
            np.divide(chance, beaten, out=feigned, where=beaten > 0.0)
        return self._mixed(chance), self._mixed(feigned)

    def _chance(
        self,
        p: Floats,
        q: Floats,
        games: tuple[int, int] | None,
        race: tuple[int, int] | None,
        *,
        won: bool,
    ) -> Floats:
        if games is not None:
            return np.asarray(p ** games[0] * q ** games[1])
        if race is None:
            return np.ones_like(p)
        return np.asarray(
            race_win_probability(p, *race) if won else race_win_probability(q, *race[::-1])
        )

    def _mixed(self, chance: Floats) -> Floats:
        """Return the mean over the opponent's error, for each difference."""
        return np.correlate(chance, self.weights, "valid")


def _law_in_units(error: Distribution, scale: Scale) -> tuple[Floats, int]:
    """Return a distribution in the points of `units`, and the lowest of them."""
    values = np.array([units(float(value), scale) for value in error.values])
    chances = np.array([float(chance) for chance in error.probability])
    lowest = int(values.min())
    return np.asarray(np.bincount(values - lowest, weights=chances), dtype=float), lowest
