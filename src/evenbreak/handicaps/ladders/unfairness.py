"""How unfair matches are: what wrong ratings do to the chance of winning."""

from __future__ import annotations

import numpy as np

from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponent_pairs import opponent_pairs_of
from evenbreak.stats.summary import Distribution

CLEAR_FAVOURITE = 0.6
"""A player with at least this chance to win a match is its clear favourite."""

_DIGITS = 12


def unfairness(ladder: Ladder) -> Distribution:
    """Return the distribution of P(the player wins) over the matches of the long run.

    Each chance is conditional on both players' skills and ratings before the match and averaged
    over their form (`day_sd`, `match_sd`). Player and opponent are independent, and the player's
    error has the ladder's distribution.

    Parameters
    ----------
    ladder
        how the ratings move and who the player meets.

    Notes
    -----
    A fair match has the chance 1/2; every match would, if ratings were right and the chart had no
    steps. The standard deviation is how far a typical match is from that; `better_off` looks at
    the favourite of each match. Chances within 1e-12 of each other are put together. With several
    matches a night the night's form is taken to be independent of the error, which is not quite
    true later in the night.

    >>> from evenbreak.handicaps import EQUAL_SKILL, Ladder, chart
    >>> law = unfairness(Ladder("npl", chart("npl_10"), opponents=EQUAL_SKILL))
    >>> round(law.sd, 3), round(law.quantile(0.05), 6), round(law.between(0.4, 0.6), 3)
    (0.089, 0.363281, 0.62)
    """
    met = opponent_pairs_of(ladder)
    own = np.asarray(ladder.law().probability, dtype=float)
    chances = met.wins()
    # Many opponents lead to the same two differences: add up their chances before sorting.
    places = met.places() * chances.shape[1] + met.ahead
    often = np.bincount(places.ravel(), np.outer(own, met.chance).ravel(), chances.size)
    occurs = often > 0.0
    values, place = np.unique(np.round(chances.ravel()[occurs], _DIGITS), return_inverse=True)
    weight = np.bincount(place, often[occurs])
    return Distribution(tuple(values.tolist()), tuple((weight / weight.sum()).tolist()))


def better_off(unfair: Distribution) -> Distribution:
    """Return the distribution of the favourite's chance: the larger of W and 1 - W.

    Its mean less 1/2 is the mean of `|W - 1/2|`; `at_least(0.6)` is the share of matches
    with a clear favourite.

    Parameters
    ----------
    unfair
        the distribution of W, as `unfairness` returns it.

    >>> better_off(Distribution((0.375, 0.5, 0.75), (0.25, 0.5, 0.25)))
    Distribution(values=(0.5, 0.625, 0.75), probability=(0.5, 0.25, 0.25))
    """
    chances = np.array(unfair.values, dtype=float)
    larger = np.round(np.maximum(chances, 1.0 - chances), _DIGITS)
    values, place = np.unique(larger, return_inverse=True)
    weight = np.bincount(place.ravel(), np.array(unfair.probability, dtype=float))
    return Distribution(tuple(values.tolist()), tuple(weight.tolist()))
