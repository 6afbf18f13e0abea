"""Whether handicaps are fair in the data: how often the player with the longer race wins."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from evenbreak.ratings.calibration import TOSS_UP, wilson
from evenbreak.ratings.walk_forward import Forecasts


class HandicapFairness(NamedTuple):
    """The handicap races with one spot: how often the player with the longer race won.

    Parameters
    ----------
    spot
        the games that this player gave: their race less the opponent's; None: all spots together.
    matches, won
        races played to the end, and those that this player won.
    share, low, high
        won / matches with its 95% interval (Wilson's); with a fair chart it is 1/2.
    expected
        the mean chance that the ratings before each date gave this player.
    """

    spot: int | None
    matches: int
    won: int
    share: float
    low: float
    high: float
    expected: float


def handicap_fairness(forecasts: Forecasts) -> list[HandicapFairness]:
    """Return how fair each spot was, ascending, and all of them together at the end.

    Only stated races count; the list is empty where none was a handicap race.
    """
    gives = forecasts.race_a - forecasts.race_b
    rows = gives != 0
    if not rows.any():
        return []
    a_gives = gives[rows] > 0
    won, p = forecasts.won[rows], forecasts.p_match_integrated[rows]
    won, p = np.where(a_gives, won, 1.0 - won), np.where(a_gives, p, 1.0 - p)
    spot = np.abs(gives[rows])
    found = []
    for games in (*np.unique(spot).tolist(), None):
        chosen = np.ones(len(spot), dtype=bool) if games is None else spot == games
        matches, wins = int(chosen.sum()), int(won[chosen].sum())
        share = wins / matches
        expected = float(p[chosen].mean())
        found.append(
            HandicapFairness(games, matches, wins, share, *wilson(share, matches), expected)
        )
    return found


# Whether favourites won short and long races as often as predicted.


class RaceLengths(NamedTuple):
    """Even races of similar length: how often the favourite won.

    Parameters
    ----------
    shortest, longest
        the games needed in the shortest and in the longest of them.
    matches, won
        races with a favourite, and those that the favourite won.
    share, low, high
        won / matches with its 95% interval (Wilson's).
    predicted
        the mean chance of the favourites, the uncertainty of ratings integrated out.
    """

    shortest: int
    longest: int
    matches: int
    won: int
    share: float
    low: float
    high: float
    predicted: float


def race_lengths(forecasts: Forecasts) -> list[RaceLengths]:
    """Return how often favourites won the shorter and the longer half of the even races.

    The halves are as nearly equal as whole lengths allow. The list is empty where all races
    are equally long, or there are handicaps: those leave matches without a favourite.
    """
    raced, p = forecasts.race_a > 0, forecasts.p_match_integrated
    rows = raced & (np.abs(np.where(raced, p, 0.5) - 0.5) > TOSS_UP)
    needed = forecasts.race_a[rows]
    if (forecasts.race_a != forecasts.race_b).any() or len(np.unique(needed)) < 2:
        return []
    a_leads = p[rows] > 0.5
    chance = np.where(a_leads, p[rows], 1.0 - p[rows])
    won = np.where(a_leads, forecasts.won[rows], 1.0 - forecasts.won[rows])
    lengths, counts = np.unique(needed, return_counts=True)
    up_to = np.cumsum(counts)[:-1]
    last_short = lengths[np.abs(2 * up_to - len(needed)).argmin()]
    found = []
    for half in (needed <= last_short, needed > last_short):
        matches, wins = int(half.sum()), int(won[half].sum())
        share = wins / matches
        ends = int(needed[half].min()), int(needed[half].max())
        predicted = float(chance[half].mean())
        found.append(RaceLengths(*ends, matches, wins, share, *wilson(share, matches), predicted))
    return found
