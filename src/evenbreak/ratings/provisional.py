"""Who is ranked in a list of ratings: players whose ratings rest on enough games.

A rating from a handful of games says little, so among many newcomers, one will be near the top by
luck. FargoRate calls a rating preliminary below 200 games; so do lists here. In a league that has
played less, that would leave no one, so the limit there is a third of what its regulars have
played: the games of the median player when each player counts once per game. Visitors with a match
or two don't change it, however many there are, and the median player is always ranked.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Bools, Floats

ESTABLISHED = 200
"""Games at which a rating is established everywhere."""

SHARE = 3.0
"""Divisor of a regular's games in a league that has played less."""


def established_from(games: ArrayLike) -> int:
    """Return how many games establish a rating in this list: 200, or fewer in a small one."""
    played = np.sort(np.asarray(games, dtype=float).clip(0.0))[::-1]
    total = played.cumsum()
    middle = played[np.searchsorted(total, total[-1] / 2.0)] if len(played) else 0.0
    return int(np.clip(math.ceil(middle / SHARE), 1, ESTABLISHED))


def is_provisional(games: ArrayLike, least: int | None = None) -> Bools:
    """Return which ratings rest on fewer games than a list requires.

    Negative games mean that the number is not stated: such a rating may rest on none, unless all
    numbers are missing, or the list only marks new players with 0. `least` is by default
    `established_from`.

    >>> is_provisional([300, 12, -1]), is_provisional([-1, -1])
    (array([False,  True,  True]), array([False, False]))
    """
    stated = np.asarray(games)
    if not (stated > 0).any():
        return np.asarray(stated == 0)
    return np.asarray(stated < (established_from(stated) if least is None else least))


def games_of_winner(race_a: ArrayLike, race_b: ArrayLike) -> Floats:
    """Return how many games say as much as the winner of a race whose score is unknown.

    Between equals, a game has the information p (1 - p) about the log-odds, and the winner of the
    race [p (1 - p) W'(p)]² / (1/4), with W(p) = 1/2: the quotient is 4 p (1 - p) W'(p)².

    >>> games_of_winner([1, 7, 7], [1, 7, 4]).round(1)
    array([1. , 8.6, 6.7])
    """
    from scipy.special import betaincinv, betaln

    m, n = np.maximum(race_a, 1), np.maximum(race_b, 1)
    p = betaincinv(m, n, 0.5)
    slope = np.exp((m - 1) * np.log(p) + (n - 1) * np.log1p(-p) - betaln(m, n))
    return np.asarray(4.0 * p * (1.0 - p) * slope**2)
