"""The best chart for a scale: which race for each difference of ratings, under limits.

All races that the limits allow are put in the order of the differences at which they are
even, the hardest for the stronger player last. A chart is a path through them that never
steps back as the difference grows. Each whole-point difference costs what the race there
misses the target by, so the best path follows by dynamic programming over the differences:

    best(d, r) = cost(d, r) + min over races r' no harder than r of best(d - 1, r')
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.checks import number_probability, one_of, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.chart import Chart, ChartRow
from evenbreak.handicaps.chart_paths import cheapest_within, without_the_worst
from evenbreak.handicaps.play import Play, play_of
from evenbreak.handicaps.race_limits import RaceLimits

__all__ = ["design", "nearest_chart"]

Floats = NDArray[np.float64]

_TIE = 1e-12
_MOST_CELLS = 5_000_000
_MOST_ONE_BY_ONE = 400
_HEAVIEST = 1e6
"""The weight that stands for 'never, unless no allowed race does better'."""


def design(
    play: Any,
    limits: RaceLimits,
    *,
    target: float = 0.5,
    tilt: float = 0.5,
    criterion: str = "mean",
    up_to: int | None = None,
    mean_games: float | None = None,
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
    target, tilt = number_probability(target, "target"), number_probability(tilt, "tilt")
    criterion = one_of(criterion, "criterion", ("mean", "worst"))
    races = _Races.of(play_of(play), limits, up_to)
    cost = races.cost(target, tilt)
    budget = math.inf if mean_games is None else _above_0(mean_games, "mean_games")
    length = races.mean_games() if budget < math.inf else np.zeros_like(cost)
    length = np.where(np.isfinite(cost), length, np.inf)
    if criterion == "worst":
        cost = without_the_worst(cost, length, races.evens, budget)
    return races.chart(cheapest_within(cost, length, races.evens, budget), name)


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
    races = _Races.of(play_of(play), limits, up_to)
    cost = races.cost(0.5, 0.5)
    cost[: races.evens - 1] = np.inf
    return races.chart(cost.argmin(axis=0), name)


@dataclass(frozen=True)
class _Races:
    """All races that may be in a chart, the easiest for the stronger player first.

    The first `evens` of them are even races, the shorter first; of the others each is even
    at a larger difference than the one before.
    """

    play: Play
    m: NDArray[np.int64]
    n: NDArray[np.int64]
    evens: int
    points: NDArray[np.int64]
    allowed: NDArray[np.bool_]

    @classmethod
    def of(cls, play: Play, limits: RaceLimits, up_to: int | None) -> _Races:
        """Return the races that the limits allow, or refuse what would take too long."""
        m, n = np.array(limits.races).T
        if not play.is_plain and m.size > _MOST_ONE_BY_ONE:
            raise InputError(
                f"games is {limits.games!r}, which makes {m.size} races; won by more than 1 or "
                f"with a break that counts, {_MOST_ONE_BY_ONE} are the most: narrow games"
            )
        even = play.even_differences(m, n)
        last = (
            max(math.floor(even.max() + _TIE), 1)
            if up_to is None
            else whole(up_to, "up_to", at_least=1)
        )
        if m.size * (last + 1) > _MOST_CELLS:
            raise InputError(
                f"{m.size} races at {last + 1} differences are too many to go through; narrow "
                "games, raise the fewest games of the weaker player, or lower up_to"
            )
        order = np.lexsort((m + n, np.where(m == n, -np.inf, even)))
        m, n, points = m[order], n[order], np.arange(last + 1)
        allowed = np.ones((m.size, points.size), dtype=bool)
        if limits.games_p90 is not None:
            allowed = play.ends_within(m, n, points, limits.games_p90) >= 0.9 - _TIE
            if not allowed.any(axis=0).all():
                nowhere = int(points[~allowed.any(axis=0)][0])
                raise InputError(
                    f"games_p90 is {limits.games_p90}, and at a difference of {nowhere} no "
                    "allowed race ends within so many games in 9 of 10 matches; give more, or "
                    "allow shorter races"
                )
        return cls(play, m, n, int((m == n).sum()), points, allowed)

    def cost(self, target: float, tilt: float) -> Floats:
        """Return what each race costs at each difference, shape (races, differences)."""
        above = self.play.win(self.m, self.n, self.points) - target
        weights = (min(0.5 / one, _HEAVIEST) if one else _HEAVIEST for one in (1.0 - tilt, tilt))
        over, under = weights
        cost = np.where(above > 0.0, over * above, under * np.maximum(-above - _TIE, 0.0))
        cost[:, 0] = np.where(np.arange(self.m.size) < self.evens, 0.0, np.inf)
        return np.where(self.allowed, cost, np.inf)

    def mean_games(self) -> Floats:
        """Return the mean length of each race at each difference, in games."""
        return self.play.mean_games(self.m, self.n, self.points)

    def chart(self, path: NDArray[np.int64], name: str) -> Chart:
        """Return the chart that has at each difference the race of this place."""
        places = [(place, len(list(run))) for place, run in groupby(path.tolist())]
        rows, start = [], 0
        for k, (place, count) in enumerate(places):
            end = None if k == len(places) - 1 else start + count - 1
            rows.append(ChartRow(start, end, int(self.m[place]), int(self.n[place])))
            start += count
        return Chart(name, rows)


def _above_0(value: Any, name: str) -> float:
    if not (isinstance(value, int | float) and 0.0 < value < math.inf):
        raise InputError(f"{name} is {value!r}; give a number above 0")
    return float(value)
