"""How strong the skill levels of a chart are, and how likely the higher level is to win a game.

A chart by skill level does not say what a level is worth. Three sources do, the best first:

- The league's own results. A player of level L has the strength s_L + u, where u, the player's own
  distance from the middle of the level, is N(0, spread²); a game has the log-odds of the difference
  of the two strengths. The strengths are estimated together with all u, shrunk towards what the
  next source says (standard deviation `PRIOR_SD`), and the spread by the largest marginal
  likelihood, in Laplace's approximation (Breslow & Clayton 1993).
- Measured results of many leagues with the same chart: `MEASURED`.
- The chart itself: the strengths that make its races as even as possible (`audit_levels`). That is
  an assumption, not a measurement.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse
from scipy.sparse.linalg import splu
from scipy.special import expit

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.handicaps.charts.chart_of import level_chart_of
from evenbreak.handicaps.charts.level_audit import audit_levels
from evenbreak.handicaps.charts.level_chart import LevelChart, level_chart
from evenbreak.handicaps.charts.played_chart import level_numbers_of
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.words import Sentence, say

FARGO = SCALES["fargo"]

FEWEST = 100
"""Matches between different levels from which a league's own results are used."""

MOST = 10_000
"""The matches that are used at most, the last ones: more say nothing that would matter."""

PRIOR_SD = 50.0
"""How far a league's levels may be from those of other leagues (standard deviation), in points."""

WIDEST, NARROWEST = 300.0, 3.0
"""The spreads of the players of a level that are considered, in points."""

_MOST_STEPS, _TINY = 50, 1e-6

MEASURED = {
    "apa_8ball": (
        (0.666,),
        (0.781, 0.632),
        (0.847, 0.721, 0.594),
        (0.903, 0.812, 0.689, 0.609),
        (0.908, 0.885, 0.811, 0.708, 0.625),
    )
}
"""P(the higher level wins a game), by the higher level from the second on, then by the lower one.

APA 8-ball: fitted, one chance for each pair, to a public table of the mean match points of some
40,000 matches of one region (2025), under the chart and the split of three points (3-0 for a
shutout, 2-1 if the loser was on the hill, else 2-0). All 30 means are then within .021 points. The
chances are means over the players of two levels, so they leave no spread to average over.
"""


@own_arrays
@dataclass(frozen=True, eq=False)
class LevelSkills:
    """How strong the levels of a chart are, on the Fargo scale (100 points double the odds).

    Parameters
    ----------
    chart
        the chart.
    gaps, errors
        `gaps[i, j]`: by how much `levels[i]` is stronger than `levels[j]`, in points, and its
        standard error; NaN where nothing says how far off it may be.
    points, standard_error
        the strengths that come nearest to the gaps by least squares, 0 for the lowest level, and
        their standard errors, of which two make that of a difference as independent ones would;
        only differences have a meaning.
    spread
        how far players of one level differ from its middle (standard deviation), in points; 0 where
        it is not known.
    source
        'results' of the league, 'measured' elsewhere, or 'chart': assumed by the chart.
    matches
        the league's matches that were used, 0 if none.
    """

    chart: LevelChart
    gaps: Floats
    errors: Floats
    points: Floats
    standard_error: Floats
    spread: float
    source: Literal["results", "measured", "chart"]
    matches: int = 0

    @property
    def levels(self) -> tuple[int, ...]:
        """The skill levels of the chart."""
        return tuple(self.chart.levels)

    @property
    def scale(self) -> Scale:
        """The scale of the points: Fargo's."""
        return FARGO

    @property
    def is_known(self) -> bool:
        """Whether anything says how far off the gaps may be."""
        return self.source != "chart"

    def difference(self, level_1: ArrayLike, level_2: ArrayLike) -> Any:
        """Return by how many points level 1 is stronger, elementwise."""
        return self.gaps[self.places(level_1), self.places(level_2)]

    def error(self, level_1: ArrayLike, level_2: ArrayLike) -> Any:
        """Return how far off that is for two players of the levels, in points; 0 if not known.

        It joins the standard error of the difference and the spread of the players of a level.
        """
        known = np.nan_to_num(self.errors[self.places(level_1), self.places(level_2)])
        return np.hypot(known, np.sqrt(2.0) * self.spread)

    def chance(self, level_1: ArrayLike, level_2: ArrayLike) -> Any:
        """Return P(a player in the middle of level 1 wins a game against one of level 2).

        >>> level_skills("apa_8ball").chance(5, [3, 4, 5]).round(3)
        array([0.721, 0.594, 0.5  ])
        """
        return FARGO.win_probability(self.difference(level_1, level_2))

    def strength(self, levels: ArrayLike) -> Floats:
        """Return the points of players of these levels; NaN for what is no level of the chart."""
        array = np.asarray(levels, dtype=np.float64)
        points, known = np.full(array.shape, np.nan), np.isin(array, self.levels)
        points[known] = self.points[self.places(array[known])]
        return points

    def places(self, levels: ArrayLike) -> Ints:
        """Return where levels are in `levels`.

        Raises
        ------
        InputError
            if the chart has no such level.
        """
        return self.chart.places(levels, "levels")

    @property
    def why(self) -> Sentence:
        """What the chances rest on, in a sentence."""
        if self.source == "results":
            return say(
                "The chance of a game comes from the skill levels, by {matches:,} matches of your "
                "own results ({error}).",
                matches=self.matches,
                error=self._off,
            )
        if self.source == "measured":
            return say(
                "The chance of a game comes from the skill levels, by some 40,000 matches of other "
                "leagues with this chart ({error}).",
                error=self._off,
            )
        return say(
            "The chance of a game is an assumption, not a measurement: that the levels of {chart} "
            "are as far apart as its races make up for.",
            chart=self.chart.name,
        )

    @property
    def _off(self) -> Sentence:
        off = float(np.median(self.errors[np.triu_indices(len(self.levels), 1)]))
        return say("\N{PLUS-MINUS SIGN} {points:.0f} Fargo points for two levels", points=off)


