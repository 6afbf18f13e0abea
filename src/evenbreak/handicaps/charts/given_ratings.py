"""Chances, lengths and fair races when ratings have errors.

The difference of two ratings is known only up to an error: it is distributed as N(d, e²), with
the estimate d and the standard error e. A chance W(p(δ); m, n) is then averaged over the
possible differences δ,

    E W = ∫ W(p(d + e z); m, n) φ(z) dz,

by Gauss-Hermite quadrature. That pulls chances towards 1/2: W at the estimate itself, the
plug-in value, is overconfident in the favourite. Form of the day (`evenbreak.matches.form`) is one
more error, which is drawn anew for each match.
"""

from __future__ import annotations

import math
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import floats, number, plain, probability, together, whole
from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.fair import Candidate, FairRace, longest_matches, shortest_of_ties
from evenbreak.matches.form import centre_of_form, form_of, given_score, normal_rule, rule_for
from evenbreak.matches.length import MatchLength, match_length
from evenbreak.matches.odds import MatchOdds, match_odds, mixed_odds
from evenbreak.matches.parameters import checked_match, with_rack
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale, scale_of

MOST_DOUBLINGS = 10.0
"""The largest standard error allowed, in doublings of the odds."""

_MOST_NODES = 20_000
_TIE = 1e-9
_AT_A_TIME = 1 << 20  # values held in memory at once


