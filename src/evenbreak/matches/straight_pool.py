"""Straight pool (14.1): each player shoots until a miss; the first to reach their points wins.

A player who needs N points gets there in their own inning T, independent of the other player. If
they make the first shot of an inning with chance alpha p and each of the others with p, the chances
of T = 1, 2, ... are the coefficients of

    alpha p^N (1 - a z)^(N - 1) / (1 - b z)^N,    a = 1 - alpha, b = 1 - alpha p,

and the ratios r_j of successive chances, starting with r_0 = N alpha (1 - p) + a, satisfy

    (j + 1) r_j = (a + b) j + N alpha (1 - p) + a - a b j / r_(j - 1).

They decrease toward b. The subtracted term is at most a j, and the sum exceeds it by at least b j,
so every chance keeps nearly all its digits, with or without safety play (a = 0).
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from dataclasses import KW_ONLY, dataclass
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.matches.quantiles import quantile_of
from evenbreak.stats.counts import exact

LONGEST = 10_000
"""The most innings, on average, that a player may need in this module."""

_TAIL = 60.0
"""Innings are cut off once the remaining probability is below exp(-60) of the largest."""


@dataclass(frozen=True)
class StraightPool:
    """Match of 14.1 straight pool; the player who needs fewer points has a spot, or is ahead.

    The players take turns, and each turn, an inning, ends with the first miss. Fouls and the
    points they cost are left out; a safety counts as a miss.

    Parameters
    ----------
    points_1, points_2
        the points that player 1 and player 2 need, 1 or more.
    p1, p2
        P(the player makes a shot), the same for every shot but the first of an inning. A float
        stands for the decimal that it prints.
    safety_1, safety_2
        P(player 1, 2 makes the first shot of an inning) is safety_1 p1, safety_2 p2: below 1
        if the opponent leaves a hard shot.
    first
        who shoots first, 1 or 2.

    Raises
    ------
    InputError
        if a parameter has an invalid value.

    >>> StraightPool(100, 80, 0.9, 0.85)
    StraightPool(points_1=100, points_2=80, p1=0.9, p2=0.85, safety_1=1, safety_2=1, first=1)
    """

    points_1: int
    points_2: int
    p1: float | Fraction
    p2: float | Fraction
    _: KW_ONLY
    safety_1: float | Fraction = 1
    safety_2: float | Fraction = 1
    first: int = 1

    def __post_init__(self) -> None:
        for name in ("points_1", "points_2"):
            object.__setattr__(self, name, whole(getattr(self, name), name, at_least=1))
        for name in ("p1", "p2", "safety_1", "safety_2"):
            exact(getattr(self, name), name)
        object.__setattr__(self, "first", one_of(self.first, "first", (1, 2)))


@dataclass(frozen=True)
class StraightPoolOdds:
    """Win probabilities and length of a straight-pool match.

    Parameters
    ----------
    p_win_1, p_win_2
        P(player 1, 2 wins the match).
    p_never_ends
        P(no one ever wins): 1 if neither player can make the first shot, else 0.
    mean_innings, sd_innings
        mean and standard deviation of the winner's number of innings; None if the match never ends.
    innings_p50, innings_p90
        the smallest number of innings within which it ends with probability .5, .9; None if
        it never ends.
    """

    p_win_1: float
    p_win_2: float
    p_never_ends: float
    mean_innings: float | None
    sd_innings: float | None
    innings_p50: int | None
    innings_p90: int | None


def straight_pool_odds(match: StraightPool) -> StraightPoolOdds:
    """Return who wins a straight-pool match, and in how many innings.

    Raises
    ------
    InputError
        if a player can reach their points, but would take more than 10,000 innings on average.

    Notes
    -----
    P(player 1 wins) is the sum over i of P(player 1 gets there in inning i) times P(player 2
    has not got there before). Runs are those of problems P5.11 and P5.15.

    >>> odds = straight_pool_odds(StraightPool(100, 100, 0.9, 0.85))
    >>> round(odds.p_win_1, 4), round(odds.p_win_2, 4), round(odds.mean_innings, 2)
    (0.8916, 0.1084, 11.76)
    """
    (reach_1, left_1), (reach_2, left_2) = _aligned(match)
    # The second player has their i-th inning only if the first has missed in theirs.
    if match.first == 1:
        win_1, win_2 = reach_1 * left_2[:-1], reach_2 * left_1[1:]
    else:
        win_1, win_2 = reach_1 * left_2[1:], reach_2 * left_1[:-1]
    ends = win_1 + win_2
    p_win_1, p_win_2 = float(win_1.sum()), float(win_2.sum())
    if not ends.any():
        return StraightPoolOdds(0.0, 0.0, 1.0, None, None, None, None)
    innings = np.arange(1, ends.size + 1)
    mean = float((innings * ends).sum())
    half, most = (quantile_of(ends.tolist(), q) for q in (0.5, 0.9))
    return StraightPoolOdds(
        p_win_1=p_win_1,
        p_win_2=p_win_2,
        p_never_ends=0.0,
        mean_innings=mean,
        sd_innings=math.sqrt(float(((innings - mean) ** 2 * ends).sum())),
        innings_p50=half + 1,
        innings_p90=most + 1,
    )


def _aligned(match: StraightPool) -> list[tuple[Floats, Floats]]:
    """Return for each player P(T = i) for i = 1, 2, ..., n, and P(T >= i) up to i = n + 1."""
    players = [
        (match.points_1, exact(match.p1), exact(match.safety_1)),
        (match.points_2, exact(match.p2), exact(match.safety_2)),
    ]
    for number, (points, p, safety) in enumerate(players, 1):
        _refuse_endless(number, points, p, safety)
    longest = max(_innings_to(*player, at_least=1).size for player in players)
    laws = []
    for player in players:
        reach = np.zeros(longest)
        innings = _innings_to(*player, at_least=longest)[:longest]
        reach[: innings.size] = innings
        left = np.append(reach[::-1].cumsum()[::-1], 0.0) if innings.any() else np.ones(longest + 1)
        laws.append((reach, left))
    return laws


def _innings_to(points: int, p: Fraction, safety: Fraction, *, at_least: int) -> Floats:
    """Return P(the points are reached in inning i), i = 1, 2, ...; zero if they never are."""
    if p * safety == 0:
        return np.zeros(at_least)
    ratios = []
    log_chance = peak = 0.0
    for ratio in _ratios(points, p, safety):
        if ratio == 0.0:
            break
        ratios.append(ratio)
        log_chance += math.log(ratio)
        peak = max(peak, log_chance)
        # The ratios decrease, so what is still to come is less than a geometric sum.
        if ratio < 1.0 and len(ratios) >= at_least:
            to_come = log_chance - math.log1p(-ratio)
            if to_come < peak - _TAIL:
                break
    # From the largest probability outwards, so that none collects very many roundings.
    turn = sum(ratio > 1.0 for ratio in ratios)
    before = np.cumprod(1.0 / np.array(ratios[:turn][::-1]))[::-1]
    chances = np.concatenate([before, [1.0], np.cumprod(ratios[turn:])])
    return np.asarray(chances / chances.sum())


def _ratios(points: int, p: Fraction, safety: Fraction) -> Iterator[float]:
    a, b = float(1 - safety), float(1 - safety * p)
    start = float(points * safety * (1 - p) + 1 - safety)
    ratio, j = start, 0
    while True:
        yield ratio
        j += 1
        ratio = ((a + b) * j + start - a * b * j / ratio) / (j + 1)


def _refuse_endless(number: int, points: int, p: Fraction, safety: Fraction) -> None:
    if p * safety == 0:
        return
    innings = (points * (1 - p) + p) / (safety * p)
    if innings > LONGEST:
        raise InputError(
            "p{number} is {p:g}: {points} points take {innings:.3g} innings on average; "
            "the limit is {longest:,}. Give a larger chance or fewer points.",
            number=number,
            p=float(p),
            points=points,
            innings=float(innings),
            longest=LONGEST,
        )


_EVEN = (0.4, 0.6)
"""Range of player 1's chance, .4 to .6, within which a match is called even."""