def level_skills(chart: LevelChart | str, results: Results | None = None) -> LevelSkills:
    """Return how strong the levels of a chart are, by the best source that there is.

    Parameters
    ----------
    chart
        the chart, or its name in `LEVEL_CHARTS`.
    results
        the league's own results with `level_a` and `level_b`; they are used if at least `FEWEST`
        matches are between different levels.

    Raises
    ------
    InputError
        if the chart is unknown.

    >>> skills = level_skills("apa_8ball")
    >>> skills.source, skills.points.round().tolist()
    ('measured', [0.0, 94.0, 177.0, 238.0, 303.0, 370.0])
    """
    chart = level_chart_of(chart)
    usual = _measured(chart) or _assumed(chart)
    if results is None:
        return usual
    level_a, level_b = level_numbers_of(results)
    rows = results.counted & (results.score_a + results.score_b > 0)
    rows &= np.isin(level_a, chart.levels) & np.isin(level_b, chart.levels)
    if (level_a[rows] != level_b[rows]).sum() < FEWEST:
        return usual
    used = np.flatnonzero(rows)[-MOST:]
    places = usual.places(level_a[used]), usual.places(level_b[used])
    return _estimated(usual, results.select(used), places)


def _measured(chart: LevelChart) -> LevelSkills | None:
    """Return what was measured elsewhere; None where nothing was for these levels and races."""
    for name, rows in MEASURED.items():
        measured = level_chart(name)
        if (chart.levels, chart.needs) != (measured.levels, measured.needs):
            continue
        many = len(chart.levels)
        gaps = np.zeros((many, many))
        for higher, chances in enumerate(rows, 1):
            gaps[higher, :higher] = FARGO.difference(np.array(chances))
        gaps -= gaps.T
        points = gaps.mean(axis=1)
        left = (points[:, None] - points - gaps)[np.triu_indices(many, 1)]
        # How far the pairs are from single strengths of the levels is the best sign of how far
        # off one of them may be: the table does not say how many matches each rests on.
        scatter = float(np.sqrt((left**2).sum() / (left.size - many + 1)))
        own = np.full(many, scatter / np.sqrt(many))
        errors = scatter * (1.0 - np.eye(many))
        return LevelSkills(chart, gaps, errors, points - points[0], own, 0.0, "measured")
    return None


