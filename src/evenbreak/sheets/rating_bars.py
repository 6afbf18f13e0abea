"""Ratings with their bars, on an axis from 0 to 100 per cent, for pages and for paper."""

import math
from typing import Any, NamedTuple

import matplotlib as mpl
import pandas as pd
from matplotlib.ticker import MaxNLocator

from evenbreak.answers.kit.scales import decimals_of
from evenbreak.ratings.scale import Scale

NOT_OVER_THE_EDGE = (4, 96)
"""A label nearer to an end of the axis would hang over it."""


class PlayerLine(NamedTuple):
    """A player's rating, and a bar of two standard errors either way, in per cent of the axis.

    An error that is not stated is empty; counts are None where they are not stated.
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
    """A mark on an axis, at per cent of its length."""

    at: float
    label: str


class Bars:
    """The axis that the bars of some ratings share.

    Parameters
    ----------
    rated
        with the columns rating and standard_error (NaN: not stated).

    >>> import pandas as pd
    >>> bars = Bars(pd.DataFrame({"rating": [60.0, 100.0], "standard_error": [5.0, float("nan")]}))
    >>> bars.place(80.0), [tick.label for tick in bars.ticks()]
    (59.26, ['60', '70', '80', '90'])
    """

    def __init__(self, rated: pd.DataFrame) -> None:
        error = rated["standard_error"].fillna(0.0)
        low = float((rated["rating"] - 2 * error).min())
        high = float((rated["rating"] + 2 * error).max())
        edge = 0.04 * (high - low) or 1.0
        self.low, self.high = low - edge, high + edge

    def place(self, rating: float) -> float:
        """Return where a rating stands, in per cent."""
        return round(100 * (rating - self.low) / (self.high - self.low), 2)

    def ticks(self) -> list[Tick]:
        """Return the marks on the axis."""
        found = round_numbers(self.low, self.high, most=6, steps=[1, 2, 2.5, 5, 10])
        ticks = [Tick(self.place(tick), f"{tick:g}") for tick in found]
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
    rated: pd.DataFrame, scale: Scale, bars: Bars, *, grouped: bool
) -> list[PlayerLine]:
    """Return the lines of a list of ratings, in its order; the index is the place, from 0.

    Parameters
    ----------
    rated
        with the columns player, rating, standard_error (NaN: not stated), games (below 0: not
        stated) and component (0: not stated); perhaps won and lost.
    scale
        of the ratings, which says how many decimals they need.
    bars
        their axis.
    grouped
        whether to say to which group a player belongs.
    """
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
                row.Index + 1,
                row.player,
                f"{row.rating:.{0 if whole else decimals}f}",
                "" if unknown else f"{row.standard_error:.{decimals}f}",
                row.games if row.games >= 0 else None,
                getattr(row, "won", None),
                getattr(row, "lost", None),
                row.component if grouped else None,
                *(bars.place(row.rating + away) for away in (-reach, 0.0, reach)),
            )
        )
    return lines
