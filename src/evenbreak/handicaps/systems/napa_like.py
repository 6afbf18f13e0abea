"""NAPA-like: a matrix of races by band of the stronger rating, and Elo on the match.

The race comes from the official calculator, by the band of the stronger rating and the difference.
The chance of a game is 1 / (1 + 2^(-d / 30)): three of its bands are charts of the National Pool
League, which has that scale. How ratings move is not published ("a proprietary adaptation of Elo",
a few points after each match). Assumed here: if W is the chance of winning the match by its race, a
winner gains 2 K (1 - W) points and a loser loses 2 K W, so K points change hands in an even match;
moves are doubled for a player's first 12 matches; and no rating falls below 0.

Source: the matrix as transcribed from the calculator; agrees with six published examples.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import number, whole
from evenbreak.handicaps.systems.history import Entries, History, positions
from evenbreak.handicaps.systems.system import System
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import SCALES

_FURTHER = 10**9

BANDS = (
    (0, ((19, 2, 2), (_FURTHER, 3, 2))),
    (40, ((10, 3, 3), (26, 3, 2), (_FURTHER, 4, 2))),
    (50, ((6, 4, 4), (18, 4, 3), (29, 5, 3), (39, 4, 2), (48, 5, 2), (_FURTHER, 6, 2))),
    (
        70,
        ((5, 5, 5), (14, 5, 4), (21, 6, 4), (28, 5, 3), (36, 6, 3), (46, 7, 3), (56, 6, 2),
         (62, 7, 2), (_FURTHER, 8, 2)),
    ),
    (
        90,
        ((4, 6, 6), (11, 6, 5), (17, 7, 5), (22, 6, 4), (28, 7, 4), (35, 8, 4), (42, 7, 3),
         (48, 8, 3), (58, 9, 3), (68, 8, 2), (74, 9, 2), (_FURTHER, 10, 2)),
    ),
)  # fmt: skip
"""The stronger rating at which a band starts, with its largest differences and races."""


@dataclass(frozen=True)
class NapaLike(System):
    """Elo on whole matches, with the published matrix of races.

    Parameters
    ----------
    k
        the points that an even match moves, reportedly from 1 to 4.
    provisional
        the factor on a player's moves in their first `matches` matches.
    newcomer
        the rating of a player without one.
    """

    k: float = 3.0
    provisional: float = 2.0
    matches: int = 12
    newcomer: float = 50.0
    name: str = "napa-like"

    scale = SCALES["npl"]
    in_words = (
        "races from the published matrix; how ratings move isn't published, so Elo for match "
        "wins is assumed"
    )
    asks = ("race",)
    winner_never_falls = True

    def __post_init__(self) -> None:
        number(self.k, "k", low=0.0, high=100.0)
        number(self.provisional, "provisional", low=0.0, high=10.0)
        whole(self.matches, "matches", at_least=0)
        number(self.newcomer, "newcomer", low=0.0, high=1e4)

    def initial(self, entries: Entries) -> Floats:
        """Return the stated ratings; a level becomes ten times the level plus 10."""
        by_level = np.where(np.isnan(entries.level), self.newcomer, 10.0 * entries.level + 10.0)
        return np.maximum(np.where(np.isnan(entries.rating), by_level, entries.rating), 0.0)

    def race(self, a: Any, b: Any) -> tuple[Ints, Ints]:
        """Return the matrix's races, for ratings rounded to whole points.

        >>> NapaLike().race([107, 47], [65, 30])
        (array([7, 3]), array([3, 2]))
        """
        a, b = (np.floor(np.asarray(x, dtype=float) + 0.5) for x in (a, b))
        band = np.searchsorted([start for start, _ in BANDS], np.maximum(a, b), side="right") - 1
        apart, band = np.abs(a - b), np.maximum(band, 0)
        stronger, weaker = np.zeros((2, *apart.shape), dtype=np.int64)
        for place, (_, rows) in enumerate(BANDS):
            row = np.searchsorted([most for most, _, _ in rows], apart)
            races = np.array([race for _, *race in rows])[row]
            stronger = np.where(band == place, races[..., 0], stronger)
            weaker = np.where(band == place, races[..., 1], weaker)
        ahead = a >= b
        return np.where(ahead, stronger, weaker), np.where(ahead, weaker, stronger)

    def update(self, history: History) -> Floats:
        """Return the ratings after the night's matches, based on the ratings before it."""
        night, ratings = history.tonight, np.array(history.ratings, dtype=float)
        few = history.matches_before < self.matches
        p = self.scale.win_probability(night.rating_a - night.rating_b)
        wins = race_win_probability(p, np.maximum(night.race_a, 1), np.maximum(night.race_b, 1))
        points = np.where(night.played, 2.0 * self.k * (night.won_a - wins), 0.0)
        for who, moved in ((night.a, points), (night.b, -points)):
            place = positions(who, ratings.shape)
            further = np.where(few.reshape(-1)[place], self.provisional, 1.0)
            sums = np.bincount(place.ravel(), (moved * further).ravel(), ratings.size)
            ratings += sums.reshape(ratings.shape)
        return np.asarray(np.maximum(ratings, 0.0), dtype=float)
