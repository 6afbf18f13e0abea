"""What both sheets show: races in blocks of columns, ratings with bars, how even the races are."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import matplotlib as mpl
import pandas as pd
from matplotlib.ticker import MaxNLocator

from evenbreak.answers.kit.scales import decimals_of
from evenbreak.answers.league.sheet import NO_RACE, Band, SurePair, places_in_list
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.ratings.scale import Scale

NOT_OVER_THE_EDGE = (4, 96)
"""A label closer than this to an end of the axis would extend beyond it."""


class PlayerLine(NamedTuple):
    """A player's rating, and a bar of two standard errors either way, in percent of the axis.

    A provisional rating has ~ in front, and its place has P. An error that isn't stated is empty;
    counts that aren't stated are None.
    """

    place: str
    name: str
    rating: str
    error: str
    games: int | None
    won: int | None
    lost: int | None
    group: int | None
    low: float
    middle: float
    high: float


class Tick(NamedTuple):
    """A mark on an axis, at a percentage of its length."""

    at: float
    label: str


class Bars:
    """The axis shared by the bars of some ratings; standard errors not stated are NaN."""

    def __init__(self, rated: pd.DataFrame) -> None:
        error = rated["standard_error"].fillna(0.0)
        low = float((rated["rating"] - 2 * error).min())
        high = float((rated["rating"] + 2 * error).max())
        edge = 0.04 * (high - low) or 1.0
        self.low, self.high = low - edge, high + edge

    def place(self, rating: float) -> float:
        """Return a rating's position, in percent."""
        return round(100 * (rating - self.low) / (self.high - self.low), 2)

    def ticks(self) -> list[Tick]:
        """Return the marks on the axis."""
        marks = round_numbers(self.low, self.high, most=6, steps=[1, 2, 2.5, 5, 10])
        ticks = [Tick(self.place(tick), f"{tick:g}") for tick in marks]
        least, most = NOT_OVER_THE_EDGE
        return [tick for tick in ticks if least < tick.at < most]


def round_numbers(low: float, high: float, *, most: int, steps: list[float]) -> list[float]:
    """Return the round numbers that mark an axis, about `most` of them.

    >>> round_numbers(0.0, 100.0, most=5, steps=[1, 2, 5, 10])
    [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]
    """
    with mpl.rc_context({"axes.autolimit_mode": "data"}):  # whatever the reader's own settings
        return list(map(float, MaxNLocator(nbins=most, steps=steps).tick_values(low, high)))


def player_lines(
    rated: pd.DataFrame,
    scale: Scale,
    bars: Bars,
    *,
    grouped: bool,
    places: Sequence[str] | None = None,
) -> list[PlayerLine]:
    """Return the lines of a ratings list, in order.

    `rated` has the columns player, rating, standard_error (NaN: not stated), games (below 0: not
    stated), component (0: not stated) and provisional; perhaps won and lost. `grouped` shows a
    player's group; `places` are the places in a longer list, by row.
    """
    places = places_in_list(rated["provisional"]) if places is None else places
    # Ratings in whole points are shown as the league knows them.
    whole = bool((rated["rating"] % 1 == 0).all())
    decimals = decimals_of(scale)
    rows: Any = rated.itertuples(index=True)
    lines = []
    for row in rows:
        unknown = math.isnan(row.standard_error)
        reach = 0.0 if unknown else 2 * row.standard_error
        lines.append(
            PlayerLine(
                places[row.Index],
                row.player,
                f"{'~' if row.provisional else ''}{row.rating:.{0 if whole else decimals}f}",
                "" if unknown else f"{row.standard_error:.{decimals}f}",
                row.games if row.games >= 0 else None,
                getattr(row, "won", None),
                getattr(row, "lost", None),
                row.component if grouped else None,
                *(bars.place(row.rating + away) for away in (-reach, 0.0, reach)),
            )
        )
    return lines


WIDTH, HEIGHT = 360, 230
_LEFT, _RIGHT, _TOP, _BOTTOM = 40, 350, 12, 188
_STEPS = 12
_NAME = 26
"""A band narrower than this has no room for its race's name."""


class Plot(NamedTuple):
    """The plot in units of its own box, 360 wide and 230 high.

    `curves` are the stronger player's chance over each band of the chart, as points of a polyline;
    `names` has the races of bands that are wide enough, with x and y.
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


def evenness_plot(bands: Sequence[Band], pairs: Sequence[SurePair], typical: Gap) -> Plot:
    """Return P(the stronger wins) by rating difference: the chart's, and each pair's.

    The chart's chances are for a pair as well known as the `typical` one.
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
        curve = typical.at(places).win(band.stronger, band.weaker)
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


Races = Mapping[tuple[str, str], str]
"""The race between each two players, from the first player's side."""

_ROOM, _FIGURE, _EDGE = 144.0, 1.5, 2.2
"""In millimeters: for a printed table's columns, for a digit in it, and around a race."""


class Block(NamedTuple):
    """The columns of the table of races, and each player's races in them; None against oneself."""

    across: Sequence[PlayerLine]
    rows: Sequence[tuple[PlayerLine, Sequence[str | None]]]


class RaceCard(NamedTuple):
    """One player's opponents, each with the race and the player's chance of winning it."""

    player: PlayerLine
    races: Sequence[tuple[PlayerLine, str, str]]


def race_blocks(lines: Sequence[PlayerLine], races: Races, most: int | None = None) -> list[Block]:
    """Return the table of races in blocks of columns, all of nearly the same size.

    `most` is how many columns fit; None: as many as fit on a printed web page.
    """
    if most is None:
        widest = max(map(len, races.values()), default=3)
        most = int(_ROOM / (_FIGURE * (widest - 0.5) + _EDGE))  # a colon is half a figure wide
    return [
        Block(
            across,
            [
                (
                    line,
                    [
                        _race(races, line, opponent) if line != opponent else None
                        for opponent in across
                    ],
                )
                for line in lines
            ],
        )
        for across in parts_of(lines, most)
    ]


def parts_of(lines: Sequence[PlayerLine], most: int) -> list[Sequence[PlayerLine]]:
    """Return a list divided as equally as possible into parts of at most this many lines."""
    size = math.ceil(len(lines) / math.ceil(len(lines) / most))
    return [lines[first : first + size] for first in range(0, len(lines), size)]


def _race(races: Races, player: PlayerLine, opponent: PlayerLine) -> str:
    return races.get((player.name, opponent.name), NO_RACE)


def race_cards(lines: Sequence[PlayerLine], races: Races, paired: pd.DataFrame) -> list[RaceCard]:
    """Return each player's races, for a page too narrow for the table of races."""
    chances: dict[tuple[str, str], str] = {}
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        chances[pair.player_a, pair.player_b] = f"{pair.p_win_a:.2f}"
        chances[pair.player_b, pair.player_a] = f"{1.0 - pair.p_win_a:.2f}"
    return [
        RaceCard(
            line,
            [
                (
                    opponent,
                    _race(races, line, opponent),
                    chances.get((line.name, opponent.name), ""),
                )
                for opponent in lines
                if opponent != line
            ],
        )
        for line in lines
    ]
