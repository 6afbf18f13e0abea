"""Whether players with little experience win more or less than predicted."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.special import logit

from evenbreak.ratings.calibration import Estimate, logistic_coefficient
from evenbreak.ratings.walk_forward import Forecasts

LIMITS = (0, 1, 21, 51, 201)
"""The fewest games of each group; the first is that of players without a game."""

FEWEST = 30
"""Matches from which a group is judged."""


class ByExperience(NamedTuple):
    """Matches in which the player with fewer games had played about so many games before.

    Parameters
    ----------
    fewest, most
        the range of the games played before; `most` is None for the last group.
    matches, games
        the matches with a more experienced opponent, and the games in them.
    predicted, seen
        the share of the games that the less experienced player was predicted to win, and won.
    stronger
        how much stronger they are than their rating, compared with the opponent, in log-odds.
    spread
        the squared errors of scores over what they are on average where games are independent.
    """

    fewest: int
    most: int | None
    matches: int
    games: int
    predicted: float
    seen: float
    stronger: Estimate
    spread: float


def by_experience(forecasts: Forecasts) -> list[ByExperience]:
    """Return how players fared against more experienced ones, by the games that they had played.

    The first date is left out, on which nobody has played before. Dates, or matches where that
    gives the larger standard error, are clusters.
    """
    less_a = forecasts.known_a < forecasts.known_b
    fewer = np.minimum(forecasts.known_a, forecasts.known_b)
    judged = (forecasts.known_a != forecasts.known_b) & (forecasts.date_of > 0)
    p = np.where(less_a, forecasts.p_game_integrated, 1.0 - forecasts.p_game_integrated)
    p = p.clip(1e-12, 1.0 - 1e-12)
    games = forecasts.games.astype(float)
    won = np.where(less_a, forecasts.results.score_a, forecasts.results.score_b).astype(float)
    found = []
    for fewest, above in zip(LIMITS, (*LIMITS[1:], None), strict=True):
        rows = judged & (fewer >= fewest) & (fewer < (np.inf if above is None else above))
        if rows.sum() < FEWEST:
            continue
        _, cluster = np.unique(forecasts.date_of[rows], return_inverse=True)
        offset, ones = logit(p[rows]), np.ones(int(rows.sum()))
        # From a few dates alone hardly any spread could be estimated.
        either = [
            logistic_coefficient(ones, won[rows], games[rows], one, offset=offset)
            for one in (cluster, np.arange(len(cluster)))
        ]
        known = [one for one in either if one is not None]
        if not known:
            continue
        stronger = max(known, key=lambda one: one.high - one.low)
        n, chance = games[rows], p[rows]
        spread = ((won[rows] - chance * n) ** 2).sum() / (chance * (1.0 - chance) * n).sum()
        found.append(
            ByExperience(
                fewest,
                None if above is None else above - 1,
                len(n),
                int(n.sum()),
                float((chance * n).sum() / n.sum()),
                float(won[rows].sum() / n.sum()),
                stronger,
                float(spread),
            )
        )
    return found