@overload
def win_given_ratings(
    difference: float,
    standard_error: float,
    m: float,
    n: float,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> float: ...
@overload
def win_given_ratings(
    difference: ArrayLike,
    standard_error: ArrayLike,
    m: ArrayLike,
    n: ArrayLike,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> Floats: ...
def win_given_ratings(
    difference: Any,
    standard_error: Any,
    m: Any,
    n: Any,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> Any:
    """Return P(player 1 wins the race m:n | the ratings and their standard error).

    Parameters
    ----------
    difference
        rating of player 1 minus rating of player 2, in points.
    standard_error
        the standard error of that difference, in points; 0 gives the plug-in value W(p; m, n).
        For two independent ratings it is the root of the sum of their squared errors.
    m, n
        the games that player 1 and player 2 need. All four are broadcast together.
    scale
        what the points mean: a name, points that double the odds, or a `Scale`.
    form
        how much the log-odds of a game vary from match to match (standard deviation), whatever
        the scale. The chance of a single game is the same with any form.

    Returns
    -------
    float or numpy.ndarray
        a float for numbers, otherwise an array.

    Raises
    ------
    InputError
        if a number is not finite, an error is negative or more than ten doublings of the
        odds, form is not in 0 to 3, m or n is not a whole number, or the shapes do not broadcast.

    Notes
    -----
    The number of nodes grows with the error and with the length of the race, so that the
    quadrature is off by less than 1e-9, except in races of hundreds of games between players
    about whom next to nothing is known.

    >>> round(win_given_ratings(60, 0, 7, 3), 4), round(win_given_ratings(60, 40, 7, 3), 4)
    (0.7382, 0.6485)
    """
    scale = scale_of(scale)
    gap, error = _checked(difference, standard_error, scale)
    together(difference=gap, standard_error=error, m=m, n=n)
    gap, error = with_form(gap, error, form, scale)
    gap, error, m, n = np.broadcast_arrays(gap, error, m, n)
    longest = int(np.max(m + n, initial=2))
    nodes, weights = averaging_rule(float(error.max(initial=0.0)), longest, scale)
    chance = np.zeros(gap.shape)
    for node, weight in zip(nodes, weights, strict=True):
        chance += weight * race_win_probability(scale.win_probability(gap + node * error), m, n)
    return plain(chance)


@overload
def length_given_ratings(
    difference: float,
    standard_error: float,
    m: int,
    n: int,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> MatchLength[float, float]: ...
@overload
def length_given_ratings(
    difference: ArrayLike,
    standard_error: ArrayLike,
    m: int,
    n: int,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> MatchLength[Floats, Floats]: ...
def length_given_ratings(
    difference: ArrayLike,
    standard_error: ArrayLike,
    m: int,
    n: int,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> MatchLength[Any, Any]:
    """Return how long the race m:n lasts, given the ratings and their standard error.

    The parameters are those of `win_given_ratings`, with a single race for all differences. The
    chance of each length is averaged over the possible differences; mean, standard deviation
    and quantiles are those of the averaged distribution.

    Raises
    ------
    InputError
        as for `win_given_ratings`.

    >>> length = length_given_ratings([0, 60], 40, 7, 3)
    >>> length.mean.round(2), length.quantile(0.9)
    (array([5.75, 7.25]), array([9, 9]))
    """
    scale = scale_of(scale)
    m, n = whole(m, "m", at_least=1), whole(n, "n", at_least=1)
    gap, error = np.broadcast_arrays(*_checked(difference, standard_error, scale))
    gap, error = with_form(gap, error, form, scale)
    nodes, weights = averaging_rule(float(error.max(initial=0.0)), m + n, scale)
    games = np.arange(min(m, n), m + n)
    total: Floats = np.zeros((*gap.shape, len(games)))
    for node, weight in zip(nodes, weights, strict=True):
        length = match_length(Race(m, n, scale.rack(gap + node * error)))
        # The shortest lengths are missing where their chance is 0.
        total[..., length.games - games[0]] += weight * length.probability
    mean: Any = total @ games
    sd: Any = np.sqrt(((games - mean[..., np.newaxis]) ** 2 * total).sum(axis=-1))
    if not gap.ndim:
        mean, sd = float(mean), float(sd)
    never = np.zeros(gap.shape) if gap.ndim else 0.0
    return MatchLength(games, total, mean, sd, never, never, bounded=True)


def fair_races_given_ratings(
    difference: ArrayLike,
    standard_error: ArrayLike,
    *,
    games: tuple[int, int] | None = None,
    race_to: int | None = None,
    scale: Any = DEFAULT_SCALE,
    target: float = 0.5,
    form: float = 0.0,
) -> tuple[Ints, Ints]:
    """Return (m, n), two arrays: the race nearest to the target for each difference.

    Chances are averaged over the possible differences. Among races equal within 1e-9 the
    shortest is taken, then the one with the smaller m, as in `fair_races`.

    Parameters
    ----------
    difference, standard_error, scale, form
        as for `win_given_ratings`; broadcast together.
    games, race_to, target
        as for `fair_races`.

    Raises
    ------
    InputError
        if a parameter is out of range, or not exactly one of `games` and `race_to` is given.

    >>> fair_races_given_ratings([91, -91, 91], [0, 0, 80], race_to=7, scale="fargo")
    (array([7, 4, 7]), array([4, 7, 4]))
    """
    scale = scale_of(scale)
    target = float(probability(target, "target"))
    gap, error = np.broadcast_arrays(*_checked(difference, standard_error, scale))
    gap, error = with_form(gap, error, form, scale)
    low, high = longest_matches(games, race_to)
    if race_to is not None:
        return _fairest_race_to(gap, error, low, scale, target)
    nodes, weights = averaging_rule(float(error.max(initial=0.0)), high + 1, scale)
    m, longest = np.empty(gap.size, dtype=np.int64), np.empty(gap.size, dtype=np.int64)
    step = max(1, _AT_A_TIME // (len(nodes) * (high + 2)))
    for first in range(0, gap.size, step):
        part = slice(first, first + step)
        ahead = gap.reshape(-1)[part]
        p = scale.win_probability(ahead + nodes[:, np.newaxis] * error.reshape(-1)[part])
        m[part], longest[part] = _nearest(p, weights, low, high, target)
    return m.reshape(gap.shape), (longest + 1 - m).reshape(gap.shape)


def _checked(difference: ArrayLike, standard_error: ArrayLike, scale: Scale) -> tuple[Floats, Any]:
    return floats(difference, "difference"), error_of(standard_error, scale)


def error_of(standard_error: ArrayLike, scale: Scale) -> Any:
    """Return the standard error of a difference, or several, if they can be averaged over."""
    most = MOST_DOUBLINGS * scale.points_per_doubling
    wanted = f"0 to {most:g} points ({MOST_DOUBLINGS:g} doublings of the odds)"
    return floats(standard_error, "standard_error", low=0.0, high=most, wanted=wanted)


def averaging_rule(
    largest_error: float, longest: int, scale: Scale, most: int = _MOST_NODES
) -> tuple[Floats, Floats]:
    """Return nodes and weights that average W over N(0, 1) to 1e-9, unless `most` are too few."""
    return normal_rule(scale.log_odds(largest_error), longest, most)


def with_form(difference: Floats, error: Floats, form: float, scale: Scale) -> tuple[Any, Any]:
    """Return the differences and errors that stand for those given and form of the day together.

    Both are normal, so their variances add up. The chance of a game stays what it is without form.
    """
    form = form_of(form)
    if form == 0.0:
        return difference, error
    mean, sd = scale.log_odds(difference), scale.log_odds(error)
    centre, around = centre_of_form(mean, sd, form), np.hypot(sd, form)
    return np.asarray(scale.points(centre)), np.asarray(scale.points(around))


def _fairest_race_to(
    gap: Floats, error: Floats, needs: int, scale: Scale, target: float
) -> tuple[Ints, Ints]:
    """Return (m, n) where the stronger player needs so many games, and the other at most as many.

    The stronger player's chance rises with the games that the other needs, so the nearest to
    the target is found by bisection.
    """
    ahead = gap >= 0.0
    wanted = np.where(ahead, target, 1.0 - target)

    def away(fewer: Ints) -> Floats:
        return win_given_ratings(np.abs(gap), error, needs, fewer, scale=scale) - wanted

    below, above = np.ones(gap.shape, dtype=np.int64), np.full(gap.shape, needs)
    while (above - below > 1).any():
        middle = (below + above) // 2
        enough = away(middle) >= 0.0
        below, above = np.where(enough, below, middle), np.where(enough, middle, above)
    fewer = np.where(np.abs(away(above)) < np.abs(away(below)) - _TIE, above, below)
    return np.where(ahead, needs, fewer), np.where(ahead, fewer, needs)


def _nearest(p: Floats, weights: Floats, low: int, high: int, target: float) -> tuple[Ints, Ints]:
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
        # The first of those that tie.
        place = (away <= away.min(axis=0) + _TIE).argmax(axis=0)
        found = away[place, pairs]
        better = found < best - _TIE
        best = np.where(better, found, best)
        best_m = np.where(better, place + 1, best_m)
        best_longest = np.where(better, longest, best_longest)
    return best_m, best_longest


# The odds of any match, when the ratings of the two players have errors.


def odds_given_ratings(
    match: Match,
    difference: float,
    standard_error: float,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> MatchOdds:
    """Return the odds of a match, averaged over how far a difference of ratings may be off.

    Parameters
    ----------
    match
        what is played; the chance in a game comes from the ratings, whatever its rack says.
    difference, standard_error, scale, form
        as for `win_given_ratings`; without error and form the odds are those of `match_odds`.

    Raises
    ------
    InputError
        as for `win_given_ratings`, or if the break matters in the match.

    Notes
    -----
    The lengths of all possible differences are mixed, and mean, standard deviation and quantiles
    are those of the mixture. A score that is already reached does not change the ratings, unless
    there is form: then it shows how well both play today.

    >>> from evenbreak.games import Race, Rack
    >>> race = Race(7, 3, Rack(0.5))
    >>> round(odds_given_ratings(race, 60, 0).p_win_1, 4)
    0.7382
    >>> round(odds_given_ratings(race, 60, 40).p_win_1, 4)
    0.6485
    """
    match, scale, form = checked_match(match), scale_of(scale), form_of(form)
    difference = number(difference, "difference")
    standard_error = float(error_of(number(standard_error, "standard_error"), scale))
    if match.break_matters:
        raise InputError("the break matters in the match, but ratings do not say who breaks well")

    if standard_error == 0.0 and not form:
        return match_odds(with_rack(match, Rack(scale.win_probability(difference))))
    gap, error = with_form(np.asarray(difference), np.asarray(standard_error), form, scale)
    nodes, weights = rule_for(match, scale.log_odds(float(error)))
    many = with_rack(match, Rack(scale.win_probability(gap + nodes * error)))
    return mixed_odds(many, given_score(many, weights) if form else weights)


# The races nearest to a target, when the ratings of the two players have errors.


MOST_RACES = 20_000
"""Races among which the nearest are sought: all of up to 200 games."""


def nearest_races_given_ratings(
    difference: float,
    standard_error: float,
    *,
    games: tuple[int, int] | None = None,
    race_to: int | None = None,
    target: float = 0.5,
    top: int = 5,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> list[FairRace]:
    """Return the races in which player 1's chance is nearest to `target`, the nearest first.

    Chances and lengths are averaged over the possible differences; the first race is that of
    `fair_races_given_ratings`.

    Parameters
    ----------
    difference, standard_error, scale, form
        as for `win_given_ratings`.
    games, race_to, target, top
        as for `fair_races`.

    Raises
    ------
    InputError
        if a parameter is out of range, not exactly one of `games` and `race_to` is given, or
        more than 20,000 races are offered.

    >>> for race in nearest_races_given_ratings(91, 80, race_to=7, top=2, scale="fargo"):
    ...     print(race.race_1, race.race_2, round(race.p_win_1, 3), round(race.mean_games, 2))
    7 4 0.512 8.06
    7 3 0.372 6.81
    """
    scale, difference = scale_of(scale), number(difference, "difference")
    target, top = probability(target, "target"), whole(top, "top", at_least=1)
    low, high = longest_matches(games, race_to)
    if race_to is not None:
        other = np.arange(1, low + 1)
        own = np.full(low, low)
        m, n = (own, other) if difference >= 0.0 else (other, own)
    else:
        if (many := (high * (high + 1) - low * (low - 1)) // 2) > MOST_RACES:
            raise InputError(
                f"games {low}..{high} offers {many:,} races, and {MOST_RACES:,} are the most; give "
                "fewer games"
            )
        longest = np.repeat(np.arange(low, high + 1), np.arange(low, high + 1))
        m = np.concatenate([np.arange(1, games + 1) for games in range(low, high + 1)])
        n = longest + 1 - m
    way: dict[str, Any] = {"scale": scale, "form": form}
    chances = win_given_ratings(difference, standard_error, m, n, **way)
    rows = zip(np.abs(chances - target).tolist(), m.tolist(), n.tolist(), strict=True)
    ordered = shortest_of_ties(
        sorted(Candidate(away, one + two - 1, one, two) for away, one, two in rows)
    )
    found = []
    for _, _, one, two in ordered[:top]:
        length = length_given_ratings(difference, standard_error, one, two, **way)
        p_win = win_given_ratings(difference, standard_error, one, two, **way)
        found.append(FairRace(one, two, p_win, length.mean, length.quantile(0.9) or 0))
    return found
