"""Whether the chart is fair in the data: how often the player with the longer race wins."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from evenbreak.ratings.calibration import wilson
from evenbreak.ratings.walk_forward import Forecasts


class SpotFairness(NamedTuple):
    """The handicap races of one spot: how often the player with the longer race won.

    Parameters
    ----------
    spot
        the games that he gave: his race less the other's; None: all spots together.
    matches, won
        races played out, and those that he won.
    share, low, high
        won / matches with its 95 % interval (Wilson's); a fair chart makes it 1/2.
    expected
        the mean chance that the ratings before each date gave him.
    """

    spot: int | None
    matches: int
    won: int
    share: float
    low: float
    high: float
    expected: float


def spot_fairness(told: Forecasts) -> list[SpotFairness]:
    """Return the fairness of each spot, ascending, and of all together at the end.

    Only stated races count; empty where none was a handicap race.
    """
    gives = told.race_a - told.race_b
    rows = gives != 0
    if not rows.any():
        return []
    a_gives = gives[rows] > 0
    won = np.where(a_gives, told.won[rows], 1.0 - told.won[rows])
    p = np.where(a_gives, told.p_match_integrated[rows], 1.0 - told.p_match_integrated[rows])
    spot = np.abs(gives[rows])
    found = []
    for games in (*np.unique(spot).tolist(), None):
        chosen = np.ones(len(spot), dtype=bool) if games is None else spot == games
        matches, wins = int(chosen.sum()), int(won[chosen].sum())
        share = wins / matches
        expected = float(p[chosen].mean())
        found.append(SpotFairness(games, matches, wins, share, *wilson(share, matches), expected))
    return found
