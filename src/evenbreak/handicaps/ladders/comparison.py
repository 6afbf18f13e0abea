"""Compare systems: accuracy, speed, fairness, match length and stability.

Systems differ in their scales, so errors are given in points and in doublings of the odds: 30
points of the NPL are one doubling, and so are 100 of Fargo's.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.errors import AccuracyError
from evenbreak.handicaps.ladders.error_chain import error_on, move_matrix
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponents import EQUAL_SKILL, Opponents, stretched
from evenbreak.handicaps.ladders.settling import settling
from evenbreak.handicaps.ladders.unfairness import (
    CLEAR_FAVORITE,
    better_off,
    opponent_pairs_of,
    unfairness,
)
from evenbreak.ratings.scale import SCALES, Scale

NEAR = 1.0 / 6.0
"""Error of a settled rating, in doublings of the odds: 5 of the NPL's 30 points."""


def near(error: ArrayLike, scale: Scale) -> Floats:
    """Return 1 where a rating error is less than `NEAR` of a doubling, else 0; 0.5 on the edge.

    Ratings are whole points, and the edge may be one of them. Counting it as half, like an interval
    that is half inside, makes the share of accurate ratings the same on every scale.

    >>> near([4, -5, 6], SCALES["npl"]), near([40, -50, 60], Scale("ten times", 300))
    (array([1. , 0.5, 0. ]), array([1. , 0.5, 0. ]))
    """
    beyond = np.abs(np.asarray(error, dtype=float)) - NEAR * scale.points_per_doubling
    return np.asarray(np.where(np.abs(beyond) < 1e-9, 0.5, beyond < 0.0))


class SystemRow(NamedTuple):
    """Long-run behavior of a system on a chart.

    Parameters
    ----------
    sd, sd_doublings
        standard deviation of the rating error in the long run, in points and in doublings of the
        odds.
    settling_mean, settling_p90
        matches that a rating needs to get from one doubling too low to within a sixth of a
        doubling: the mean, and the number that is enough in nine cases out of ten.
    favorite
        the mean chance of the player favored by the rating errors; 0.5 is fair.
    clear_favorite
        the share of matches in which the favorite has a chance of 60% or more.
    games
        mean number per match.
    inflation
        mean number of points that a match adds to the sum of the two ratings.
    """

    system: str
    chart: str
    sd: float
    sd_doublings: float
    settling_mean: float
    settling_p90: int
    favorite: float
    clear_favorite: float
    games: float
    inflation: float


def mean_games(ladder: Ladder) -> float:
    """Return the mean number of games in a match, over the ladder's rating errors.

    >>> from evenbreak.handicaps import chart
    >>> round(mean_games(Ladder("npl", chart("npl_10"))), 2)
    7.29
    """
    pairs = opponent_pairs_of(ladder)
    games = np.maximum(pairs.table.games, 0).sum(axis=2)
    return float(np.asarray(ladder.law().probability, float) @ pairs.mean_of(games))


def _row(ladder: Ladder) -> SystemRow:
    """Return a ladder's row."""
    points = ladder.system.scale.points_per_doubling
    sd = ladder.law().sd
    settled = settling(ladder, -round(points), round(NEAR * points))
    favored = better_off(unfairness(ladder))
    return SystemRow(
        system=ladder.system.name,
        chart=ladder.chart.name,
        sd=sd,
        sd_doublings=sd / points,
        settling_mean=settled.mean,
        settling_p90=int(settled.matches.quantile(0.9)),
        favorite=favored.mean,
        clear_favorite=favored.at_least(CLEAR_FAVORITE),
        games=mean_games(ladder),
        inflation=inflation(ladder),
    )


def compare_systems(
    systems: Iterable[Any],
    *,
    opponents: Opponents = EQUAL_SKILL,
    day_sd: float = 0.0,
    match_sd: float = 0.0,
) -> list[SystemRow]:
    """Return a row for each system, in the order given.

    Everything is exact up to rounding, assuming that players' skills do not change.

    Parameters
    ----------
    systems
        for each row, a `System` or its name, or a pair of this and a `Chart` (None: the system's
        own).
    opponents
        default: equally good players with rating errors like the player's own. Their points are on
        the National Pool League's scale, where 30 points double the odds, and are converted to each
        system's scale.
    day_sd, match_sd
        the standard deviation of every player's form, in *doublings of the odds*, so that it is the
        same on all scales.

    Raises
    ------
    InputError
        if there is no such system.
    AccuracyError
        if a system does not settle.

    Notes
    -----
    Settling is for an established player; a newcomer schedule shortens it (see `settling`).

    >>> from evenbreak.handicaps import chart
    >>> for row in compare_systems([("npl", chart("npl_8")), ("npl", chart("npl_20"))]):
    ...     print(row.chart, round(row.sd, 2), round(row.settling_mean), round(row.games, 1))
    npl_8 4.58 67 5.5
    npl_20 3.69 48 15.7
    """
    rows = []
    for entry in systems:
        named, chart = entry if isinstance(entry, tuple) else (entry, None)
        points = Ladder(named, chart).system.scale.points_per_doubling
        ladder = Ladder(
            named,
            chart,
            opponents=stretched(opponents, points / SCALES["npl"].points_per_doubling),
            day_sd=day_sd * points,
            match_sd=match_sd * points,
        )
        rows.append(_row(ladder))
    return rows


