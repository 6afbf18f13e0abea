"""Elo's update, game by game: each game counts, and the better player is expected to win more.

If player 1 wins a of the g games of a match, at ratings that give player 1 the chance e to win a
game, player 1's rating moves by k (a - e g) points, rounded to whole points, and player 2's rating
moves by as much the other way. So the winner of a match may lose points: a player who needs seven
games to the opponent's two and wins 7:1 played no better than the rating. The ratings before the
match hold for all of its games.

Source: Elo, The Rating of Chessplayers, Past and Present (1978): the linear update.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.design import fixed_length_chart
from evenbreak.handicaps.systems.by_match import PlayedMatch, StepSystem, points_of
from evenbreak.ratings.scale import SCALES

_SCALE = SCALES["elo"]

_GAMES = 9
"""The longest match in the system's own chart."""


@dataclass(frozen=True)
class _PerGame:
    k: int

    def __call__(self, match: PlayedMatch) -> tuple[int, int]:
        if match.games is None:
            raise InputError("the score is None, but an update by games needs it")
        won, lost = match.games
        expected = _SCALE.win_probability(match.rating[0] - match.rating[1])
        # Rounded once, so that the sum of the two ratings stays the same.
        points = round(self.k * (won - expected * (won + lost)))
        return points, -points


def elo_system(k: Any = 16) -> StepSystem:
    """Return the system in which each game in a match moves the ratings by Elo's update.

    No league's chart is on Elo's scale, so the system's own chart has the most even races with at
    most nine games. Newcomers move like everyone else.

    Parameters
    ----------
    k
        points for a game won against all expectations, a whole number from 1 to 1,000.

    Raises
    ------
    InputError
        if k is not such a number; the rule itself raises it if the score is missing.

    >>> rule = elo_system(16).rule
    >>> rule(PlayedMatch((1600, 1500), (5, 4), None)), rule(PlayedMatch((1600, 1500), (7, 1), None))
    ((-12, 12), (30, -30))
    """
    points = points_of(k, "k")
    return StepSystem(
        f"elo {points}",
        _SCALE,
        (),
        _PerGame(points),
        f"{points} point{'s' * (points > 1)} for each game won above expectation on Elo's scale",
        own_chart=fixed_length_chart(_GAMES, _SCALE),
        asks=("games",),
        winner_never_falls=False,
    )
