"""The odds of any match, when the ratings of the two players have errors."""

from __future__ import annotations

from typing import Any

import numpy as np

from evenbreak.checks import number
from evenbreak.errors import InputError
from evenbreak.games.match import Match
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.given_ratings import error_of, with_form
from evenbreak.matches.form import form_of, given_score, rule_for
from evenbreak.matches.odds import MatchOdds, match_odds, mixed_odds
from evenbreak.matches.parameters import checked_match, with_rack
from evenbreak.ratings.scale import scale_of
from evenbreak.ratings.unstated_scale import DEFAULT_SCALE


def odds_given_ratings(
    match: Match,
    difference: float,
    standard_error: float,
    *,
    scale: Any = DEFAULT_SCALE,
    form: float = 0.0,
) -> MatchOdds:
    """Return the odds of a match, averaged over how far a difference of ratings may be off.

    Parameters
    ----------
    match
        what is played; the chance in a game comes from the ratings, whatever its rack says.
    difference, standard_error, scale, form
        as for `win_given_ratings`; without error and form the odds are those of `match_odds`.

    Raises
    ------
    InputError
        as for `win_given_ratings`, or if the break matters in the match.

    Notes
    -----
    The lengths of all possible differences are mixed, and mean, standard deviation and quantiles
    are those of the mixture. A score that is already reached does not change the ratings, unless
    there is form: then it shows how well both play today.

    >>> from evenbreak.games import Race, Rack
    >>> race = Race(7, 3, Rack(0.5))
    >>> round(odds_given_ratings(race, 60, 0).p_win_1, 4)
    0.7382
    >>> round(odds_given_ratings(race, 60, 40).p_win_1, 4)
    0.6485
    """
    match, scale, form = checked_match(match), scale_of(scale), form_of(form)
    difference = number(difference, "difference")
    standard_error = float(error_of(number(standard_error, "standard_error"), scale))
    if match.break_matters:
        raise InputError("the break matters in the match, but ratings do not say who breaks well")

    if standard_error == 0.0 and not form:
        return match_odds(with_rack(match, Rack(scale.win_probability(difference))))
    gap, error = with_form(np.asarray(difference), np.asarray(standard_error), form, scale)
    nodes, weights = rule_for(match, scale.log_odds(float(error)))
    many = with_rack(match, Rack(scale.win_probability(gap + nodes * error)))
    return mixed_odds(many, given_score(many, weights) if form else weights)
