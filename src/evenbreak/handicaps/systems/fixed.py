"""Matches of one length: a point a match, on a chart whose races all last as many games."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from evenbreak.handicaps.charts.design import fixed_length_chart
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.npl import NPL


def fixed_length_system(games: Any = 9) -> StepSystem:
    """Return the National Pool League's system with races that all have the same longest length.

    The rule is the same, for newcomers too; only the chart differs: `fixed_length_chart(games)`.

    Parameters
    ----------
    games
        the most games that a match may last, an odd whole number up to 999.

    Raises
    ------
    InputError
        if it is not such a number.

    >>> fixed_length_system(7).usual_chart().race(12)
    (5, 3)
    """
    chart = fixed_length_chart(games, NPL.scale)
    longest = sum(chart.race(0)) - 1
    return replace(NPL, name=f"fixed {longest}", charts=(), own_chart=chart)
