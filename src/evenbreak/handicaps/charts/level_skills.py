"""The strength of a chart's skill levels, and the higher level's chance of winning a game.

A chart by skill level does not state the value of a level. Three sources do, best first:

- The league's own results (`level_estimates`).
- Measured results of many leagues with the same chart: `MEASURED`.
- The chart itself: the strengths that make its races as even as possible (`audit_levels`). That is
  an assumption, not a measurement.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.handicaps.charts.chart_of import level_chart_of
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.handicaps.charts.level_audit import audit_levels
from evenbreak.handicaps.charts.level_chart import LevelChart, level_chart
from evenbreak.handicaps.charts.played_chart import level_numbers_of
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.words import Sentence, say

FARGO = SCALES["fargo"]

FEWEST = 100
"""Matches between different levels needed to use a league's own results."""

MOST = 10_000
"""The most matches used, counted from the last; more would add nothing that matters."""

MEASURED = {
    "apa_8ball": (
        (0.666,),
        (0.781, 0.632),
        (0.847, 0.721, 0.594),
        (0.903, 0.812, 0.689, 0.609),
        (0.908, 0.885, 0.811, 0.708, 0.625),
    )
}
"""P(the higher level wins a game), by the higher level from the second up, then by the lower one.

APA 8-ball: one chance for each pair was fitted to a public table of the mean match points in some
40,000 matches in one region (2025), under the chart and the split of three points (3-0 for a
shutout, 2-1 if the loser was on the hill, else 2-0). All 30 means then agree to within .021 points.
The chances are means over the players at two levels, so there is no spread left to average over.
"""


Source: TypeAlias = Literal["results", "measured", "chart"]
"""Where the strength of levels comes from."""


@own_arrays
@dataclass(frozen=True, eq=False)
class LevelSkills:
    """Strength of a chart's levels, on the Fargo scale (100 points double the odds).

    Parameters
    ----------
    gaps, errors
        `gaps[i, j]`: how much stronger `levels[i]` is than `levels[j]`, in points, and its standard
        error; NaN if the error is unknown.
    points, standard_error
        the strengths that fit the gaps best by least squares, 0 for the lowest level, and their
        standard errors, two of which combine as if independent; only differences have a meaning.
    spread
        how far players at one level differ from its middle (standard deviation), in points; 0 if
        unknown.
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
    source: Source
    matches: int = 0

    def __repr__(self) -> str:
        return f"<LevelSkills of {self.chart.name}: {self.source}>"

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
        """Whether the uncertainty of the gaps is known."""
        return self.source != "chart"

    def difference(self, level_1: ArrayLike, level_2: ArrayLike) -> Any:
        """Return how many points stronger level 1 is, elementwise."""
        return self.gaps[self.places(level_1), self.places(level_2)]

    def error(self, level_1: ArrayLike, level_2: ArrayLike) -> Any:
        """Return the uncertainty of `points` for two players at these levels; 0 if unknown.

        It combines the standard error of the difference and the spread of players within a level.
        """
        known = np.nan_to_num(self.errors[self.places(level_1), self.places(level_2)])
        return np.hypot(known, np.sqrt(2.0) * self.spread)

    def chance(self, level_1: ArrayLike, level_2: ArrayLike) -> Any:
        """Return P(a player in the middle of level 1 beats one in the middle of level 2 in a game).

        >>> level_skills("apa_8ball").chance(5, [3, 4, 5]).round(3)
        array([0.721, 0.594, 0.5  ])
        """
        return FARGO.win_probability(self.difference(level_1, level_2))

    def gap(self, level_1: ArrayLike, level_2: ArrayLike, form: float = 0.0) -> Gap:
        """Return the gap between players at these levels, which determines all their chances.

        >>> round(float(level_skills("apa_8ball").gap(7, 5).win(5, 3)), 2)
        0.66
        """
        return Gap(self.difference(level_1, level_2), self.error(level_1, level_2), FARGO, form)

    def strength(self, levels: ArrayLike) -> Floats:
        """Return the points of players at these levels; NaN for other levels."""
        array = np.asarray(levels, dtype=np.float64)
        points, known = np.full(array.shape, np.nan), np.isin(array, self.levels)
        points[known] = self.points[self.places(array[known])]
        return points

    def places(self, levels: ArrayLike) -> Ints:
        """Return the positions of levels in `levels`.

        Raises
        ------
        InputError
            if the chart has no such level.
        """
        return self.chart.places(levels, "levels")

    @property
    def why(self) -> Sentence:
        """What the chances are based on, in a sentence."""
        if self.source == "results":
            return say(
                "The chance of winning a game comes from the skill levels, based on {matches:,} "
                "matches in your own results ({error}).",
                matches=self.matches,
                error=self._off,
            )
        if self.source == "measured":
            return say(
                "The chance of winning a game comes from the skill levels, based on about "
                "40,000 matches in other leagues that use this chart ({error}).",
                error=self._off,
            )
        return say(
            "The chance of winning a game is assumed, not measured: the races in {chart} are "
            "taken to make up for the difference between levels.",
            chart=self.chart.name,
        )

    @property
    def _off(self) -> Sentence:
        off = float(np.median(self.errors[np.triu_indices(len(self.levels), 1)]))
        return say("\N{PLUS-MINUS SIGN} {points:.0f} Fargo points between two levels", points=off)


def level_skills(chart: LevelChart | str, results: Results | None = None) -> LevelSkills:
    """Return the strength of a chart's levels, from the best available source.

    Parameters
    ----------
    chart
        the chart, or its name in `LEVEL_CHARTS`.
    results
        the league's own results with `level_a` and `level_b`; used if at least `FEWEST` matches are
        between different levels.

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
    check_results(results)
    level_a, level_b = level_numbers_of(results)
    rows = results.counted & (results.score_a + results.score_b > 0)
    rows &= np.isin(level_a, chart.levels) & np.isin(level_b, chart.levels)
    if (level_a[rows] != level_b[rows]).sum() < FEWEST:
        return usual
    used = np.flatnonzero(rows)[-MOST:]
    places = usual.places(level_a[used]), usual.places(level_b[used])
    from evenbreak.handicaps.charts.level_estimates import estimated_levels

    points, covariance, spread = estimated_levels(usual.points, results.select(used), places)
    own = np.diag(covariance)
    errors = np.sqrt(np.maximum(own[:, None] + own - 2.0 * covariance, 0.0))
    each = np.sqrt((errors**2).mean(axis=1) / 2.0)
    gaps = points[:, None] - points
    return LevelSkills(chart, gaps, errors, points - points[0], each, spread, "results", len(used))


def _measured(chart: LevelChart) -> LevelSkills | None:
    """Return what was measured elsewhere; None if there is nothing for these levels and races."""
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
    """Return the strengths that make a chart's races as even as possible."""
    points = np.array(audit_levels(chart, scale=FARGO).ratings)
    gaps, own = points[:, None] - points, np.full(len(points), np.nan)
    return LevelSkills(chart, gaps, np.full(gaps.shape, np.nan), points, own, 0.0, "chart")
