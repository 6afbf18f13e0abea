"""The fairest chart for a scale: which race for each rating difference, within limits.

All allowed races are ordered by the difference at which they are even, so the hardest for the
stronger player comes last. A chart is a path through them that never steps back as the
difference grows. The cost at each whole-point difference is the distance of its race from the
target, so dynamic programming over the differences finds the best path:

    best(d, r) = cost(d, r) + min over races r' no harder than r of best(d - 1, r')

To limit the number of rows, the best total is kept for each number of rows so far.
"""

from __future__ import annotations

from typing import Any

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.candidates import Candidates, SimilarLengths
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.fair import RaceLimits
from evenbreak.ratings.scale import DEFAULT_SCALE, scale_of


def design(
    scale: Any,
    limits: RaceLimits,
    *,
    target: float = 0.5,
    tilt: float = 0.5,
    up_to: int | None = None,
    rows: int | None = None,
    spread: int | None = None,
    name: str = "design",
) -> Chart:
    """Return the fairest chart for a scale, among all charts within limits.

    Parameters
    ----------
    scale
        the scale of the ratings: 'npl', 'fargo', 'elo', a `Scale` or the points that double the
        odds.
    limits
        the races that the chart may hold.
    target
        the chance that the stronger player should have.
    tilt
        where in its band a race should meet the target: 1/2 in the middle, 0 at the start (the
        stronger player's chance is never smaller, if an allowed race makes that possible), 1 at the
        end (it is never larger). Each point of chance above the target costs 1 / (2 - 2 tilt), and
        each point below it costs 1 / (2 tilt); both are 1 at tilt 1/2.
    up_to
        the last difference that counts; None: the difference at which the hardest allowed race is
        even (W = 1/2). The mean cost over the whole-point differences from 0 to this one is
        minimized.
    rows
        the largest number of rows; None: any number.
    spread
        how much the longest matches of the chart's races may differ, in games; None: any length
        within the limits. Printed charts have a spread of 2.

    Returns
    -------
    Chart
        each race is harder for the stronger player than the one before (it is even at a
        larger difference).

    Raises
    ------
    InputError
        if a parameter is out of range, no chart satisfies the limits, or there are too many races
        and differences to try.

    Notes
    -----
    Source: the rule before Table 5.6 and P5.5, applied to all differences at once.

    >>> from evenbreak.handicaps import RaceLimits
    >>> chart = design("npl", RaceLimits((5, 7), weaker_least=2), up_to=40)
    >>> [(row.difference_from, *row[2:]) for row in chart.rows]
    [(0, 3, 3), (8, 4, 3), (20, 5, 3), (29, 4, 2), (40, 5, 2)]
    """
    return races_to_try(scale, limits, spread, up_to).fairest(
        target=target, tilt=tilt, rows=rows, name=name
    )


def races_to_try(
    scale: Any, limits: RaceLimits, spread: int | None, up_to: int | None
) -> Candidates | SimilarLengths:
    """Return the races that a design tries, all together or in groups of similar length."""
    low, high = limits.games
    if spread is None or high - low <= whole(spread, "spread"):
        return Candidates(scale_of(scale), limits, up_to)
    return SimilarLengths(scale_of(scale), limits, spread, up_to)


def nearest_chart(
    scale: Any, limits: RaceLimits, *, up_to: int | None = None, name: str = "nearest"
) -> Chart:
    """Return the chart that has, at each difference, the race with W closest to 1/2.

    Equal players play the longest even race, and the chart has no other even race. Apart from that,
    each difference is treated separately, so the chart may step back to an easier race as the
    difference grows. Beyond `up_to`, the last race is kept.

    Parameters
    ----------
    scale, limits, up_to, name
        as for `design`.

    Notes
    -----
    Source: P5.5 and the rule before Table 5.6. With games=(N - 3, N - 1) and weaker_least=2 it
    gives the charts of the National Pool League, nearly row by row.

    >>> chart = nearest_chart("npl", RaceLimits((5, 7), weaker_least=2), up_to=49)
    >>> [(row.difference_from, *row[2:]) for row in chart.rows]
    [(0, 4, 4), (7, 4, 3), (20, 5, 3), (29, 4, 2), (40, 5, 2), (49, 6, 2)]
    """
    return Candidates(scale_of(scale), limits, up_to).nearest(name)


# Charts of races of one length: every match can last equally many games.


_LONGEST = 999


def fixed_length_chart(games: Any, scale: Any = DEFAULT_SCALE) -> Chart:
    """Return the chart whose races all last at most a given number of games.

    At each difference, it has the race m:n with m + n - 1 = games that is closest to even. The
    chart ends with the race in which the weaker player needs one game. For nine games, its name is
    'fixed_9'.

    Parameters
    ----------
    games
        the most games in a match, an odd whole number up to 999. An even number would leave no even
        race for equal players.
    scale
        the scale of the differences: 'npl', 'fargo', 'elo', a `Scale`, or the points that double
        the odds.

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
            "{games} is {longest}, which leaves no even race for equal players. Give "
            "{fewer} or {more}.",
            longest=longest,
            fewer=longest - 1,
            more=longest + 1,
        )
    return nearest_chart(scale, RaceLimits((longest, longest)), name=f"fixed_{longest}")
