"""Systems side by side: how accurate they are, how fast, how fair, how long, how stable.

Systems differ in their scales, so errors are given in points and in doublings of the odds: 30
points of the NPL are one doubling, and so are 100 of Fargo's.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.handicaps.ladders.inflation import inflation
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponent_pairs import opponent_pairs_of
from evenbreak.handicaps.ladders.opponents import EQUAL_SKILL, Opponents, stretched
from evenbreak.handicaps.ladders.settling import settling
from evenbreak.handicaps.ladders.unfairness import CLEAR_FAVOURITE, better_off, unfairness
from evenbreak.ratings.scale import SCALES, Scale

NEAR = 1.0 / 6.0
"""A rating within this share of a doubling is settled: 5 points of the NPL's 30."""


def near(error: ArrayLike, scale: Scale) -> Floats:
    """Return 1 where a rating error is less than `NEAR` of a doubling, else 0; 0.5 on the edge.

    Ratings are whole points, and the edge may be one of them. Counted half, as part of an interval
    that is half inside, it makes the share of ratings that are near the same on every scale.

    >>> near([4, -5, 6], SCALES["npl"]), near([40, -50, 60], Scale("ten times", 300))
    (array([1. , 0.5, 0. ]), array([1. , 0.5, 0. ]))
    """
    beyond = np.abs(np.asarray(error, dtype=float)) - NEAR * scale.points_per_doubling
    return np.asarray(np.where(np.abs(beyond) < 1e-9, 0.5, beyond < 0.0))


class SystemRow(NamedTuple):
    """A system on a chart in the long run.

    Parameters
    ----------
    system, chart
        their names.
    sd, sd_doublings
        the standard deviation of the rating error in the long run, in points and in doublings
        of the odds.
    settling_mean, settling_p90
        matches that a rating takes from one doubling too low to within a sixth of a doubling:
        the mean, and the number that is enough for nine in ten.
    favourite
        the mean chance to win of the player whom the errors favour; 0.5 is fair.
    clear_favourite
        the share of matches in which the favourite has a chance of 60% or more.
    games
        the mean number of games in a match.
    inflation
        how many points a match adds to the sum of the two ratings, on average.
    """

    system: str
    chart: str
    sd: float
    sd_doublings: float
    settling_mean: float
    settling_p90: int
    favourite: float
    clear_favourite: float
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
    favoured = better_off(unfairness(ladder))
    return SystemRow(
        system=ladder.system.name,
        chart=ladder.chart.name,
        sd=sd,
        sd_doublings=sd / points,
        settling_mean=settled.mean,
        settling_p90=int(settled.matches.quantile(0.9)),
        favourite=favoured.mean,
        clear_favourite=favoured.at_least(CLEAR_FAVOURITE),
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

    Everything is exact up to rounding, and conditional on players whose skill does not change.

    Parameters
    ----------
    systems
        for each row a `System` or its name, or a pair of it and a `Chart` (None: its own).
    opponents
        who players meet; by default equally good players with rating errors like their own.
        Their points are those of the National Pool League's scale, 30 of which double the odds,
        and are converted to the scale of each system.
    day_sd, match_sd
        how much every player's form varies, in *doublings of the odds*, so that it is the same
        on all scales.

    Raises
    ------
    InputError
        if there is no such system.
    AccuracyError
        if a system does not settle.

    Notes
    -----
    Settling is that of an established player; a newcomer schedule shortens it, see `settling`.

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
    """Return which pairs no other pair beats by being as low in both numbers and lower in one.

    >>> on_front([(4.4, 62.7), (10.0, 13.0), (11.0, 13.5)])
    [True, True, False]
    """
    return [
        not any(other[0] <= one[0] and other[1] <= one[1] and other != one for other in points)
        for one in points
    ]