def _assumed(chart: LevelChart) -> LevelSkills:
    """Return the strengths that make the races of a chart as even as possible."""
    points = np.array(audit_levels(chart, scale=FARGO).ratings)
    gaps, own = points[:, None] - points, np.full(len(points), np.nan)
    return LevelSkills(chart, gaps, np.full(gaps.shape, np.nan), points, own, 0.0, "chart")


def _estimated(usual: LevelSkills, results: Results, places: tuple[Ints, Ints]) -> LevelSkills:
    """Return the strengths of the levels, and the spread inside them, by a league's results."""
    from scipy.optimize import minimize_scalar

    season = _Season(usual, results, places)
    low, high = np.log([NARROWEST, WIDEST])
    best: Any = minimize_scalar(
        lambda log_spread: -season.at(np.exp(log_spread))[0],
        bounds=(low, high),
        method="bounded",
        options={"xatol": 0.05},
    )
    spread = float(np.exp(best.x)) if best.x > low + 0.1 else 0.0
    _, points, covariance = season.at(max(spread, NARROWEST))
    gaps = points[:, None] - points
    own = np.diag(covariance)
    errors = np.sqrt(np.maximum(own[:, None] + own - 2.0 * covariance, 0.0))
    return LevelSkills(
        usual.chart,
        gaps,
        errors,
        points - points[0],
        np.sqrt((errors**2).mean(axis=1) / 2.0),
        spread,
        "results",
        len(results),
    )


class _Season:
    """A league's games between players of some levels, and the likelihood of a spread."""

    def __init__(self, usual: LevelSkills, results: Results, places: tuple[Ints, Ints]) -> None:
        sides = results.player_a, results.player_b
        who, code = np.unique(np.concatenate(sides), return_inverse=True)
        a, b = np.split(code.ravel(), 2)
        rows, self._levels = np.arange(len(results)), len(usual.levels)
        columns = np.concatenate([*places, self._levels + a, self._levels + b])
        signs = np.repeat([1.0, -1.0, 1.0, -1.0], len(rows))
        shape = len(rows), self._levels + len(who)
        self._contrast = sparse.csr_matrix((signs, (np.tile(rows, 4), columns)), shape=shape)
        self._won = results.score_a.astype(float)
        self._played = self._won + results.score_b
        self._mean = np.concatenate([usual.points, np.zeros(len(who))]) / FARGO.points_per_log_odds
        self._at = self._mean

    def at(self, spread: float) -> tuple[float, Floats, Floats]:
        """Return the log-likelihood of a spread, the levels' points and their covariance."""
        unit = FARGO.points_per_log_odds
        weight = np.full(len(self._mean), (unit / spread) ** 2)
        weight[: self._levels] = (unit / PRIOR_SD) ** 2
        for _ in range(_MOST_STEPS):
            step = splu(self._curvature(weight)).solve(self._slope(weight))
            while self._value(self._at + step, weight) < self._value(self._at, weight) - _TINY:
                step /= 2.0
            self._at = self._at + step
            if np.abs(step).max() < _TINY:
                break
        curvature = splu(self._curvature(weight))
        log_determinant = np.log(np.abs(curvature.U.diagonal())).sum()
        value = self._value(self._at, weight) + (np.log(weight).sum() - log_determinant) / 2.0
        inverse = curvature.solve(np.eye(len(weight), self._levels))
        return (
            float(value),
            self._at[: self._levels] * unit,
            inverse[: self._levels] * unit**2,
        )

    def _value(self, at: Floats, weight: Floats) -> float:
        odds = self._contrast @ at
        value = self._won @ odds - self._played @ np.logaddexp(0.0, odds)
        return float(value - weight @ (at - self._mean) ** 2 / 2.0)

    def _slope(self, weight: Floats) -> Floats:
        left = self._won - self._played * expit(self._contrast @ self._at)
        return np.asarray(self._contrast.T @ left - weight * (self._at - self._mean))

    def _curvature(self, weight: Floats) -> sparse.csc_matrix:
        p = expit(self._contrast @ self._at)
        of_games = self._contrast.multiply((self._played * p * (1.0 - p))[:, None])
        return sparse.csc_matrix(self._contrast.T @ of_games + sparse.diags(weight))
