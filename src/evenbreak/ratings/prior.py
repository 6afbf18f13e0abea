"""How wide the prior should be: the width that predicts the next matches best.

Each stretch of a season is predicted from the days before it with each width (see
`evenbreak.ratings.stretches`). The width under which the actual results were most likely is
chosen, if the results are enough to choose by.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.results import Results
from evenbreak.ratings.stretches import StretchLosses, stretch_losses

WIDTHS = tuple(PRIOR_SD * 2.0 ** (k / 2) for k in range(-6, 6))
"""The widths tried: from an eighth of a doubling of the odds, in steps of √2."""

AS_GOOD = 1.92
"""What a width may lose in all, in nats, to be as good as the best: half of chi-squared's 95%."""

VAGUE = 4.0
"""Where widths this many times apart are as good as the best, the results cannot choose."""

FEWEST = 100
"""Games (or matches known by the winner alone) to predict before a width is chosen by them."""


class PriorChoice(NamedTuple):
    """The width of the prior that predicts best.

    Attributes
    ----------
    prior_sd
        that width, in natural log-odds; the one nearest to `PRIOR_SD` where `learnt` is false.
    tried
        all widths, in rising order.
    log_loss
        for each of them the mean of -ln P(the result | the days before): per game where
        scores are known, per match where only the winner is.
    predicted
        how many games and such matches were predicted.
    low, high
        the ends of the range of widths that predict as well as the best (95%).
    learnt
        whether that range is narrow enough to choose by, and 100 results were predicted.
    as_it_went
        the log-loss where each stretch has the width that did best before it.
    """

    prior_sd: float
    tried: tuple[float, ...]
    log_loss: tuple[float, ...]
    predicted: int
    low: float
    high: float
    learnt: bool
    as_it_went: float


def best_prior(
    results: Results,
    *,
    widths: Sequence[float] = WIDTHS,
    half_life: float | None = None,
    break_advantage: float | str | None = None,
    scale: Any = "npl",
    progress: Callable[[int, int], None] = lambda _done, _all: None,
) -> PriorChoice:
    """Return the width of the prior whose ratings predict later matches best.

    Predictions take the ratings at face value, without their uncertainty. Players who
    have not played yet are predicted to be average, so the matches of newcomers count too.
    Where fewer than 100 games are predicted, or widths four times apart predict equally well,
    there are too few results to choose by, and the width nearest to the default is returned.

    Parameters
    ----------
    results
        matches on at least two days, all with a date; forfeits and 0-0 may lack one.
    widths
        the standard deviations to try, in natural log-odds.
    half_life, break_advantage, scale
        as for `fit`; the scale only matters for a break advantage in points.
    progress
        called with how many stretches are done, and of how many.

    Raises
    ------
    InputError
        if a date is missing, all matches are of one day, or a width is not in 0.001 to 100.

    Notes
    -----
    Prequential validation: Dawid (1984), "The prequential approach".

    >>> season = Results.from_names(
    ...     ["A"] * 4, ["B"] * 4, [7] * 4, [4] * 4, date=["2026-01-0" + day for day in "1234"]
    ... )
    >>> choice = best_prior(season, widths=[0.1, 0.5])
    >>> choice.prior_sd, choice.predicted
    (0.5, 33)
    """
    check_results(results)
    if not len(widths):
        raise InputError("widths is empty; give at least one standard deviation")
    tried = np.sort(np.asarray(widths, dtype=float))
    ways = [
        {
            "prior_sd": width,
            "half_life": half_life,
            "break_advantage": break_advantage,
            "scale": scale,
        }
        for width in tried.tolist()
    ]
    found = stretch_losses(results, ways, progress=progress)
    total = found.losses.sum(0)
    good = tried[total <= total.min() + AS_GOOD]
    predicted = int(found.predicted.sum())
    learnt = predicted >= FEWEST and round(float(good[-1] / good[0]), 6) < VAGUE
    best = total if learnt else _from_default(tried)
    return PriorChoice(
        float(tried[best.argmin()]),
        tuple(tried.tolist()),
        tuple(found.means.tolist()),
        predicted,
        float(good[0]),
        float(good[-1]),
        learnt,
        _as_it_went(found, tried),
    )


def _from_default(widths: Floats) -> Floats:
    return np.abs(np.log(widths / PRIOR_SD))


def _as_it_went(found: StretchLosses, tried: Floats) -> float:
    """Return the log-loss where each stretch has the width that did best before it."""
    before = np.cumsum(found.losses, axis=0) - found.losses
    # Before the first stretch nothing is known: then the width nearest to the default is used.
    before[0] = _from_default(tried)
    chosen = found.losses[np.arange(len(before)), before.argmin(1)]
    return float(chosen.sum() / found.predicted.sum())
