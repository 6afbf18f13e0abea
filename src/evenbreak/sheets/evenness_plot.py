"""The small plot on the sheet's page: how even the races are, by rating difference."""

from collections.abc import Sequence
from typing import NamedTuple

from evenbreak.answers.league.pairs import Band, SurePair
from evenbreak.handicaps.charts.given_ratings import win_given_ratings
from evenbreak.ratings.scale import Scale
from evenbreak.sheets.rating_bars import Tick, round_numbers

WIDTH, HEIGHT = 360, 230
_LEFT, _RIGHT, _TOP, _BOTTOM = 40, 350, 12, 188
_STEPS = 12
_NAME = 26
"""A band narrower than this has no room for the name of its race."""


class Plot(NamedTuple):
    """The plot in units of its own box, 360 wide and 230 high.

    Attributes
    ----------
    curves
        the stronger player's chance over each band of the chart, as points of a polyline.
    names
        the race of each band that has room for it: x, y and the race.
    dots
        the pairs.
    x, y
        the marks on the axes.
    """

    curves: Sequence[str]
    names: Sequence[tuple[float, float, str]]
    dots: Sequence[tuple[float, float]]
    x: Sequence[Tick]
    y: Sequence[Tick]
    left: int = _LEFT
    right: int = _RIGHT
    top: int = _TOP
    bottom: int = _BOTTOM


def evenness_plot(
    bands: Sequence[Band],
    pairs: Sequence[SurePair],
    scale: Scale,
    error: float = 0.0,
    form: float = 0.0,
) -> Plot:
    """Return P(the stronger wins) against the rating difference: the chart, and each pair.

    `error` is the standard error of a difference over which the chart's chances are averaged, and
    `form` how much the log-odds of a game vary from match to match.
    """
    chances = [p for band in bands for p in (band.p_first, band.p_after)]
    chances += [pair.p_win for pair in pairs]
    away = max(0.2, *(abs(p - 0.5) for p in chances)) + 0.02
    furthest = max([band.after for band in bands] + [pair.difference for pair in pairs]) or 1.0

    def x(points: float) -> float:
        return round(_LEFT + (_RIGHT - _LEFT) * points / furthest, 2)

    def y(p: float) -> float:
        return round(_BOTTOM - (_BOTTOM - _TOP) * (p - 0.5 + away) / (2 * away), 2)

    curves, names = [], []
    for band in bands:
        places = [band.first + (band.after - band.first) * k / _STEPS for k in range(_STEPS + 1)]
        race = band.stronger, band.weaker
        curve = win_given_ratings(places, error, *race, scale=scale, form=form)
        points = zip(places, curve.tolist(), strict=True)
        curves.append(" ".join(f"{x(d):g},{y(p):g}" for d, p in points))
        if x(band.after) - x(band.first) >= _NAME:
            middle = (x(band.first) + x(band.after)) / 2
            names.append((round(middle, 2), _BOTTOM - 6.0, f"{band.stronger}:{band.weaker}"))
    across = round_numbers(0.0, furthest, most=6, steps=[1, 2, 5, 10])
    up = round_numbers(0.5 - away, 0.5 + away, most=5, steps=[1, 2, 5, 10])
    return Plot(
        curves,
        names,
        [(x(pair.difference), y(pair.p_win)) for pair in pairs],
        [Tick(x(d), f"{d:g}") for d in across if 0 <= d <= furthest],
        [Tick(y(p), f"{p:.1f}") for p in up if abs(p - 0.5) <= away],
    )
