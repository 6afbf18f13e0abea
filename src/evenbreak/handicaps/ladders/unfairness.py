"""How unfair a night is: what wrong ratings do to the chance of winning a match."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from evenbreak.handicaps.ladders.opponent_pairs import meetings_of
from evenbreak.stats.summary import Distribution

if TYPE_CHECKING:
    from evenbreak.handicaps.ladders.ladder import Ladder

CLEAR_FAVOURITE = 0.6
"""From this chance to win a match on, a player counts as its clear favourite."""

_DIGITS = 12


def unfairness(ladder: Ladder) -> Distribution:
    """Return the law of P(the player wins) over the matches that he plays in the long run.

    Each chance is conditional on both players' skills and ratings before the match; how they
    feel that day (`day_sd`, `match_sd`) is averaged over. Player and opponent are independent,
    the player's error has the ladder's law.

    Parameters
    ----------
    ladder
        how the ratings move and whom the player meets.

    Notes
    -----
    A fair match has the chance 1/2, and so would all matches have if the ratings were right and
    the chart without steps. The standard deviation says how far a typical match is from it;
    `better_off` looks at whoever of the two is favoured. Chances within 1e-12 of each other are
    taken together. With several matches a night the form of the night is taken to be
    independent of the error, which later in a night it is not quite.

    >>> from evenbreak.handicaps import EQUAL_SKILL, Ladder, chart
    >>> law = unfairness(Ladder("npl", chart("npl_10"), opponents=EQUAL_SKILL))
    >>> round(law.sd, 3), round(law.quantile(0.05), 6), round(law.between(0.4, 0.6), 3)
    (0.089, 0.363281, 0.62)
    """
    meetings = meetings_of(ladder)
    own = np.asarray(ladder.law().probability, dtype=float)
    chances = meetings.wins()
    # Many opponents lead to the same pair of differences: add their chances up before sorting.
    pairs = meetings.places() * chances.shape[1] + meetings.ahead
    often = np.bincount(pairs.ravel(), np.outer(own, meetings.chance).ravel(), chances.size)
    met = often > 0.0
    values, place = np.unique(np.round(chances.ravel()[met], _DIGITS), return_inverse=True)
    weight = np.bincount(place, often[met])
    return Distribution(tuple(values.tolist()), tuple((weight / weight.sum()).tolist()))


def better_off(unfair: Distribution) -> Distribution:
    """Return the law of the chance of whoever is favoured: the larger of W and 1 - W.

    Its mean less 1/2 is the mean of `|W - 1/2|`; `at_least(0.6)` is the share of matches
    that have a clear favourite.

    Parameters
    ----------
    unfair
        the law of W, as `unfairness` returns it.

    >>> better_off(Distribution((0.375, 0.5, 0.75), (0.25, 0.5, 0.25)))
    Distribution(values=(0.5, 0.625, 0.75), probability=(0.5, 0.25, 0.25))
    """
    chances = np.array(unfair.values, dtype=float)
    larger = np.round(np.maximum(chances, 1.0 - chances), _DIGITS)
    values, place = np.unique(larger, return_inverse=True)
    weight = np.bincount(place.ravel(), np.array(unfair.probability, dtype=float))
    return Distribution(tuple(values.tolist()), tuple(weight.tolist()))