def on_front(points: Sequence[tuple[float, float]]) -> list[bool]:
    """Return the Pareto-optimal pairs: no other pair is as low in both numbers and lower in one.

    >>> on_front([(4.4, 62.7), (10.0, 13.0), (11.0, 13.5)])
    [True, True, False]
    """
    return [
        not any(
            better[0] <= point[0] and better[1] <= point[1] and better != point for better in points
        )
        for point in points
    ]


# What happens to the sum of a league's ratings, and to ratings that a rising skill outruns.
#
# If the winner gains what the loser loses, the sum of all ratings stays the same. The errors that
# newcomers bring then stay in the league forever, spread over all players; only moves that the
# opponent's move does not balance can remove them. A newcomer's longer steps are such moves. So
# are the moves of a system that gives the winner more than it takes from the loser: they add to
# the sum with each match, and no result will ever show it.


_AT_THE_ENDS = 1e-6


class NewcomerInflation(NamedTuple):
    """Effect of one newcomer on the sum of the league's rating errors, in points.

    Parameters
    ----------
    brought
        the newcomer's rating error on arrival.
    made
        what the newcomer's longer steps are expected to add: the part of their moves that no
        opponent's move balances.
    left
        brought + made: what is left in the league once the newcomer is established.
    """

    brought: int
    made: float
    left: float


class Lag(NamedTuple):
    """How a rating follows a rising skill.

    Parameters
    ----------
    drift
        points by which the skill rises with each match, on average.
    mean, sd
        mean and standard deviation of the rating error in the long run, in points; a negative mean
        is a lag.
    """

    drift: float
    mean: float
    sd: float


def inflation(ladder: Ladder) -> float:
    """Return the mean increase in the sum of the two ratings in a match, in points.

    The mean is over the matches of a player whose error has the ladder's distribution.

    >>> from evenbreak.handicaps import Ladder
    >>> inflation(Ladder("npl")), round(inflation(Ladder("step 2 1")), 12)
    (0.0, 1.0)
    """
    pairs = opponent_pairs_of(ladder)
    both = pairs.mean_of(pairs.table.moves.sum(axis=2))
    return float(np.asarray(ladder.law().probability, dtype=float) @ both)


def newcomer_inflation(ladder: Ladder, start: int) -> NewcomerInflation:
    """Return the effect of a newcomer on the sum of the league's rating errors.

    Each mean is conditional on the error on arrival, and on the ladder's established opponents.

    Parameters
    ----------
    ladder
        its system defines the newcomer's steps.
    start
        the newcomer's rating minus their skill, in whole points.

    Raises
    ------
    InputError
        if start is not on the ladder.

    Notes
    -----
    The k-th match moves a newcomer by f_k times what it moves an established player, and the
    opponent once, so it adds (f_k - 1) times the newcomer's mean move: a sum over the schedule,
    found by propagating the distribution of the error.

    >>> from evenbreak.handicaps import Ladder
    >>> weak = newcomer_inflation(Ladder("npl"), -30)
    >>> weak.brought, round(weak.made, 1), round(weak.left, 1)
    (-30, 15.2, -14.8)
    """
    error = error_on(ladder.widest, start)
    law = np.zeros(len(ladder.errors))
    law[error + ladder.widest] = 1.0
    steady = replace(ladder, drift=0.0) if ladder.drift else ladder
    mean_move = steady.kernel @ steady.steps
    made = 0.0
    for matches, factor in ladder.system.newcomer_steps:
        matrix = move_matrix(ladder, factor)
        for _ in range(matches):
            made += (factor - 1) * float(law @ mean_move)
            law = law @ matrix
    return NewcomerInflation(error, made, error + made)


def lag(ladder: Ladder) -> Lag:
    """Return how far the rating lags behind a skill that drifts as the ladder's does.

    Raises
    ------
    AccuracyError
        if only the ladder's ends limit the error: the skill outruns the rating, or the ladder is
        too narrow.

    >>> from evenbreak.handicaps import Ladder
    >>> following = lag(Ladder("npl", drift=0.1))
    >>> round(following.mean, 1), round(following.sd, 1)
    (-4.0, 4.5)
    """
    law = ladder.law()
    share = float(law.probability[0] + law.probability[-1])
    if share > _AT_THE_ENDS:
        raise AccuracyError(
            "the rating error is at the ladder's ends {share:.2g} of the time: the steps don't "
            "keep up with a drift of {drift:g} a match, or the ladder is too narrow. Set "
            "widest above {widest}.",
            share=share,
            drift=ladder.drift,
            widest=ladder.widest,
        )
    return Lag(ladder.drift, law.mean, law.sd)
