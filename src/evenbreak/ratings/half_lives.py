"""Whether results should count less with age: how much each half-life improves prediction."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from evenbreak.ratings.clear_gains import FEWEST_STRETCHES, gains_over
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.levels import Levels
from evenbreak.ratings.results import Results
from evenbreak.ratings.stretches import stretch_losses
from evenbreak.workers import Share

HALF_LIVES = (90.0, 180.0, 365.0, 730.0, 1461.0)
"""The half-lives tried, in days; the longer ones only for files that cover as many days."""


class HalfLifeGain(NamedTuple):
    """Gain from a half-life, in days, over games that never age: log-loss per game, in nats."""

    half_life: float
    gain: Estimate


def half_lives_for(results: Results) -> tuple[float, ...]:
    """Return the half-lives to try: those up to a year, and longer ones that the file exceeds."""
    dates = np.zeros(0) if results.date is None else results.date[~np.isnat(results.date)]
    days = float((dates.max() - dates.min()) / np.timedelta64(1, "D")) if len(dates) else 0.0
    return tuple(half_life for half_life in HALF_LIVES if half_life <= max(days, 365.0))


def half_life_gains(
    results: Results,
    prior_sd: float,
    *,
    levels: Levels | None = None,
    half_lives: Sequence[float] | None = None,
    progress: Callable[[int, int], None] = lambda _done, _all: None,
    share: Share | None = None,
) -> tuple[HalfLifeGain, ...]:
    """Return how much each half-life improves the prediction of a season from its earlier days.

    A season of fewer than ten stretches has no gains. The options are those of `stretch_losses` and
    `fit`; half-lives are in days, by default those of `half_lives_for`.
    """
    tried = half_lives_for(results) if half_lives is None else half_lives
    how = {"prior_sd": prior_sd, "levels": levels}
    ways = [{**how, "half_life": days} for days in (None, *tried)]
    of_ways = stretch_losses(results, ways, progress=progress, share=share)
    if len(of_ways.losses) < FEWEST_STRETCHES:
        return ()
    return tuple(map(HalfLifeGain, tried, gains_over(of_ways)))
