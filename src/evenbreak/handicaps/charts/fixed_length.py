"""Charts of races of one length: every match can last equally many games."""

from __future__ import annotations

from typing import Any

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.design import nearest_chart
from evenbreak.handicaps.charts.race_limits import RaceLimits
from evenbreak.ratings.unstated_scale import DEFAULT_SCALE

_LONGEST = 999


def fixed_length_chart(games: Any, scale: Any = DEFAULT_SCALE) -> Chart:
    """Return the chart whose races all last at most a given number of games.

    At each difference it has the race m:n with m + n - 1 = games that is nearest to even. The
    chart ends with the race in which the weaker player needs one game. For nine games it is
    named 'fixed_9'.

    Parameters
    ----------
    games
        the most games of a match, an odd whole number up to 999. An even number would leave
        no even race for equal players.
    scale
        what differences mean: 'npl', 'fargo', 'elo', a `Scale`, or the points that double the
        odds.

    Raises
    ------
    InputError
        if games is not such a number, or the scale is unknown.

    Notes
    -----
    Source: the rule before Table 5.6, for a single sum m + n.

    >>> chart = fixed_length_chart(5)
    >>> [(row.difference_from, *row[2:]) for row in chart.rows]
    [(0, 3, 3), (17, 4, 2), (56, 5, 1)]
    """
    longest = whole(games, "games", at_least=1, at_most=_LONGEST)
    if longest % 2 == 0:
        raise InputError(
            f"games is {longest}, which leaves no even race for equal players; give "
            f"{longest - 1} or {longest + 1}"
        )
    return nearest_chart(scale, RaceLimits((longest, longest)), name=f"fixed_{longest}")
