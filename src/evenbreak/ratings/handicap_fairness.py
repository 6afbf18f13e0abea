"""Whether handicaps are fair in the data: how often the player with the longer race wins."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from evenbreak.ratings.calibration import wilson
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
