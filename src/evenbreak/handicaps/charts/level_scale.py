"""Where the skill levels of a chart lie in strength, measured in levels.

A chart by skill level does not say how much stronger one level is than the next. The audit finds
the strengths that make its races as even as possible; here they are stretched to run from the
lowest level to the highest, so that one unit is an average step from level to level.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import floats
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.level_audit import audit_levels
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.ratings.scale import Scale


@dataclass(frozen=True)
class LevelScale:
    """How strong a player of each level is taken to be; `level_scale` makes it.

    Parameters
    ----------
    chart
        the name of the chart.
    levels, strengths
        the levels, and the strength of an average player of each; the lowest and the highest
        level are as strong as their numbers.
    scale
        how many average steps from level to level double the odds of winning a game.
    """

    chart: str
    levels: tuple[int, ...]
    strengths: tuple[float, ...]
    scale: Scale

    @property
    def odds_of_a_level(self) -> float:
        """By how much an average step from one level to the next multiplies the odds of a game."""
        return float(2.0 ** (1.0 / self.scale.points_per_doubling))

    def strength(self, levels: ArrayLike) -> Floats:
        """Return the strength of players of these levels, on straight lines between levels."""
        return np.interp(floats(levels, "levels"), self.levels, self.strengths)


def level_scale(chart: LevelChart | str) -> LevelScale:
    """Return where the levels of a chart lie, so that its races are as even as possible.

    Raises
    ------
    InputError
        if there is no such chart, or its races do not set the levels apart.

    >>> levels = level_scale("apa_8ball")
    >>> levels.strength([2, 3, 4, 5, 6, 7]).round(2)
    array([2.  , 2.99, 4.27, 5.33, 6.13, 7.  ])
    >>> round(levels.odds_of_a_level, 2)
    1.36
    """
    report = audit_levels(chart, scale="npl")
    ratings, levels = np.array(report.ratings), report.levels
    if ratings[-1] <= 0.0:
        raise InputError(
            f"chart {report.name!r} has the same races for its lowest and its highest level, so "
            "it does not say how far its levels lie apart; give a scale"
        )
    of_a_level = ratings[-1] / (levels[-1] - levels[0])
    return LevelScale(
        report.name,
        levels,
        tuple((levels[0] + ratings / of_a_level).tolist()),
        Scale(f"{report.name} levels", report.scale.points_per_doubling / of_a_level),
    )
