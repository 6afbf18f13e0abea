"""What the sheet for a screen shows, worked out before any HTML is written."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.frames import count_groups
from evenbreak.answers.sheet_words import NO_RACE, decimals_of, races_by_name
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    import pandas as pd

MOST_BANDS = 40
"""A chart with more lines is no chart to read."""

_ROOM, _FIGURE, _EDGE = 144.0, 1.5, 2.2
"""Millimetres: for the columns of a printed table, for a figure in it, and around a race."""


class PlayerLine(NamedTuple):
    """A line of the ratings; `low`, `middle` and `high` are per cent of the axis of the bars.

    An error that is not stated is empty; games, won and lost are None where nobody says.
    """

    place: int
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
    """A mark on the axis of the bars, at per cent of its length."""

    at: float
    label: str


class Block(NamedTuple):
    """Columns of the table of races, and each player's races in them; None against oneself."""

    across: Sequence[PlayerLine]
    rows: Sequence[tuple[PlayerLine, Sequence[str | None]]]


class RaceCard(NamedTuple):
    """One player's opponents, each with the race and the player's chance of winning it."""

    player: PlayerLine
    races: Sequence[tuple[PlayerLine, str, str]]


class Band(NamedTuple):
    """A span of rating differences with one race, up to just below `after`.

    `p_first` and `p_after` are the stronger player's chances at its two ends.
    """

    first: float
    after: float
    stronger: int
    weaker: int
    p_first: float
    p_after: float


class SurePair(NamedTuple):
    """A pair's rating difference, and P(A wins the race) there and two errors either way."""

    player_a: str
    player_b: str
    race: str
    difference: float
    error: float
    p_win: float
    low: float
    high: float


def player_lines(rated: pd.DataFrame, ratings: Ratings) -> list[PlayerLine]:
    """Return the lines of the ratings, in the order of `rated`; the index says the place."""
    decimals = decimals_of(ratings.scale)
    grouped = count_groups(ratings) > 1
    along = _along(rated)
    rows: Any = rated.itertuples(index=True)
    return [
        PlayerLine(
            row.Index + 1,
            row.player,
            f"{row.rating:.{decimals}f}",
            f"{row.standard_error:.{decimals}f}",
            row.games,
            row.won,
            row.lost,
            row.component if grouped else None,
            *along(row.rating, row.standard_error),
        )
        for row in rows
    ]


def roster_lines(rated: pd.DataFrame, scale: Scale) -> list[PlayerLine]:
    """Return the lines of a roster's ratings, in the order of `rated`, as `player_lines` does.

    `rated` has the columns player, rating, standard_error (NaN: not stated), games (below 0:
    not stated) and component (0: not stated).
    """
    decimals = decimals_of(scale)
    # A list of whole points is shown as the league knows it.
    whole = bool((rated["rating"] % 1 == 0).all())
    grouped = rated["component"].max() > 1
    along = _along(rated)
    rows: Any = rated.itertuples(index=True)
    return [
        PlayerLine(
            row.Index + 1,
            row.player,
            f"{row.rating:.{0 if whole else decimals}f}",
            "" if math.isnan(row.standard_error) else f"{row.standard_error:.{decimals}f}",
            row.games if row.games >= 0 else None,
            None,
            None,
            row.component if grouped else None,
            *along(row.rating, row.standard_error),
        )
        for row in rows
    ]


def _along(rated: pd.DataFrame) -> Callable[[float, float], tuple[float, float, float]]:
    """Return the ends and the middle of a bar, per cent of the axis, by rating and error."""
    low, high = _reach(rated)

    def along(rating: float, error: float) -> tuple[float, float, float]:
        error = 0.0 if math.isnan(error) else error
        ends = (rating - 2 * error, rating, rating + 2 * error)
        first, middle, last = (round(100 * (end - low) / (high - low), 2) for end in ends)
        return first, middle, last

    return along


def _reach(rated: pd.DataFrame) -> tuple[float, float]:
    """Return the ends of the axis of the bars, in points."""
    error = rated["standard_error"].fillna(0.0)
    low = float((rated["rating"] - 2 * error).min())
    high = float((rated["rating"] + 2 * error).max())
    edge = 0.04 * (high - low) or 1.0
    return low - edge, high + edge


