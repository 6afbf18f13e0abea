"""What each rating is made of.

In the normal approximation a skill is the mean of what each source says, weighted by precision:
1/s² for the rating is that of the prior, plus J of the rating brought along (see
`evenbreak.ratings.beginning`), plus that of the results, which is what is left.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from evenbreak.ratings.fitted import Ratings

LEAST = 1e-3
"""The weight from which a source says something."""


class RatingSource(NamedTuple):
    """What one source, 'prior', 'brought' or 'results', says about a player's rating.

    Ratings, in points, are None where it says next to nothing; the weight is its share.
    """

    source: str
    rating: float | None
    standard_error: float | None
    weight: float


def rating_sources(ratings: Ratings, player: int) -> list[RatingSource]:
    """Return what a player's rating is made of: the ratings, by weight, have it as their mean.

    Of a rating that was made from results the part that its own prior had in it is taken out. The
    ratings are those of `fit` without named players as its anchor.

    >>> from evenbreak.ratings import Beginning, Levels, Results, fit
    >>> old = Beginning(["Ann", "Bo"], [95, 65], [10, 10])
    >>> night = Results.from_names(["Ann"], ["Bo"], [7], [5])
    >>> for one in rating_sources(fit(night, levels=Levels(beginning=old)), 0):
    ...     print(one.source, round(one.rating, 1), round(one.weight, 2))
    prior 80.0 0.09
    brought 95.0 0.81
    results 80.8 0.11
    """
    means = ratings.prior_means
    unit = ratings.scale.points_per_log_odds
    rating, error = (float(column[player]) for column in (ratings.rating, ratings.standard_error))
    prior = 1.0 / (ratings.prior_sd**2 + float(means.design[player] ** 2 @ means.level_sd**2))
    said = {"prior": (prior, float(ratings.expected[player]))}
    if means.known is not None and (brought := float(means.information[player])) > 0.0:
        points = ratings.anchor + unit * float(means.known.pull[player]) / brought
        said["brought"] = brought, points
    before = sum(precision for precision, _ in said.values())
    whole = max((unit / error) ** 2, before)
    left = whole - before
    pull = whole * rating - sum(precision * points for precision, points in said.values())
    said["results"] = left, pull / left if left > LEAST * whole else math.nan
    return [
        RatingSource(name, points, unit / math.sqrt(precision), precision / whole)
        if precision > LEAST * whole
        else RatingSource(name, None, None, precision / whole)
        for name, (precision, points) in said.items()
    ]
