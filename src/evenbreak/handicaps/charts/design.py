"""The best chart for a scale: which race for each difference of ratings, under limits.

All races that the limits allow are put in the order of the differences at which they are
even, the hardest for the stronger player last. A chart is a path through them that never
steps back as the difference grows. Each whole-point difference costs what the race there
misses the target by, so the best path follows by dynamic programming over the differences:

    best(d, r) = cost(d, r) + min over races r' no harder than r of best(d - 1, r')

A limit on the rows is kept by a best total for each number of rows so far.
"""

from __future__ import annotations

from typing import Any

from evenbreak.handicaps.charts.candidates import Candidates
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.match_rules import play_of
from evenbreak.handicaps.charts.race_limits import RaceLimits


def design(
    play: Any,
    limits: RaceLimits,
    *,
    target: float = 0.5,
    tilt: float = 0.5,
    criterion: str = "mean",
    up_to: int | None = None,
    mean_games: float | None = None,
    rows: int | None = None,
    name: str = "design",
) -> Chart:
    """Return the fairest chart for a scale among all that the limits allow.

    Parameters
    ----------
    play
        what ratings mean: 'npl', 'fargo', 'elo', a `Scale` or the points that double the
        odds; or a `Play`, which also says by how much a race is won and who breaks.
    limits
        which races it may hold.
    target
        the chance that the stronger player should have.
    tilt
        where in its band a race should meet the target: 1/2 in its middle, 0 where the band
        begins (the stronger never has less, if an allowed race makes that so), 1 where it
        ends (he never has more). Chances above the target cost 1 / (2 - 2 tilt), those
        below cost 1 / (2 tilt) of what they miss it by, so 1 each at 1/2.
    criterion
        'mean': the least mean cost over the whole-point differences from 0 to `up_to`;
        'worst': the least largest cost, and of all such charts that of the least mean.
    up_to
        the last difference that counts; None for that at which the hardest allowed race is
        even (W = 1/2).
    mean_games
        the most that the mean length over those differences may be, in games. The chart is
        then the fairest of all no longer than itself, which may be shorter than this.
    rows
        the most rows it may have; None for any number. With a limit the chart is the best of
        all charts of no more rows.
    name
        what the chart is called.

    Returns
    -------
    Chart
        each race is harder for the stronger player than the one before (it is even at a
        larger difference).

    Raises
    ------
    InputError
        if a parameter has a value that it cannot have, no chart keeps the limits, or there
        are too many races and differences to go through.

    Notes
    -----
    Source: the rule before Table 5.6 and P5.5, here over all differences at once.

    >>> from evenbreak.handicaps import RaceLimits
    >>> chart = design("npl", RaceLimits((5, 7), weaker_least=2), up_to=40)
    >>> [(row.difference_from, *row[2:]) for row in chart.rows]
    [(0, 3, 3), (8, 4, 3), (20, 5, 3), (29, 4, 2), (40, 5, 2)]
    """
    candidates = Candidates(play_of(play), limits, up_to)
    return candidates.fairest(
        target=target,
        tilt=tilt,
        criterion=criterion,
        mean_games=mean_games,
        rows=rows,
        name=name,
    )


def nearest_chart(
    play: Any, limits: RaceLimits, *, up_to: int | None = None, name: str = "nearest"
) -> Chart:
    """Return the chart that gives each difference the race with W nearest 1/2.

    Equal players play the longest even race, and no other even race comes into the chart;
    apart from that each difference is looked at by itself, so it may step back to an easier
    race as the difference grows. Beyond `up_to` the last race stays.

    Parameters
    ----------
    play, limits, up_to, name
        as `design` takes them.

    Notes
    -----
    Source: P5.5 and the rule before Table 5.6. The charts of the National Pool League are
    those of games=(N - 3, N - 1) and weaker_least=2, nearly row by row.

    >>> chart = nearest_chart("npl", RaceLimits((5, 7), weaker_least=2), up_to=49)
    >>> [(row.difference_from, *row[2:]) for row in chart.rows]
    [(0, 4, 4), (7, 4, 3), (20, 5, 3), (29, 4, 2), (40, 5, 2), (49, 6, 2)]
    """
    return Candidates(play_of(play), limits, up_to).nearest(name)
