"""Whether a season is predicted better where old games count less."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from evenbreak.ratings.calibration import Estimate, bootstrap_ratio
from evenbreak.ratings.results import Results
from evenbreak.ratings.stretches import stretch_losses

HALF_LIVES = (90.0, 180.0, 365.0)
"""The half-lives tried, in days."""

FEWEST_STRETCHES = 10
"""Stretches from which they can be compared."""


class HalfLifeGain(NamedTuple):
    """What a half-life gains over games that never age.

    Parameters
    ----------
    half_life
        days after which a match counts half.
    gain
        how much log-loss a game it saves, in nats.
    """

    half_life: float
    gain: Estimate


def half_life_gains(
    results: Results,
    prior_sd: float,
    rng: np.random.Generator,
    *,
    progress: Callable[[int, int], None] = lambda _done, _all: None,
) -> tuple[HalfLifeGain, ...]:
    """Return what each of `HALF_LIVES` gains in predicting a season from the days before.

    All ways of rating predict the same stretches with the same prior, so the intervals are
    those of the differences, the stretches resampled. Nothing is returned for a season of
    fewer than ten stretches.

    Parameters
    ----------
    results, progress
        as for `stretch_losses`.
    prior_sd
        standard deviation of the prior in natural log-odds.
    rng
        resamples the stretches.
    """
    ways = [{"prior_sd": prior_sd, "half_life": days} for days in (None, *HALF_LIVES)]
    found = stretch_losses(results, ways, progress=progress)
    stretches = np.arange(len(found.losses))
    if len(stretches) < FEWEST_STRETCHES:
        return ()
    ageless = found.losses[:, 0]
    return tuple(
        HalfLifeGain(
            days,
            bootstrap_ratio(ageless - found.losses[:, column], found.predicted, stretches, rng),
        )
        for column, days in enumerate(HALF_LIVES, 1)
    )
