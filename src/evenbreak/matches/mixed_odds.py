"""The odds of a match whose chances are not known: a mixture over what they may be."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.games.match import Match
from evenbreak.games.rack import Rack
from evenbreak.matches.length import match_length
from evenbreak.matches.odds import MatchOdds, match_odds
from evenbreak.matches.parameters import rack_in, with_rack


def mixed_odds(match: Match, weights: Floats) -> MatchOdds:
    """Return the odds of a match whose chances are drawn from some that may be right.

    Parameters
    ----------
    match
        the match, with arrays of chances of the length of `weights`.
    weights
        how likely each of them is; they sum to 1.

    Notes
    -----
    The lengths are mixed, and mean, standard deviation and quantiles are those of the mixture.

    >>> from evenbreak.games import Race
    >>> mixed_odds(Race(2, 2, Rack([0.25, 0.75])), np.array([0.5, 0.5])).p_hill_hill
    0.375
    """
    rack = rack_in(match)
    chances = [np.atleast_1d(p) for p in (rack.p1, rack.p2) if p is not None]
    each = [
        match_odds(with_rack(match, Rack(*map(float, pair)))) for pair in zip(*chances, strict=True)
    ]

    def mean(value: Callable[[MatchOdds], float | None]) -> float | None:
        return _mean([value(odds) for odds in each], weights)

    average = mean(lambda odds: odds.mean_games)
    square = mean(
        lambda odds: (
            None
            if odds.mean_games is None or odds.sd_games is None
            else odds.mean_games**2 + odds.sd_games**2
        )
    )
    sd = None
    if average is not None and square is not None:
        sd = math.sqrt(max(square - average**2, 0.0))
    length = match_length(match)
    mixed = replace(
        length,
        probability=weights @ length.probability,
        mean=average,
        sd=sd,
        p_never_ends=float(weights @ length.p_never_ends),
        tail_mass=float(weights @ length.tail_mass),
    )
    return MatchOdds(
        p_win_1=mean(lambda odds: odds.p_win_1) or 0.0,
        p_win_2=mean(lambda odds: odds.p_win_2) or 0.0,
        p_never_ends=mean(lambda odds: odds.p_never_ends) or 0.0,
        mean_games=average,
        sd_games=sd,
        games_p50=mixed.quantile(0.5),
        games_p90=mixed.quantile(0.9),
        p_hill_hill=mean(lambda odds: odds.p_hill_hill),
        p_shutout_1=mean(lambda odds: odds.p_shutout_1),
        p_shutout_2=mean(lambda odds: odds.p_shutout_2),
    )


def _mean(values: Sequence[float | None], weights: Floats) -> float | None:
    """Return the weighted mean, None if a value is."""
    if any(value is None for value in values):
        return None
    return float(np.array(values, dtype=float) @ weights)
