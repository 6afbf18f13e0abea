"""The fairest race of each pair of rated players."""

import math
from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from evenbreak.answers.kit.scales import decimals_of
from evenbreak.answers.kit.wording import race
from evenbreak.answers.league.roster_matchups import OfferedRaces, roster_matchups
from evenbreak.files.csv_writer import DECIMALS
from evenbreak.handicaps.charts.gap import MOST_DOUBLINGS, Gap
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale


def matchups_frame(ratings: Ratings, players: Sequence[int], offered: OfferedRaces) -> pd.DataFrame:
    """Return the fairest race of each pair of players, the stronger of the two first.

    The races are those of `roster_matchups` for the list of ratings that a report writes, so a
    pair has the same race here and wherever that list is read.

    Parameters
    ----------
    ratings
        how strong everybody is.
    players
        who is paired: positions in `ratings.players`.
    offered
        the races to choose from.

    Returns
    -------
    pandas.DataFrame
        the frame of `roster_matchups`. Where no chain of opponents links the two, their ratings
        cannot be compared: there are no numbers then, and the note says so.
    """
    order = ratings.strongest_first(players)
    pairs = np.array(list(combinations(order, 2)), dtype=np.int64).reshape(-1, 2)
    return roster_matchups(
        _as_listed(ratings), pairs, scale=ratings.scale, offered=offered, form=ratings.match_form
    ).frame


def _as_listed(ratings: Ratings) -> Roster:
    """Return the ratings as their list has them: rounded, with an error for each player."""
    # An error beyond this says that nothing is known; numbers would not change much.
    most = MOST_DOUBLINGS * ratings.scale.points_per_doubling / 2.0
    return Roster(
        ratings.players,
        np.round(ratings.rating, DECIMALS),
        np.minimum(np.round(ratings.quasi_error, DECIMALS), most),
        ratings.games + ratings.races_won + ratings.races_lost,
        component=ratings.component,
    )


class SurePair(NamedTuple):
    """A pair's rating difference and its error, and P(A wins the race).

    `p_win` is averaged over the error; `low` and `high` are the chances two errors either way.
    """

    player_a: str
    player_b: str
    race: str
    difference: float
    error: float
    p_win: float
    low: float
    high: float


def sure_pairs(paired: pd.DataFrame, scale: Scale) -> list[SurePair]:
    """Return the pairs with a race, the best known first, of a frame of `roster_matchups`."""
    found = []
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        difference, error = pair.difference, pair.difference_error
        ends = [scale.win_probability(difference + 2 * side * error) for side in (-1, 1)]
        low, high = race_win_probability(ends, pair.race_a, pair.race_b).tolist()
        needs = race((pair.race_a, pair.race_b))
        found.append(
            SurePair(
                pair.player_a, pair.player_b, needs, difference, error, pair.p_win_a, low, high
            )
        )
    # Rounded, so that the last bits do not decide.
    return sorted(found, key=lambda pair: round(pair.error / scale.points_per_doubling, 9))


def how_sure(scale: Scale, pairs: Sequence[SurePair]) -> Iterator[str]:
    """Yield what the standard errors mean for a rating and for a race."""
    yield (
        "Each bar reaches two standard errors either side of the rating. If the model below "
        "holds, a player's true strength lies within the bar about 19 times in 20."
    )
    if pairs:
        middle = pairs[(len(pairs) - 1) // 2]
        several = len(pairs) > 1
        yield (
            f"{'For half of the pairs, the' if several else 'The'} rating difference is known to "
            f"within {2 * middle.error:.{decimals_of(scale)}f} points (two standard errors)"
            f"{' or better' if several else ''}. So a race that looks even may really favour "
            "one of the two:"
        )


def three_pairs(pairs: Sequence[SurePair]) -> list[tuple[str, SurePair]]:
    """Return the best known, a typical and the least known pair, each once."""
    if len(pairs) < 2:
        return [("", pair) for pair in pairs]
    named = {(len(pairs) - 1) // 2: "typical", 0: "best known", len(pairs) - 1: "least known"}
    return [(name, pairs[k]) for k, name in sorted(named.items())]


MOST_BANDS = 40
"""A chart with more lines than this is too long to read."""


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


def chart_bands(offered: OfferedRaces, typical: Gap, furthest: float) -> list[Band]:
    """Return the chart of races by rating difference that the fairest races come to.

    Parameters
    ----------
    offered
        the races to choose from. Where they may differ in length, the race nearest to
        even jumps back and forth between lengths as ratings part, and no chart is made.
    typical
        how sure a difference is, and what it means; its own difference does not matter.
    furthest
        the difference, in points, up to which the chart goes.

    Returns
    -------
    list of Band
        differences are whole multiples of the last decimal in which ratings are shown;
        empty where there is no chart, or one of more than 40 lines.

    >>> for band in chart_bands(OfferedRaces(race_to=7), Gap(0.0, scale="npl"), 20.0):
    ...     print(band.first, band.stronger, band.weaker, round(band.p_first, 3))
    0.0 7 7 0.5
    3.5 7 6 0.443
    11.2 7 5 0.435
    """
    if offered.games is not None and offered.games[0] != offered.games[1]:
        return []
    decimals = decimals_of(typical.scale)
    unit = 10.0**-decimals
    # One step beyond, so that the furthest pair is in a band even where one begins with it.
    last = math.ceil(furthest / unit) + 1

    # From one band to the next the stronger gives one game more, or the weaker gets one.
    _, (most, least) = offered.fairest(typical.at([0.0, last * unit]))
    if most - least >= MOST_BANDS:
        return []
    difference = np.arange(last + 1) * unit
    stronger, weaker = offered.fairest(typical.at(difference))
    starts = np.flatnonzero(np.diff(stronger) | np.diff(weaker)) + 1
    bands = []
    for first, after in pairwise([0, *starts[starts < last].tolist(), last]):
        m, n = int(stronger[first]), int(weaker[first])
        ends = np.round(difference[[first, after]], decimals)
        chances = typical.at(difference[[first, after]]).win(m, n)
        (low, high), (p_low, p_high) = ends.tolist(), chances.tolist()
        bands.append(Band(low, high, m, n, p_low, p_high))
    return bands
