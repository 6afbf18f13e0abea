"""When one way of rating clearly predicts better than another: by stretches, and by players.

Predictions are made before the results, so the product of the ratios of what two ways predicted
reaches 20, if the first way is right, with a chance of at most 1/20 (Ville 1939; Shafer 2021). That
also holds for the mean of the scores of several ways. But what a level gains may come from a few
players, whose matches go well or badly together; so it must also be more than luck with players.
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
"""Stretches from which ways can be compared."""

EVIDENCE = 20.0
"""The betting score from which a gain is clear, if the bootstrap does not speak against it."""

SEED = 1
"""Of the bootstrap, so that the same file always has the same answer."""

LIKELY = 1.282
"""How many standard errors a gain is above 0 with 90% confidence."""

FEWEST_PLAYERS = 4
"""How many players a gain must rest on."""


def gains_over(of_ways: StretchLosses) -> tuple[Estimate, ...]:
    """Return how much log-loss a game each way but the first saves over the first.

    All ways predict the same stretches, so the intervals are those of the differences, the
    stretches resampled.
    """
    stretches = np.arange(len(of_ways.losses))
    drawn = _samples(len(stretches))
    return tuple(
        ratio_over(saved, of_ways.predicted, stretches, drawn)
        for saved in (of_ways.losses[:, :1] - of_ways.losses[:, 1:]).T
    )


def is_clear(of_ways: StretchLosses) -> bool:
    """Return whether some way but the first clearly predicts better than the first.

    Either the gain of one is above 0 with 99% confidence, stretches being resampled; or the mean
    betting score of all is at least 20, and the best gain is above 0 with 90% confidence. The
    second finds what mostly helps early in a season, as long as little is known from results.

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
    """Return whether a way's gain over the first is more than luck with players, and their number.

    The gain must be above 0 with 90% confidence, players being resampled, and remain without the
    matches of any three. The number is how few there are without whom there is none.
    """
    gain = of_ways.of_match[:, 0] - of_ways.of_match[:, way]
    players = of_ways.players.behind(gain)
    sure = float(gain.sum()) > LIKELY * of_ways.players.spread(gain)
    return sure and players >= FEWEST_PLAYERS, players


@cache
def _samples(stretches: int) -> Ints:
    return samples(stretches, np.random.default_rng(SEED))
