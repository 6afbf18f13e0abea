"""The scale of ratings that do not say what it is: the numbers decide, or the user must.

612 can only be a Fargo rating, and 92 only one of the NPL. Where a list fits no single scale, a
guess could turn a favorite of 59% into one of 76%, so none is made. Nor are ratings read on the
scale that a chart or a system brings along if they look like those of another.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Sequence

from evenbreak.errors import InputError
from evenbreak.ratings.scale import NAMES, SCALES, Scale

DEFAULT_SCALE = "npl"
"""The scale of ratings that are estimated from results, and of lists without a single rating."""

USUAL = {"npl": (-50.0, 150.0), "fargo": (150.0, 950.0), "elo": (1000.0, 3000.0)}
"""Where the ratings of a scale lie, from the weakest beginners to the best players."""


def unstated_scale(
    ratings: Iterable[float], names: Sequence[str], remedy: str, source: str = ""
) -> Scale:
    """Return the only scale that all ratings can be on; without a rating, the default one.

    Parameters
    ----------
    ratings
        of each player; NaN is no rating.
    names
        of the players.
    remedy
        how the user can state the scale, which ends the message.
    source
        where the ratings are from, which starts the message.

    Raises
    ------
    InputError
        if they fit no scale, or two; it says what the ratings would mean on each.

    >>> unstated_scale([612, float("nan")], ["Ann", "Bo"], "say which").name
    'fargo'
    >>> unstated_scale([190, 140], ["Ann", "Bo"], "say which")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: the ratings from 140 to 190 do not show their scale: Ann wins a
    game against Bo 76% of the time by NPL ratings, 59% by Fargo ratings, 57% by Elo ratings; say
    which
    """
    rated = [(rating, k) for k, rating in enumerate(ratings) if not math.isnan(rating)]
    if not rated:
        return SCALES[DEFAULT_SCALE]
    (low, last), (high, first) = min(rated), max(rated)
    possible = [name for name, (least, most) in USUAL.items() if least <= low <= high <= most]
    if len(possible) == 1:
        return SCALES[possible[0]]
    where = f"{source}: " if source else ""
    if low == high:
        raise InputError(f"{where}the rating {high:g} does not show its scale; {remedy}")
    raise InputError(
        f"{where}the ratings from {low:g} to {high:g} do not show their scale: {names[first]} wins "
        f"a game against {names[last]} {_readings(high - low, SCALES)}; {remedy}"
    )


def refuse_contradicted(
    scale: Scale, ratings: Iterable[float], names: Sequence[str], *, whose: str, remedy: str
) -> None:
    """Refuse ratings that do not look like those of the scale by which something would read them.

    One rating is far off after a slip, so the one in the middle decides.

    Parameters
    ----------
    scale
        a known scale; what ratings of another look like is not known, so none is refused.
    ratings
        of each player; NaN is no rating.
    names
        of the players.
    whose
        what brings the scale along: 'the chart npl_10'.
    remedy
        how the user can state the scale, which ends the message.

    Raises
    ------
    InputError
        with what they would mean on this scale and on those that they look like.

    >>> refuse_contradicted(
    ...     SCALES["npl"], [612, 521], ["Ann", "Bo"], whose="the chart npl_10", remedy="say which"
    ... )
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: the ratings from 521 to 612 do not look like NPL ratings, the
    scale of the chart npl_10: Ann wins a game against Bo 89% of the time by NPL ratings, 65% by
    Fargo ratings; say which
    """
    rated = [(rating, k) for k, rating in enumerate(ratings) if not math.isnan(rating)]
    if scale.name not in USUAL or not rated:
        return
    middle = statistics.median(rating for rating, _ in rated)
    like = [name for name, (least, most) in USUAL.items() if least <= middle <= most]
    if scale.name in like:
        return
    (low, last), (high, first) = min(rated), max(rated)
    title = NAMES[scale.name]
    if low == high:
        looks = " or ".join(NAMES[name] for name in like or set(USUAL) - {scale.name})
        raise InputError(
            f"the rating {high:g} does not look like one of {title}, the scale of {whose}, but "
            f"like one of {looks}; {remedy}"
        )
    raise InputError(
        f"the ratings from {low:g} to {high:g} do not look like {title} ratings, the scale of "
        f"{whose}: {names[first]} wins a game against {names[last]} "
        f"{_readings(high - low, [scale.name, *(like or set(USUAL) - {scale.name})])}; {remedy}"
    )


def _readings(gap: float, scales: Iterable[str]) -> str:
    """Return how often a player this far ahead wins a game, by each of some scales."""
    shares = [(name, SCALES[name].win_probability(gap)) for name in scales]
    return ", ".join(
        f"{share:.0%}{' of the time' * (k == 0)} by {NAMES[name]} ratings"
        for k, (name, share) in enumerate(shares)
    )
