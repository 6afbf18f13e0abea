"""CSI's team handicap: the points that a weaker team starts a round with.

Every game is assumed to be between two players who have their teams' average ratings. If the
average player of team 1 wins a game with probability p, and the winner and the loser of a game
score w and l points on average, a team is expected to score p w + (1 - p) l points a game. The
difference over one game of each match-up, rounded down, times the games of a match-up, is the
handicap of a round.

Source: CSI's published example for 17-point scoring, three players a team and two games a
match-up: averages of 417 and 447 give 24.042 and 26.958 points over three match-ups, so the
points of a game add up to 17. The average of the winner is not published; 13.19 is the only number
with two decimals that reproduces the example, and 17 - 13.19 = 3.81 goes to the loser.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.ratings.scale import scale_of

POINTS_WON = 13.19
POINTS_LOST = 3.81
"""Mean points of a game's winner and loser, in 17-point scoring."""


@dataclass(frozen=True)
class TeamHandicap:
    """Handicap in a round between two teams; see `team_handicap`.

    Parameters
    ----------
    p_game_1
        P(the average player on team 1 wins a game against the average player on team 2).
    scored_1, scored_2
        the points that each team is expected to score over one game of each match-up.
    games
        the number of games in a match-up.
    points
        the points that the weaker team gets in a round, as CSI rounds them.
    """

    p_game_1: float
    scored_1: float
    scored_2: float
    games: int
    points: int

    @property
    def to_team(self) -> int | None:
        """The team that gets the points, 1 or 2; None if no one gets any."""
        if not self.points:
            return None
        return 1 if self.scored_1 < self.scored_2 else 2

    @property
    def even_points(self) -> float:
        """The points per round that would make both teams expect the same."""
        return self.games * abs(self.scored_1 - self.scored_2)

    @property
    def given_away(self) -> float:
        """The share of those points that the weaker team loses to rounding."""
        return 1.0 - self.points / self.even_points if self.even_points else 0.0


def team_handicap(
    average_1: float,
    average_2: float,
    *,
    match_ups: int = 3,
    games: int = 2,
    points_won: float = POINTS_WON,
    points_lost: float = POINTS_LOST,
    scale: Any = "fargo",
) -> TeamHandicap:
    """Return the points that the weaker of two teams gets in a round.

    Parameters
    ----------
    average_1, average_2
        the average ratings of the two teams.
    points_won, points_lost
        mean points of a game's winner and loser.
    scale
        the scale of the ratings: 'npl', 'fargo', 'elo', a `Scale` or the points that double the
        odds.

    Raises
    ------
    InputError
        if a parameter has an invalid value.

    >>> found = team_handicap(417, 447)
    >>> round(found.scored_1, 3), round(found.scored_2, 3), found.points, found.to_team
    (24.042, 26.958, 4, 1)
    >>> round(found.even_points, 2), round(found.given_away, 2)
    (5.83, 0.31)
    """
    won, lost = (
        number(points_won, "points_won", low=0.0),
        number(points_lost, "points_lost", low=0.0),
    )
    if not lost < won:
        raise InputError(
            "{points_lost} is {lost:g} and points_won is {won:g}. Give the loser fewer points.",
            lost=lost,
            won=won,
        )
    pairs, many = whole(match_ups, "match_ups", at_least=1), whole(games, "games", at_least=1)
    apart = number(average_1, "average_1") - number(average_2, "average_2")
    p, q = (scale_of(scale).win_probability(sign * apart) for sign in (1.0, -1.0))
    scored_1, scored_2 = (pairs * (chance * won + (1.0 - chance) * lost) for chance in (p, q))
    gap = pairs * (won - lost) * abs(p - q)
    return TeamHandicap(p, scored_1, scored_2, many, many * math.floor(gap + 1e-9))
