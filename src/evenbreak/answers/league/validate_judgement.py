"""When a figure of a validated season is clearly off, and how figures are written."""

from collections.abc import Sequence

import numpy as np
from scipy.special import ndtri

from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.validation.calibration import Of, Scored
from evenbreak.ratings.validation.validate import HandicapFairness, Validation

UNLIKELY = 0.01
"""A p-value below which chance is ruled out; it is small because several tests are made."""

NEAR = 0.1
"""How far off starts may be: the hardest race of a chart serves all larger differences too."""

VAGUE = 0.5
"""An interval of the slope that is wider says too little."""


def clearly_off(estimate: Estimate, right: float, *, tests: int = 1) -> int:
    """Return 1 or -1 where an estimate is clearly above or below what is right, else 0.

    The more tests are made alike, the farther off it must be.

    >>> clearly_off(Estimate(0.5, 0.4, 0.6), 1.0), clearly_off(Estimate(0.9, 0.8, 1.0), 1.0)
    (-1, 0)
    """
    # The interval is of 95%, that is 1.96 standard errors each way; 2.58 leave out 1%.
    far = (estimate.high - estimate.low) / 2.0 * ndtri(1.0 - UNLIKELY / (2.0 * tests)) / 1.960
    middle = (estimate.high + estimate.low) / 2.0
    return int(middle - far > right) - int(middle + far < right)


def scored_of(found: Validation, of: Of) -> Scored:
    """Return how good one kind of prediction was."""
    return next(row for row in found.scored if (row.of, row.how) == (of, "integrated"))


def wrong_chances(scored: tuple[Scored, ...], found: Validation) -> dict[str, int]:
    """Return the predictions whose chances are clearly off: -1 too extreme, 1 too cautious."""
    # A fair handicap leaves matches without favourites, whatever the ratings say.
    judged = ("game",) if found.spots else ("game", "match")
    off = {
        row.of: clearly_off(row.slope, 1.0)
        for row in scored
        if row.how == "integrated" and row.of in judged and row.slope is not None
    }
    return {of: way for of, way in off.items() if way}


def share_of(spot: HandicapFairness) -> Estimate:
    """Return the share of handicap races that the player who gave games won."""
    return Estimate(spot.share, spot.low, spot.high)


def unfair_starts(spots: Sequence[HandicapFairness]) -> list[HandicapFairness]:
    """Return the starts that are clearly unfair by themselves, of those by the games given.

    >>> from evenbreak.ratings.estimates import wilson
    >>> fair, unfair = (HandicapFairness(k, 200, w, w / 200, *wilson(w / 200, 200), 0.5)
    ...                 for k, w in ((1, 96), (2, 130)))
    >>> [one.spot for one in unfair_starts([fair, unfair])]
    [2]
    """
    return [one for one in spots if clearly_off(share_of(one), 0.5, tests=len(spots))]


def starts_trend(spots: Sequence[HandicapFairness]) -> int:
    """Return 1 where players clearly win more often the more games they give, -1 where less, or 0.

    >>> from evenbreak.ratings.estimates import wilson
    >>> spots = [HandicapFairness(k, 200, w, w / 200, *wilson(w / 200, 200), 0.5)
    ...          for k, w in ((1, 84), (2, 100), (3, 118))]
    >>> starts_trend(spots), starts_trend(spots[:1])
    (1, 0)
    """
    if len(spots) < 2:
        return 0
    games, matches, won = (
        np.array([getattr(one, name) for one in spots], dtype=float)
        for name in ("spot", "matches", "won")
    )
    share = won.sum() / matches.sum()
    far = games - (games @ matches) / matches.sum()
    spread = share * (1.0 - share) * (matches @ far**2)
    z = far @ (won - matches * share) / np.sqrt(spread) if spread > 0.0 else 0.0
    return int(np.sign(z)) if abs(z) > ndtri(1.0 - UNLIKELY / 2.0) else 0


def starts_way(found: Validation, chart: LeagueChart | None = None) -> int:
    """Return 1 where starts clearly take back too little, -1 where too much, else 0.

    Where ratings are known, the scale that fits decides. Where the matches clearly say the
    opposite, it is 0 too.
    """
    way = 0
    if chart is not None and chart.scale is not None:
        way = scale_way(chart)
    elif found.starts is not None:
        share = found.starts.share
        way = int(clearly_off(share, 1.0 + NEAR) > 0) - int(clearly_off(share, 1.0 - NEAR) < 0)
    by_matches = clearly_off(share_of(found.spots[-1]), 0.5) if found.spots else 0
    return 0 if way == -by_matches else way


def scale_way(chart: LeagueChart) -> int:
    """Return 1 where clearly fewer points double the odds than the races assume, -1 where more."""
    if chart.scale is None:
        return 0
    # What a chart that is not known assumes is read off its races.
    near = 0.0 if chart.nearest is not None else NEAR / 2.0
    points, assumed = chart.scale.points, chart.scale.assumed
    fewer = clearly_off(points, assumed * (1.0 - near)) < 0
    return int(fewer) - int(clearly_off(points, assumed * (1.0 + near)) > 0)


def points_text(prior_sd: float, scale: Scale) -> str:
    """Return a prior's standard deviation in points."""
    return f"{prior_sd * scale.points_per_log_odds:.3g}"


def more_or_less(more: bool) -> str:
    """Return 'more' or 'less'."""
    return "more" if more else "less"
