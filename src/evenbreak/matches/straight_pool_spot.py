"""The spot in straight pool: how many points the weaker player should need for an even match."""

from __future__ import annotations

import math
import sys
from fractions import Fraction
from typing import Any, NamedTuple

from evenbreak.checks import whole
from evenbreak.matches.straight_pool import LONGEST, StraightPool, straight_pool_odds
from evenbreak.stats.exact import exact

_EVEN = (0.4, 0.6)
"""A match in which a player wins with a chance from .4 to .6 is called even."""


class EvenPoints(NamedTuple):
    """The points of player 2 that make a match nearest to even.

    `p_win_1` is P(player 1 wins the match) with them.
    """

    points_2: int
    p_win_1: float

    @property
    def is_even(self) -> bool:
        """Whether each player wins with probability 0.4 or more.

        If not, no other number of points makes the match even either: the points are too few,
        or one player is far better.

        >>> even_points(100, 0.9, 0.85).is_even, even_points(1, 0.9, 0.8).is_even
        (True, False)
        """
        return _EVEN[0] <= self.p_win_1 <= _EVEN[1]


class Spot(NamedTuple):
    """How many points the weaker player should need, if the stronger still needs as many as now.

    Parameters
    ----------
    weaker
        the weaker player, 1 or 2.
    points
        how many points they should need; None if no number of points makes the match even.
    p_win_1
        P(player 1 wins the match) with these points; None if there are none.
    """

    weaker: int
    points: int | None
    p_win_1: float | None


def even_spot(match: StraightPool) -> Spot:
    """Return the points of the weaker player that bring a match nearest to even.

    The stronger player is the one who makes more balls an inning; player 1 if both make as many.

    Raises
    ------
    InputError
        as `straight_pool_odds` does.

    >>> spot = even_spot(StraightPool(100, 100, 0.9, 0.85))
    >>> spot.weaker, spot.points, round(spot.p_win_1, 3)
    (2, 60, 0.497)
    """
    points = match.points_1, match.points_2
    shots = (match.p1, match.safety_1), (match.p2, match.safety_2)
    strong = 0 if _balls_an_inning(*shots[0]) >= _balls_an_inning(*shots[1]) else 1
    weak = 1 - strong
    found = even_points(
        points[strong],
        shots[strong][0],
        shots[weak][0],
        safety_1=shots[strong][1],
        safety_2=shots[weak][1],
        first=1 if match.first == strong + 1 else 2,
        most=points[strong],
    )
    if not found.is_even:
        return Spot(weak + 1, None, None)
    p_win_1 = 1.0 - found.p_win_1 if strong else found.p_win_1
    return Spot(weak + 1, found.points_2, p_win_1)


def even_points(
    points_1: int,
    p1: Any,
    p2: Any,
    *,
    safety_1: Any = 1,
    safety_2: Any = 1,
    first: int = 1,
    most: int = 10_000,
) -> EvenPoints:
    """Return how many points player 2 should need when player 1 needs `points_1`.

    Parameters
    ----------
    points_1, p1, p2, safety_1, safety_2, first
        as in `StraightPool`.
    most
        the most points that player 2 may need.

    Returns
    -------
    EvenPoints
        the nearest to even from 1 to `most`, or to the most that can be worked out where
        that is less; the fewest points where several are equally near.

    Raises
    ------
    InputError
        as `straight_pool_odds` does.

    >>> even = even_points(100, 0.9, 0.85)
    >>> even.points_2, round(even.p_win_1, 3)
    (60, 0.497)
    """
    most = min(
        whole(most, "most", at_least=1), _most_points(exact(p2, "p2"), exact(safety_2, "safety_2"))
    )

    def win(points_2: int) -> float:
        match = StraightPool(
            points_1, points_2, p1, p2, safety_1=safety_1, safety_2=safety_2, first=first
        )
        return straight_pool_odds(match).p_win_1

    low, high = 0, 1
    while high < most and win(high) < 0.5:
        low, high = high, min(2 * high, most)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if win(middle) < 0.5 else (low, middle)
    # 1 is among them for a player 1 who never wins, whatever player 2 needs.
    nearest = min({1, low or 1, high}, key=lambda points_2: (abs(win(points_2) - 0.5), points_2))
    return EvenPoints(nearest, win(nearest))


def _balls_an_inning(p: float | Fraction, safety: float | Fraction) -> Fraction | float:
    make = exact(p)
    return math.inf if make == 1 else exact(safety) * make / (1 - make)


def _most_points(p: Fraction, safety: Fraction) -> int:
    """Return the most points that take no more than the most innings, on average."""
    if p == 1 or p * safety == 0:
        return sys.maxsize
    return max(1, math.floor((LONGEST * safety * p - p) / (1 - p)))
