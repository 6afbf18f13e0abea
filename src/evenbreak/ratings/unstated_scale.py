"""The scale of ratings that do not say what it is: the numbers decide, or the user must.

612 can only be a Fargo rating, and 92 only one of the NPL. Where a list fits no single scale, a
guess could turn a favorite of 59% into one of 76%, so none is made.
"""

from __future__ import annotations

import math
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
    readings = [
        f"{scale.win_probability(high - low):.0%}{' of the time' * (name == 'npl')} by "
        f"{NAMES[name]} ratings"
        for name, scale in SCALES.items()
    ]
    raise InputError(
        f"{where}the ratings from {low:g} to {high:g} do not show their scale: {names[first]} wins "
        f"a game against {names[last]} {', '.join(readings)}; {remedy}"
    )
