"""How wide the prior should be: the width that predicts the next matches best.

The season is divided into stretches of whole days. Each stretch but the first is predicted
from the ratings of all days before it, with each width. The width under which the actual
results were most likely is chosen. Nothing is predicted from itself.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import InputError
from evenbreak.ratings.fit import PRIOR_SD, fit
from evenbreak.ratings.likelihood_terms import likelihood_terms
from evenbreak.ratings.results import Results

WIDTHS = tuple(PRIOR_SD * 2.0 ** (k / 2) for k in range(-6, 6))
"""The widths tried: from an eighth of a doubling of the odds, in steps of √2."""

STRETCHES = 30

_FAR, _CLEAR = 4, 2.0
"""Four steps are a factor of 4; a difference of 2 in log-likelihood is two standard errors."""


class PriorChoice(NamedTuple):
    """The width of the prior that predicts best.

    Attributes
    ----------
    prior_sd
        that width, in natural log-odds.
    tried
        all widths, in rising order.
    log_loss
        for each of them the mean of -ln P(the result | the days before): per game where
        scores are known, per match where only the winner is.
    predicted
        how many games and such matches were predicted.
    """

    prior_sd: float
    tried: tuple[float, ...]
    log_loss: tuple[float, ...]
    predicted: int

    @property
    def clear(self) -> bool:
        """Whether the results say much about the width.

        They do if a width four steps from the best one is worse by more than chance: by 2 in the
        log-likelihood of all results that were predicted.
        """
        best = self.tried.index(self.prior_sd)
        far = [loss for k, loss in enumerate(self.log_loss) if abs(k - best) >= _FAR]
        least = min(far, default=math.inf) - self.log_loss[best]
        return least * self.predicted > _CLEAR


def best_prior(
    results: Results,
    *,
    widths: Sequence[float] = WIDTHS,
    half_life: float | None = None,
    break_advantage: float | str | None = None,
    scale: Any = "npl",
) -> PriorChoice:
    """Return the width of the prior whose ratings predict later matches best.

    Predictions take the ratings at face value, without their uncertainty. Players who
    have not played yet are predicted to be average, so the matches of newcomers count too.

    Parameters
    ----------
    results
        matches on at least two days, all with a date; forfeits and 0-0 may lack one.
    widths
        the standard deviations to try, in natural log-odds.
    half_life, break_advantage, scale
        as for `fit`; the scale only matters for a break advantage in points.

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
    if not len(widths):
        raise InputError("widths is empty; give at least one standard deviation")
    played, date = _played(results)
    losses = np.zeros(len(widths))
    predicted = 0
    options: dict[str, Any] = {
        "half_life": half_life,
        "break_advantage": break_advantage,
        "scale": scale,
    }
    for first, last in _stretches(date):
        before = played.select(date < first)
        coming = played.select((date >= first) & (date <= last))
        scored, won_only = coming.played().results, coming.won_only()
        weights = np.ones(len(scored)), np.ones(len(won_only))
        terms = likelihood_terms(scored, won_only, weights, breaks=break_advantage is not None)
        predicted += round(terms.amount)
        for k, width in enumerate(widths):
            ratings = fit(before, prior_sd=width, **options)
            skill = ratings.scale.log_odds(ratings.rating - ratings.anchor)
            advantage = ratings.scale.log_odds(ratings.break_advantage or 0.0)
            losses[k] -= terms.log_likelihood(skill, advantage)
    order = np.argsort(widths)
    return PriorChoice(
        float(widths[int(np.argmin(losses))]),
        tuple(float(widths[k]) for k in order),
        tuple(float(losses[k]) / predicted for k in order),
        predicted,
    )


def _played(results: Results) -> tuple[Results, NDArray[np.datetime64]]:
    """Return the matches that count and their dates, or refuse those without one."""
    counted = (results.score_a > 0) | (results.score_b > 0)
    if results.unscored is not None:
        counted |= results.unscored
    played = results.select(counted & ~results.given_away)
    undated = len(played) if played.date is None else int(np.isnat(played.date).sum())
    if undated:
        raise InputError(
            f"{undated:,} of {len(played):,} matches have no date, but a prior is chosen by how "
            "well it predicts later days; add the dates, or give the prior's width"
        )
    if len(played) == 0 or played.date is None or played.date.min() == played.date.max():
        raise InputError(
            "a prior is chosen by how well it predicts later days, which takes matches on two "
            "days at least; give the prior's width"
        )
    return played, played.date


def _stretches(date: NDArray[np.datetime64]) -> list[tuple[np.datetime64, np.datetime64]]:
    """Return the first and last day of each stretch but the first; all are about equally long."""
    days, matches = np.unique(date, return_counts=True)
    done = np.cumsum(matches) - matches
    number = done // max(math.ceil(len(date) / STRETCHES), 1)
    first = np.flatnonzero(np.diff(number, prepend=-1))
    last = np.append(first[1:], len(days)) - 1
    return [(days[a], days[b]) for a, b in zip(first[1:], last[1:], strict=True)]
