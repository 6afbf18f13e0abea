"""How many rating points double the odds in a league, according to its results.

If results state ratings, the games show the value of a point. If they state only races, and the
races come from a known chart, each race shows which range the rating difference was in; within the
range, the differences are assumed to follow a half-normal distribution, fitted to how often each
race was played. Matches in the chart's last row, which has no end, are then left out.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import erf

from evenbreak.arrays import Floats, Ints
from evenbreak.handicaps.charts.chart import CHARTS, Chart, chart
from evenbreak.handicaps.charts.played_chart import (
    RARE,
    PlayedChart,
    level_numbers_of,
    played_chart,
)
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.handicap_slope import handicap_slope
from evenbreak.ratings.levels import implied_difference
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import SCALES
from evenbreak.ratings.validation.starts import FEWEST, MOST_CLASSES

FEWEST_STARTS = 7
"""Start sizes needed on each side for races to show what they assume."""


class FairScale(NamedTuple):
    """The points that double the odds, and a chart made for them.

    Parameters
    ----------
    points
        from the results, with their 95% interval.
    assumed
        the points that the races assume.
    matches
        the number of matches used.
    games
        the longest possible match of the shortest and of the longest race.
    """

    points: Estimate
    assumed: float
    matches: int
    games: tuple[int, int]
    least: tuple[int, int]


class LeagueChart(NamedTuple):
    """The chart that a league uses, as far as its results show.

    Parameters
    ----------
    nearest
        the closest chart in the catalog; None if none is close.
    scale
        None if ratings are unknown.
    """

    nearest: PlayedChart | None = None
    scale: FairScale | None = None


def league_chart(results: Results) -> LeagueChart:
    """Return the chart that a league uses, as far as its results show.

    >>> season = Results.from_names(["Ann"], ["Bo"], [7], [5], race_a=[7], race_b=[7])
    >>> league_chart(season)
    LeagueChart(nearest=None, scale=None)
    """
    check_results(results)
    nearest = played_chart(results)
    return LeagueChart(nearest, fair_scale(results, nearest))


def fair_scale(results: Results, played: PlayedChart | None) -> FairScale | None:
    """Return the points that double the odds; None without ratings or with too few unequal races.

    Ratings are `level_a` and `level_b`; otherwise, races must be from a catalog chart, `played`.
    """
    season = results.played().results
    race_a, race_b = season.races
    season = season.select((race_a > 0) & (race_b > 0))
    race_a, race_b = season.races
    if (race_a != race_b).sum() < FEWEST:
        return None
    by_chart = chart(played.name) if played is not None and played.name in CHARTS else None
    apart = _differences(season, by_chart)
    if apart is None or (by_chart is None and len(np.unique(race_a - race_b)) < FEWEST_STARTS):
        return None
    rated = ~np.isnan(apart)
    slope = handicap_slope(season.select(rated), apart[rated])
    if slope is None or slope.low <= 0.0:
        return None
    least = _usual(np.maximum(race_a, race_b), RARE), _usual(np.minimum(race_a, race_b), RARE)
    longest = race_a + race_b - 1
    return FairScale(
        Estimate(*(math.log(2.0) / end for end in (slope.value, slope.high, slope.low))),
        _assumed(season.select(rated), apart[rated], by_chart),
        int(rated.sum()),
        (_usual(longest, RARE), _usual(longest, 1.0 - RARE)),
        least,
    )


def _usual(games: Ints, share: float) -> int:
    """Return the number of games that at most this share of the matches stays below."""
    return int(np.quantile(games, share, method="inverted_cdf"))


def _differences(season: Results, by_chart: Chart | None) -> Floats | None:
    """Return how many points a is rated above b in each match, NaN where unknown."""
    level_a, level_b = level_numbers_of(season)
    apart = level_a - level_b
    stated = ~np.isnan(apart)
    if stated.mean() <= 0.5:
        return None if by_chart is None else _by_race(season, by_chart)
    levels = np.unique(np.concatenate([level_a[stated], level_b[stated]]))
    return apart if by_chart is not None or len(levels) > MOST_CLASSES else None


def _by_race(season: Results, by_chart: Chart) -> Floats:
    """Return the expected rating difference in each match, given its race."""
    race_a, race_b = season.races
    pairs = [(row.stronger_needs, row.weaker_needs) for row in by_chart.rows]
    needs = np.maximum(race_a, race_b), np.minimum(race_a, race_b)
    place = np.full(len(season), -1)
    for k, (m, n) in enumerate(pairs):
        place[(needs[0] == m) & (needs[1] == n)] = k
    often = np.bincount(place[place >= 0], minlength=len(pairs)).astype(float)
    cuts = np.array([0.0, *(row.difference_from - 0.5 for row in by_chart.rows[1:])])
    mean = _mean_differences(cuts, often)
    mean[0] = 0.0
    mean[-1] = np.nan
    # A race that stands in several rows does not say which.
    repeated = [pairs.count(pair) > 1 for pair in pairs]
    mean[repeated] = np.nan
    return np.where(place >= 0, np.sign(race_a - race_b) * mean[place], np.nan)


def _mean_differences(cuts: Floats, often: Floats) -> Floats:
    """Return the mean difference in each row of a chart under the best-fitting half-normal."""
    edges = np.append(cuts, np.inf)

    def loss(log_sd: float) -> float:
        share = np.diff(erf(edges / (math.sqrt(2.0) * math.exp(log_sd))))
        return -float(often @ np.log(np.maximum(share, 1e-300)))

    bounds = math.log(max(float(cuts[-1]), 1.0)) - 3.0, math.log(max(float(cuts[-1]), 1.0)) + 3.0
    sd = math.exp(minimize_scalar(loss, bounds=bounds, method="bounded").x)
    density = np.exp(-0.5 * (edges / sd) ** 2)
    share = np.diff(erf(edges / (math.sqrt(2.0) * sd)))
    return np.asarray(
        sd * math.sqrt(2.0 / math.pi) * (density[:-1] - density[1:]) / np.maximum(share, 1e-300)
    )


def _assumed(season: Results, apart: Floats, by_chart: Chart | None) -> float:
    """Return the points that double the odds according to the chart or to the races played."""
    scale = None if by_chart is None else SCALES.get(by_chart.name.split("_")[0])
    if scale is not None:
        return scale.points_per_doubling
    implied = implied_difference(season)
    # The hardest race serves all larger differences too.
    rows = np.abs(implied) < np.abs(implied).max()
    if implied[rows].any():
        apart, implied = apart[rows], implied[rows]
    return math.log(2.0) * float(apart @ implied) / float(implied @ implied)
