"""The chance of a match result by plain sums, for the tests of the fast one."""

from math import comb

from evenbreak.ratings.scale import SCALES
from evenbreak.stats.summary import Distribution

NPL = SCALES["npl"]
LAW = Distribution((-6, 0, 6), (0.25, 0.5, 0.25))
"""Of the opponents' rating errors."""


def ends(m, n):
    """Return all final scores of a race, each with the ways in which it comes about."""
    won = [((m, k), comb(m - 1 + k, k), True) for k in range(n)]
    return won + [((k, n), comb(n - 1 + k, k), False) for k in range(m)]


def chance(games, difference):
    """Return the chance of a score in one of its ways, over the errors of the opponent."""
    return sum(
        float(w)
        * NPL.win_probability(difference + e) ** games[0]
        * NPL.win_probability(-difference - e) ** games[1]
        for e, w in zip(LAW.values, LAW.probability, strict=True)
    )
