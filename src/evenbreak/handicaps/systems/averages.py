"""Averages: points per game, as in BCA and VNEA leagues, and the percentage of games won.

**Points per game.** The winner of a game scores 10, the loser scores a point for each of their own
balls made, 0 to 7. A player's number is total points divided by total games, and the head start in
points is the difference between two averages, times a correction and the number of games. Results
state games, not balls, so the loser is assumed to make `balls` of them on average. Over N games the
head start h is then worth h / (10 - balls) games: the better player needs m = floor(N / 2 + h / (2
(10 - balls))) + 1 of them, the other one N + 1 - m, which is the race here.

**Percentage of games won.** A player's number is the percentage won of the last 50 games; the
difference between two players, times five for the five players on a team, is looked up in a chart
for 25 games.

Source: the rules of BCAPL, VNEA and PPL leagues, as printed (10 and 0-7 points, newcomers 7);
Tucson's correction 1.8; PASCO's chart and the chart of a 3-player league, as printed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.systems.history import Entries, History, Matches, column_of
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.scale import SCALES

WIN = 10.0
"""Points for winning a game."""

USUAL_GAMES = 50
"""Games assumed behind a number on the list if none are stated."""


@dataclass(frozen=True)
class Averages(System):
    """Points per game, with a head start from the difference between two averages.

    Parameters
    ----------
    games
        the number of games in a match, an odd number.
    correction
        the factor applied to the difference between the averages: 1 in most leagues' printed rules,
        1.8 in Tucson. If points are additive in skill, 2 is fair.
    balls
        the mean number of balls that the loser makes in a game (an assumption: results do not state
        it).
    newcomer
        the average of a player without one.

    >>> Averages(correction=1.8).head_start(40.0, 35.0)
    9.0
    """

    games: int = 9
    correction: float = 1.0
    balls: float = 3.8
    newcomer: float = 7.0
    name: str = "averages"

    asks = ("games",)
    in_words = (
        "points per game (10 for a win, the loser's own balls for a loss); the difference "
        "between two averages is the head start in a game, played here as the equivalent race"
    )

    def __post_init__(self) -> None:
        if whole(self.games, "games", at_least=1) % 2 == 0:
            raise InputError("{games} must be an odd number; you gave {value}", value=self.games)
        number(self.correction, "correction", low=0.0, high=4.0)
        number(self.balls, "balls", low=0.0, high=7.0)
        number(self.newcomer, "newcomer", low=0.0, high=WIN)

    def strength(self, numbers: Any) -> Floats:
        """Return the strengths that correspond to averages, from the share of games won."""
        return _strength((np.asarray(numbers, dtype=float) - self.balls) / (WIN - self.balls))

    def head_start(self, average_1: Any, average_2: Any) -> Any:
        """Return the points that the second player (or team, from sums) gets per game (round)."""
        return self.correction * (average_1 - average_2)

    def initial(self, entries: Entries) -> Floats:
        """Return the stated averages, without ratings that can't be averages."""
        stated = (entries.rating >= 0.0) & (entries.rating <= WIN)
        return np.where(stated, entries.rating, self.newcomer)

    def race(self, a: Any, b: Any) -> tuple[Ints, Ints]:
        """Return the race equivalent to the head start over a match's games."""
        points = self.games * np.asarray(self.head_start(np.asarray(a), np.asarray(b)), dtype=float)
        more = np.floor(self.games / 2.0 + np.abs(points) / (2.0 * (WIN - self.balls)) + 1e-9)
        stronger = np.minimum(more.astype(np.int64) + 1, self.games)
        weaker = self.games + 1 - stronger
        ahead = points >= 0.0
        return np.where(ahead, stronger, weaker), np.where(ahead, weaker, stronger)

    def update(self, history: History) -> Floats:
        """Return total points divided by total games, including those behind the list's averages.

        An average without a number of games counts as 50 games; a newcomer has none.
        """
        points = history.counts("points", lambda m: WIN * m.score_a + self.balls * m.score_b)
        games = history.counts("games", Matches.games_played)
        before = _games_behind(history, WIN)
        played = games + before
        total = points + before * history.initial
        return np.where(played > 0, total / np.maximum(played, 1), history.initial)


@dataclass(frozen=True)
class WinPercent(System):
    """Percentage won of the last games, with PASCO's chart for 25 games.

    Parameters
    ----------
    window
        how many of the last games count.
    players
        the number of players on a team, by which the difference between two players is multiplied.
    """

    window: int = 50
    players: int = 5
    name: str = "win-percent"

    asks = ("games",)

    def __post_init__(self) -> None:
        whole(self.window, "window", at_least=1, at_most=1000)
        whole(self.players, "players", at_least=1, at_most=100)

    @property
    def in_words(self) -> str:  # type: ignore[override]
        """The rule in words."""
        return (
            f"the percentage of the last {self.window} games won; races from a 25-game team "
            f"chart, at {self.players} times the difference between two players"
        )

    def strength(self, numbers: Any) -> Floats:
        """Return the strengths by the share of games won."""
        return _strength(np.asarray(numbers, dtype=float) / 100.0)

    def initial(self, entries: Entries) -> Floats:
        """Return 50% for every player whose rating isn't a percentage."""
        stated = (entries.rating >= 0.0) & (entries.rating <= 100.0)
        return np.where(stated, entries.rating, 50.0)

    def race(self, a: Any, b: Any) -> tuple[Ints, Ints]:
        """Return the race from PASCO's chart."""
        return pasco_race(self.players * (np.asarray(a, dtype=float) - np.asarray(b, dtype=float)))

    def update(self, history: History) -> Floats:
        """Return the percentage won of the last games; a match at the edge counts in part."""
        won = history.last(self.window, "won", lambda m: m.score_a)
        played = history.last(self.window, "games", Matches.games_played)
        played, won = np.nan_to_num(played), np.nan_to_num(won)
        left = np.maximum(self.window - (np.cumsum(played, axis=0) - played), 0.0)
        counted = np.minimum(played, left)
        share = np.divide(counted, played, out=np.zeros_like(played), where=played > 0)
        games = counted.sum(axis=0)
        past = np.minimum(self.window - games, _games_behind(history, 100.0))
        percent = 100.0 * (won * share).sum(axis=0) + past * history.initial
        return np.where(games + past > 0, percent / np.maximum(games + past, 1.0), history.initial)


def _strength(share: Floats) -> Floats:
    """Return the Fargo points above the mean opponent for a share of games won."""
    return np.asarray(SCALES["fargo"].difference(np.clip(share, 0.02, 0.98)), dtype=float)


def _games_behind(history: History, highest: float) -> Floats:
    """Return the games behind each number on the list: stated games, or else `USUAL_GAMES`."""
    shape = history.initial.shape
    rating, games = (
        column_of(values, shape) for values in (history.entries.rating, history.entries.games)
    )
    stated = np.where(games < 0, USUAL_GAMES, games)
    return np.where((rating >= 0.0) & (rating <= highest), stated, 0).astype(float)


def pasco_race(difference: Any) -> tuple[Ints, Ints]:
    """Return the games to win out of 25, from the difference between two teams' percentage sums.

    >>> pasco_race([0, 14, 15, 66.4, -145])
    (array([13, 13, 14, 15,  7]), array([13, 13, 12, 11, 19]))
    """
    points = np.floor(np.abs(np.asarray(difference, dtype=float)) + 0.5)
    more = np.searchsorted([15, 41, 67, 93, 119, 145], points, side="right")
    ahead = np.asarray(difference) >= 0
    return np.where(ahead, 13 + more, 13 - more), np.where(ahead, 13 - more, 13 + more)
