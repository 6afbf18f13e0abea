"""How much less a match says about the ratings because its games share the players' form.

With form of variance v (see `evenbreak.ratings.day_form`), n games of a match that are won with
the chance p have the variance n p q (1 + (n - 1) v p q), to first order, with q = 1 - p. Their
information about the difference between two players is

    n p q / (1 + (n - 1) v p q),

as much as that of n independent games with the weight 1 / (1 + (n - 1) v p q). A single game says
as much as it does without form, because its chance is unchanged. With v = 0.12 a race to 7 counts
as about nine games of twelve.

The weight also removes a bias. When the favorite has a bad day, a race takes more games, so
favorites win a smaller fraction of all games than they would in matches of equal length. In races
to 7 with v = 0.12, this bias shrinks every difference by 2 to 3%; with the weight, less than 0.2%
of bias is left.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import expit

from evenbreak.arrays import Floats
from evenbreak.ratings.likelihood_terms import race_slopes
from evenbreak.ratings.results import Results


def games_weight(difference: ArrayLike, games: ArrayLike, form: float) -> Floats:
    """Return the weight of matches whose games are known, at given log-odds of a game.

    `form` is √v, the standard deviation of a game's log-odds.

    >>> games_weight(0.0, [1, 12], 0.35).round(3)
    array([1.   , 0.748])
    """
    apart = np.asarray(difference, dtype=float)
    single = expit(apart) * expit(-apart)
    return np.asarray(1.0 / (1.0 + form**2 * (np.asarray(games) - 1.0) * single))


def form_weights(
    scored: Results, won_only: Results, skill: Floats, form: float
) -> tuple[Floats, Floats]:
    """Return the weights of matches whose games are known, and of those known only by their winner.

    For the latter, the information in the win replaces n p q. Skills are in log-odds; `form` is √v,
    the standard deviation of a game's log-odds.
    """
    apart, raced = (skill[part.player_a] - skill[part.player_b] for part in (scored, won_only))
    race_a, race_b = won_only.races
    known = (
        race_slopes(raced, race_a, race_b).slope * race_slopes(-raced, race_b, race_a).slope
    )  # W'² / (W (1 - W))
    beyond_a_game = np.maximum(known - expit(raced) * expit(-raced), 0.0)
    games = scored.score_a + scored.score_b
    return games_weight(apart, games, form), np.asarray(1.0 / (1.0 + form**2 * beyond_a_game))
