"""What each rating is made of.

In the normal approximation, a skill is the precision-weighted mean of its sources. The precision of
the rating, 1/s², is the sum of the prior's, the J of the rating that the player brought (see
`evenbreak.ratings.beginning`), and that of the results, which is the remainder.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from evenbreak.ratings.fitted import Ratings

LEAST = 1e-3
"""Weight above which a source says something."""


class RatingSource(NamedTuple):
    """What one source, 'prior', 'brought' or 'results', says about a player's rating.

    The rating, in points, is None if the source says next to nothing; the weight is its share.
    """

    source: str
    rating: float | None
    standard_error: float | None
    weight: float


def rating_sources(ratings: Ratings, player: int) -> list[RatingSource]:
    """Return a player's rating as a weighted mean of what its sources say.

    If a rating that the player brought was made from results, the share of its own prior is taken
    out. The ratings must come from `fit` without named players as anchors.

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
