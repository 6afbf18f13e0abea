"""Whether one rating method clearly predicts better than another, by stretches and by players.

Predictions are made before the results, so if the first method is right, the product of the two
methods' likelihood ratios reaches 20 with probability at most 1/20 (Ville 1939; Shafer 2021). The
same is true of the mean of several methods' scores. But a level's gain may come from a few players,
whose matches go well or badly together, so the gain must also be more than luck with the players.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from scipy.special import logsumexp

from evenbreak.arrays import Ints
from evenbreak.ratings.estimates import SURE, Estimate, ratio_over, samples
from evenbreak.ratings.stretches import StretchLosses

FEWEST_STRETCHES = 10
"""Stretches needed to compare methods."""

EVIDENCE = 20.0
"""Betting score at which a gain is clear, if the bootstrap doesn't contradict it."""

SEED = 1
"""Seed of the bootstrap, so that the same file always gives the same answer."""

LIKELY = 1.282
"""How many standard errors above 0 a gain must be for 90% confidence."""

FEWEST_PLAYERS = 4
"""How many players a gain must rest on."""


def gains_over(of_ways: StretchLosses) -> tuple[Estimate, ...]:
    """Return the log-loss per game that each later method saves over the first.

    All methods predict the same stretches, so the intervals are for the differences, with the
    stretches resampled.
    """
    stretches = np.arange(len(of_ways.losses))
    drawn = _samples(len(stretches))
    return tuple(
        ratio_over(saved, of_ways.predicted, stretches, drawn)
        for saved in (of_ways.losses[:, :1] - of_ways.losses[:, 1:]).T
    )


def is_clear(of_ways: StretchLosses) -> bool:
    """Return whether any later method clearly predicts better than the first.

    Either one gain is above 0 with 99% confidence, with the stretches resampled; or the mean
    betting score of all methods is at least 20 and the best gain is above 0 with 90% confidence.
    The second criterion catches methods that help mainly early in a season, when results still say
    little.

    >>> from evenbreak.ratings.players_behind import PlayersBehind
    >>> nobody = PlayersBehind(*np.zeros((2, 0), dtype=int))
    >>> few = StretchLosses(np.ones((9, 2)), np.ones(9), np.zeros((0, 2)), nobody)
    >>> is_clear(few)
    False
    """
    if len(of_ways.losses) < FEWEST_STRETCHES:
        return False
    gains = gains_over(of_ways)
    saved = of_ways.losses.sum(0)[0] - of_ways.losses.sum(0)[1:]
    score = float(logsumexp(saved)) - math.log(len(saved))
    best = max(gains, key=lambda gain: gain.value)
    return any(gain.errors_above() > SURE for gain in gains) or (
        score >= math.log(EVIDENCE) and best.errors_above() > LIKELY
    )


def by_enough_players(of_ways: StretchLosses, way: int) -> tuple[bool, int]:
    """Return whether a method's gain over the first is more than luck with players, and a count.

    The gain must be above 0 with 90% confidence, with the players resampled, and remain when the
    matches of any three players are left out. The count is the smallest number of players without
    whose matches no gain is left.
    """
    gain = of_ways.of_match[:, 0] - of_ways.of_match[:, way]
    players = of_ways.players.behind(gain)
    sure = float(gain.sum()) > LIKELY * of_ways.players.spread(gain)
    return sure and players >= FEWEST_PLAYERS, players


@cache
def _samples(stretches: int) -> Ints:
    return samples(stretches, np.random.default_rng(SEED))
