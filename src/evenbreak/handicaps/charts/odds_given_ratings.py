"""The odds of any match, when the ratings of the two players have errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import number
from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.given_ratings import averaging_rule, error_of
from evenbreak.matches.length import match_length
from evenbreak.matches.odds import MatchOdds, match_odds
from evenbreak.matches.parameters import checked_match, with_rack
from evenbreak.ratings.scale import scale_of

MOST_NODES, MOST_NODES_OF_SETS = 1000, 60
"""Nodes of the average, of a race and of another match: enough for six digits, or for four."""


def odds_given_ratings(
    match: Match, difference: float, standard_error: float, *, scale: Any = "npl"
) -> MatchOdds:
    """Return the odds of a match, averaged over how far a difference of ratings may be off.

    Parameters
    ----------
    match
        what is played; the chance in a game comes from the ratings, whatever its rack says.
    difference, standard_error, scale
        as for `win_given_ratings`; an error of 0 gives `match_odds`.

    Raises
    ------
    InputError
        as for `win_given_ratings`, or if the break matters in the match.

    Notes
    -----
    The lengths of all possible differences are mixed, and mean, standard deviation and quantiles
    are those of the mixture. A score that is already reached does not change the ratings.

    >>> from evenbreak.games import Race, Rack
    >>> race = Race(7, 3, Rack(0.5))
    >>> round(odds_given_ratings(race, 60, 0).p_win_1, 4)
    0.7382
    >>> round(odds_given_ratings(race, 60, 40).p_win_1, 4)
    0.6485
    """
    match, scale = checked_match(match), scale_of(scale)

    difference = number(difference, "difference")
    standard_error = float(error_of(number(standard_error, "standard_error"), scale))
    if match.break_matters:
        raise InputError("the break matters in the match, but ratings do not say who breaks well")

    def at(p: Any) -> Any:
        return with_rack(match, Rack(p))

    plain = isinstance(match, Race) and match.win_by == 1 and isinstance(match.rack, Rack)
    if standard_error == 0.0:
        return match_odds(at(scale.win_probability(difference)))
    longest = match.m + match.n if plain else (match.m + match.n) ** 2
    nodes, weights = averaging_rule(
        standard_error, longest, scale, MOST_NODES if plain else MOST_NODES_OF_SETS
    )
    p = scale.win_probability(difference + nodes * standard_error)
    each = [match_odds(at(float(one))) for one in p]

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
    length = match_length(at(p))
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