class EvenPoints(NamedTuple):
    """Points for player 2 that make a match as even as possible.

    `p_win_1` is P(player 1 wins the match) with them.
    """

    points_2: int
    p_win_1: float

    @property
    def is_even(self) -> bool:
        """Whether each player wins with probability 0.4 or more.

        If not, no number of points makes the match even: the points are too few, or one player is
        far better.

        >>> even_points(100, 0.9, 0.85).is_even, even_points(1, 0.9, 0.8).is_even
        (True, False)
        """
        return _EVEN[0] <= self.p_win_1 <= _EVEN[1]


class Spot(NamedTuple):
    """How many points the weaker player should need if the stronger player's points stay the same.

    Parameters
    ----------
    weaker
        the weaker player, 1 or 2.
    points
        how many points they should need; None if no number of points makes the match even.
    p_win_1
        P(player 1 wins the match) with these points; None if `points` is None.
    """

    weaker: int
    points: int | None
    p_win_1: float | None


def even_spot(match: StraightPool) -> Spot:
    """Return the weaker player's points that make a match as even as possible.

    The stronger player is the one who makes more balls per inning, or player 1 if they are equal.

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
    even = even_points(
        points[strong],
        shots[strong][0],
        shots[weak][0],
        safety_1=shots[strong][1],
        safety_2=shots[weak][1],
        first=1 if match.first == strong + 1 else 2,
        most=points[strong],
    )
    if not even.is_even:
        return Spot(weak + 1, None, None)
    p_win_1 = 1.0 - even.p_win_1 if strong else even.p_win_1
    return Spot(weak + 1, even.points_2, p_win_1)


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
        the points closest to even from 1 to `most`, or to the most that can be calculated if that
        is less; the fewest of several equally close ones.

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
    """Return the most points that take at most the largest number of innings, on average."""
    if p == 1 or p * safety == 0:
        return sys.maxsize
    return max(1, math.floor((LONGEST * safety * p - p) / (1 - p)))
