"""Races between players whose ratings may be off.

The difference of two ratings is known only up to an error: it has the law N(d, e²), with the
estimate d and the standard error e. A chance W(p(δ); m, n) is then averaged over the
differences δ that are possible,

    E W = ∫ W(p(d + e z); m, n) φ(z) dz,

by the rule of Gauss and Hermite. That pulls chances towards an even one: W at the estimate
itself, the plug-in value, is too sure of the favourite.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import roots_hermitenorm

from evenbreak.checks import probability, whole
from evenbreak.errors import InputError
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.length import MatchLength, match_length
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import Scale, scale_of

Floats = NDArray[np.float64]

MOST_DOUBLINGS = 10.0
"""The largest error that is taken for one, in doublings of the odds."""

_MOST_NODES = 20_000
_FEWEST_GAMES = 6  # shorter races need the nodes of these
_TIE = 1e-9
_AT_A_TIME = 1 << 20  # values held in memory at once


def win_given_ratings(
    difference: ArrayLike,
    standard_error: ArrayLike,
    m: ArrayLike,
    n: ArrayLike,
    *,
    scale: Any = "npl",
) -> Any:
    """Return P(player 1 wins the race m:n | the ratings and how far they may be off).

    Parameters
    ----------
    difference
        rating of player 1 minus rating of player 2, in points.
    standard_error
        the standard error of that difference, in points; 0 gives the plug-in value W(p; m, n).
        Of two errors that have nothing to do with each other it is the root of the sum of
        their squares.
    m, n
        the games that player 1 and player 2 need. The four are broadcast together.
    scale
        what the points mean: a name, points that double the odds, or a `Scale`.

    Returns
    -------
    float or numpy.ndarray

    Raises
    ------
    InputError
        if a number is not finite, an error is negative or more than ten doublings of the
        odds, m or n is not a whole number, or the shapes do not broadcast.

    Notes
    -----
    The number of nodes grows with the error and with the length of the race, so that the
    rule itself is off by less than 1e-9, save for races of hundreds of games between players
    of whom next to nothing is known.

    >>> round(win_given_ratings(60, 0, 7, 3), 4), round(win_given_ratings(60, 40, 7, 3), 4)
    (0.7382, 0.6485)
    """
    scale = scale_of(scale)
    gap, error = _checked(difference, standard_error, scale)
    try:
        gap, error, m, n = np.broadcast_arrays(gap, error, m, n)
    except ValueError:
        shapes = ", ".join(str(np.shape(part)) for part in (gap, error, m, n))
        raise InputError(
            f"difference, standard_error, m and n have shapes {shapes}; "
            "give shapes that broadcast together"
        ) from None
    longest = int(np.max(m + n, initial=2))
    nodes, weights = _rule(float(error.max(initial=0.0)), longest, scale)
    chance = np.zeros(gap.shape)
    for node, weight in zip(nodes, weights, strict=True):
        chance += weight * race_win_probability(scale.win_probability(gap + node * error), m, n)
    return chance if chance.ndim else float(chance)


@overload
def length_given_ratings(
    difference: float, standard_error: float, m: int, n: int, *, scale: Any = "npl"
) -> MatchLength[float, float]: ...
@overload
def length_given_ratings(
    difference: ArrayLike, standard_error: ArrayLike, m: int, n: int, *, scale: Any = "npl"
) -> MatchLength[Floats, Floats]: ...
def length_given_ratings(
    difference: ArrayLike, standard_error: ArrayLike, m: int, n: int, *, scale: Any = "npl"
) -> MatchLength[Any, Any]:
    """Return how long the race m:n lasts, given the ratings and how far they may be off.

    Parameters are those of `win_given_ratings`, with one race for all differences; the chance
    of each length is averaged over the differences that are possible, and mean, standard
    deviation and quantiles are those of the average law.

    Raises
    ------
    InputError
        as `win_given_ratings` does.

    >>> length = length_given_ratings([0, 60], 40, 7, 3)
    >>> length.mean.round(2), length.quantile(0.9)
    (array([5.75, 7.25]), array([9, 9]))
    """
    scale = scale_of(scale)
    m, n = whole(m, "m", at_least=1), whole(n, "n", at_least=1)
    gap, error = np.broadcast_arrays(*_checked(difference, standard_error, scale))
    nodes, weights = _rule(float(error.max(initial=0.0)), m + n, scale)
    games = np.arange(min(m, n), m + n)
    total: Floats = np.zeros((*gap.shape, len(games)))
    for node, weight in zip(nodes, weights, strict=True):
        length = match_length(Race(m, n, Rack(scale.win_probability(gap + node * error))))
        # The shortest lengths are left out where their chance is nothing.
        total[..., length.games - games[0]] += weight * length.probability
    mean: Any = total @ games
    sd: Any = np.sqrt(((games - mean[..., np.newaxis]) ** 2 * total).sum(axis=-1))
    if not gap.ndim:
        mean, sd = float(mean), float(sd)
    never = np.zeros(gap.shape) if gap.ndim else 0.0
    return MatchLength(games, total, mean, sd, never, never, bounded=True)


def fairest_races(
    difference: ArrayLike,
    standard_error: ArrayLike,
    *,
    games: tuple[int, int] | None = None,
    race_to: int | None = None,
    scale: Any = "npl",
    target: float = 0.5,
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return (m, n), two arrays: the race that is nearest to a fair one for each difference.

    Its chance is averaged over the differences that are possible. Of races within 1e-9 of
    each other the shortest is taken, then the one with the smaller m, as in `fair_races`.

    Parameters
    ----------
    difference, standard_error, scale
        as for `win_given_ratings`; broadcast together.
    games
        (lo, hi): the races m:n with lo <= m + n - 1 <= hi, the longest they can last.
    race_to
        instead: what the stronger player needs (player 1, if the two are equal); the weaker
        needs as many at most.
    target
        P(player 1 wins the race) that is aimed at.

    Raises
    ------
    InputError
        if a parameter has a value that it cannot have, or not just one of `games` and
        `race_to` is given.

    >>> fairest_races([91, -91, 91], [0, 0, 80], race_to=7, scale="fargo")
    (array([7, 4, 7]), array([4, 7, 4]))
    """
    scale = scale_of(scale)
    target = float(probability(target, "target"))
    gap, error = np.broadcast_arrays(*_checked(difference, standard_error, scale))
    low, high = _limits(games, race_to)
    nodes, weights = _rule(float(error.max(initial=0.0)), high + 1, scale)
    m, longest = np.empty(gap.size, dtype=np.int64), np.empty(gap.size, dtype=np.int64)
    step = max(1, _AT_A_TIME // (len(nodes) * (high + 2)))
    for first in range(0, gap.size, step):
        part = slice(first, first + step)
        ahead = gap.reshape(-1)[part]
        p = scale.win_probability(ahead + nodes[:, np.newaxis] * error.reshape(-1)[part])
        fixed = None if race_to is None else (whole(race_to, "race_to"), ahead >= 0.0)
        m[part], longest[part] = _nearest(p, weights, low, high, fixed, target)
    return m.reshape(gap.shape), (longest + 1 - m).reshape(gap.shape)


def _checked(difference: ArrayLike, standard_error: ArrayLike, scale: Scale) -> tuple[Floats, Any]:
    gap, error = np.asarray(difference, dtype=float), np.asarray(standard_error, dtype=float)
    if not np.isfinite(gap).all():
        raise InputError("difference holds a value that is not finite; give points")
    most = MOST_DOUBLINGS * scale.points_per_doubling
    wrong = ~((error >= 0.0) & (error <= most))
    if wrong.any():
        raise InputError(
            f"standard_error of a difference is {error[wrong].flat[0]:g}; give 0 to {most:g} "
            f"points ({MOST_DOUBLINGS:g} doublings of the odds)"
        )
    return gap, error


def _limits(games: tuple[int, int] | None, race_to: int | None) -> tuple[int, int]:
    """Return the least and the most games that the longest course of a race may have."""
    if (games is None) == (race_to is None):
        raise InputError(f"games is {games!r} and race_to is {race_to!r}; give just one of the two")
    if games is None:
        needs = whole(race_to, "race_to", at_least=1)
        return needs, 2 * needs - 1
    low, high = (whole(limit, "games", at_least=1) for limit in games)
    if low > high:
        raise InputError(f"games is {games!r}; give the smaller number first")
    return low, high


def _rule(largest_error: float, longest: int, scale: Scale) -> tuple[Floats, Floats]:
    """Return nodes and weights that average W over N(0, 1) to 1e-9.

    What counts is how wide the error is beside the rise of W, which takes some
    2 / sqrt(m + n) in log-odds; found by trial against quadrature.
    """
    if largest_error == 0.0:
        return np.zeros(1), np.ones(1)
    ratio = scale.log_odds(largest_error) * math.sqrt(max(longest, _FEWEST_GAMES)) / 2.0
    return _hermite(min(_MOST_NODES, 24 + math.ceil(14.0 * ratio**2)))


@cache
def _hermite(number: int) -> tuple[Floats, Floats]:
    nodes, weights = roots_hermitenorm(number)
    weights = weights / weights.sum()
    # The outermost weigh nothing: they are left out, and with them most of a large rule.
    kept = weights > 1e-18
    return nodes[kept], weights[kept]


def _nearest(
    p: Floats,
    weights: Floats,
    low: int,
    high: int,
    fixed: tuple[int, NDArray[np.bool_]] | None,
    target: float,
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return m and m + n - 1 of the best race for each column of p, shape (nodes, pairs).

    `row[m]` is W(p; m, n) for the races with one m + n - 1, from m = 0 (player 1 has won) on.
    """
    pairs = np.arange(p.shape[1])
    best = np.full(p.shape[1], math.inf)
    best_m, best_longest = np.zeros(p.shape[1], dtype=np.int64), np.zeros_like(pairs)
    row = np.stack([np.ones_like(p), np.zeros_like(p)])
    for longest in range(1, high + 1):
        inner = p * row[:-1] + (1.0 - p) * row[1:]
        row = np.concatenate([row[:1], inner, row[-1:]])
        if longest < low:
            continue
        away = np.abs(np.einsum("k,mkj->mj", weights, inner) - target)
        if fixed is None:
            # The first of those that are tied.
            place = (away <= away.min(axis=0) + _TIE).argmax(axis=0)
        else:
            needs, ahead = fixed
            place = np.where(ahead, needs, longest + 1 - needs) - 1
        found = away[place, pairs]
        better = found < best - _TIE
        best = np.where(better, found, best)
        best_m = np.where(better, place + 1, best_m)
        best_longest = np.where(better, longest, best_longest)
    return best_m, best_longest