def bar_ticks(rated: pd.DataFrame) -> list[Tick]:
    """Return the marks on the axis of the bars."""
    from matplotlib.ticker import MaxNLocator

    low, high = _reach(rated)
    found = MaxNLocator(nbins=6, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    ticks = [(100 * (float(tick) - low) / (high - low), float(tick)) for tick in found]
    # A label nearer to an end would hang over it.
    return [Tick(round(at, 2), f"{tick:g}") for at, tick in ticks if 4 < at < 96]


def race_blocks(lines: Sequence[PlayerLine], paired: pd.DataFrame) -> list[Block]:
    """Return the table of races, in blocks of as many columns as fit on a printed page."""
    races = races_by_name(paired)
    widest = max((len(race) for race in races.values()), default=3)
    # A colon is half as wide as a figure.
    fitting = int(_ROOM / (_FIGURE * (widest - 0.5) + _EDGE))
    size = math.ceil(len(lines) / math.ceil(len(lines) / fitting))
    blocks = []
    for first in range(0, len(lines), size):
        across = lines[first : first + size]
        rows = [
            (line, [_race(races, line, other) if line != other else None for other in across])
            for line in lines
        ]
        blocks.append(Block(across, rows))
    return blocks


def _race(races: dict[tuple[str, str], str], player: PlayerLine, other: PlayerLine) -> str:
    return races.get((player.name, other.name), NO_RACE)


def race_cards(lines: Sequence[PlayerLine], paired: pd.DataFrame) -> list[RaceCard]:
    """Return each player's races, for a page that is too narrow for the table of them."""
    races = races_by_name(paired)
    chances: dict[tuple[str, str], str] = {}
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        chances[pair.player_a, pair.player_b] = f"{pair.p_win_a:.2f}"
        chances[pair.player_b, pair.player_a] = f"{1.0 - pair.p_win_a:.2f}"
    return [
        RaceCard(
            line,
            [
                (other, _race(races, line, other), chances.get((line.name, other.name), ""))
                for other in lines
                if other != line
            ],
        )
        for line in lines
    ]


def chart_bands(limits: RaceLimits, scale: Scale, furthest: float) -> list[Band]:
    """Return the chart of races by rating difference that the fairest races come to.

    Parameters
    ----------
    limits
        which races may be offered. Where they may differ in length, the race nearest to
        even jumps to and fro between lengths as ratings part, and no chart is made.
    scale
        what a rating difference means.
    furthest
        the difference, in points, up to which the chart goes.

    Returns
    -------
    list of Band
        differences are whole multiples of the last decimal that ratings are told with;
        empty where there is no chart, or one of more than 40 lines.

    >>> from evenbreak.ratings import SCALES
    >>> for band in chart_bands(RaceLimits(race_to=7), SCALES["npl"], 20.0):
    ...     print(band.first, band.stronger, band.weaker, round(band.p_first, 3))
    0.0 7 7 0.5
    3.5 7 6 0.443
    11.2 7 5 0.435
    """
    if limits.games is not None and limits.games[0] != limits.games[1]:
        return []
    decimals = decimals_of(scale)
    unit = 10.0**-decimals
    # One step beyond, so that the furthest pair is in a band even where one begins with it.
    last = math.ceil(furthest / unit) + 1

    def race(step: int) -> tuple[int, int]:
        fairest = limits.fairest(scale.win_probability(step * unit))
        return fairest.race_1, fairest.race_2

    def chance(step: int, needs: tuple[int, int]) -> float:
        return float(race_win_probability(scale.win_probability(step * unit), *needs))

    # From one band to the next the stronger gives one game more, or the weaker gets one.
    if race(0)[1] - race(last)[1] >= MOST_BANDS:
        return []
    bands: list[Band] = []
    first, needs = 0, race(0)
    while first < last:
        after = _first_other(race, first, last, needs)
        bands.append(
            Band(
                round(first * unit, decimals),
                round(after * unit, decimals),
                *needs,
                chance(first, needs),
                chance(after, needs),
            )
        )
        first, needs = after, race(after)
    return bands


def _first_other(race: Any, first: int, last: int, needs: tuple[int, int]) -> int:
    """Return the first step after `first` with another race, or `last`: a race comes once."""
    low, high = first, last
    while high - low > 1:
        middle = (low + high) // 2
        if race(middle) == needs:
            low = middle
        else:
            high = middle
    return high


def sure_pairs(ratings: Ratings, paired: pd.DataFrame) -> list[SurePair]:
    """Return the pairs with a race, the best known first.

    The errors of two ratings of one league are in part the same and cancel: the standard
    error of a difference is less than theirs make one believe.
    """
    names = sorted({*paired["player_a"], *paired["player_b"]})
    covariance = ratings.covariance(names)
    row = {name: k for k, name in enumerate(names)}
    rating = dict(zip(ratings.players, ratings.rating.tolist(), strict=True))
    found = []
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        a, b = row[pair.player_a], row[pair.player_b]
        difference = rating[pair.player_a] - rating[pair.player_b]
        error = math.sqrt(covariance[a, a] + covariance[b, b] - 2 * covariance[a, b])
        low, p_win, high = (
            float(race_win_probability(ratings.scale.win_probability(d), pair.race_a, pair.race_b))
            for d in (difference - 2 * error, difference, difference + 2 * error)
        )
        race = f"{pair.race_a}:{pair.race_b}"
        found.append(
            SurePair(pair.player_a, pair.player_b, race, difference, error, p_win, low, high)
        )
    # Rounded, so that the last bits do not decide.
    return sorted(found, key=lambda pair: round(pair.error / ratings.scale.points_per_doubling, 9))
