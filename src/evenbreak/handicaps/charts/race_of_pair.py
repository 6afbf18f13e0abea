"""The race that two players play: even, from a chart, or the fairest with a given length."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy.special import betainc

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.ratings.scale import Scale


@dataclass(frozen=True)
class Fairest:
    """Race in which the stronger player needs `race_to` games and the chances are closest to 1/2.

    The weaker player needs at most as many games, and at least one.
    """

    race_to: int

    def __post_init__(self) -> None:
        whole(self.race_to, "race_to", at_least=1)


Race: TypeAlias = int | Chart | Fairest
"""An even race to a number of games, a chart of races, or the fairest race with a given length."""


def games_needed(points: Floats, race: Race, scale: Scale) -> tuple[Ints, Ints]:
    """Return the games that each of two players needs, for every pair of players.

    The points are player 1's minus player 2's.

    >>> from evenbreak.ratings.scale import scale_of
    >>> games_needed(np.array([[0.0, 100.0]]), Fairest(7), scale_of("fargo"))
    (array([[7, 7]]), array([[7, 4]]))
    """
    if isinstance(race, Chart):
        return race.races(np.round(points))
    if isinstance(race, Fairest):
        return _fairest(points, race.race_to, scale)
    games = np.full(points.shape, whole(race, "race", at_least=1))
    return games, games


def _fairest(points: Floats, race_to: int, scale: Scale) -> tuple[Ints, Ints]:
    chance = scale.win_probability(np.abs(points))
    weaker = np.arange(1, race_to + 1)
    distance = np.abs(betainc(race_to, weaker, chance[..., None]) - 0.5)
    # Of races alike the longer: it plays more.
    best = race_to - distance[..., ::-1].argmin(axis=-1)
    ahead = points >= 0.0
    return np.where(ahead, race_to, best), np.where(ahead, best, race_to)
