"""The odds of a match whose chances are not known: a mixture over what they may be."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.games.match import Match
from evenbreak.matches.length import match_length


def mixture_of_odds(match: Match, each: Sequence[Any], weights: Floats) -> dict[str, Any]:
    """Return the fields of the `MatchOdds` of a match whose chances are drawn from several.

    Parameters
    ----------
    match
        the match, with arrays of chances of the length of `weights`.
    each
        the odds with each of the chances.
    weights
        how likely each of them is; they sum to 1.

    Notes
    -----
    The lengths are mixed, and mean, standard deviation and quantiles are those of the mixture.
    """
    mixed = {
        name: _mean([getattr(odds, name) for odds in each], weights)
        for name in each[0]._fields
        if name.startswith(("p_", "mean_"))
    }
    average = mixed["mean_games"]
    squares = [
        None
        if odds.mean_games is None or odds.sd_games is None
        else odds.mean_games**2 + odds.sd_games**2
        for odds in each
    ]
    square = _mean(squares, weights)
    sd = None
    if average is not None and square is not None:
        sd = math.sqrt(max(square - average**2, 0.0))
    length = match_length(match)
    of_mixture = replace(
        length,
        probability=weights @ length.probability,
        mean=average,
        sd=sd,
        p_never_ends=float(weights @ length.p_never_ends),
        tail_mass=float(weights @ length.tail_mass),
    )
    quantiles = {"games_p50": of_mixture.quantile(0.5), "games_p90": of_mixture.quantile(0.9)}
    return {**mixed, **quantiles, "sd_games": sd}


def _mean(values: Sequence[float | None], weights: Floats) -> float | None:
    """Return the weighted mean, None if a value is."""
    if any(value is None for value in values):
        return None
    return float(np.array(values, dtype=float) @ weights)
