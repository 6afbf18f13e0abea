"""A word on ratings that do not look like those of the scale by which they are read."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from evenbreak.ratings.scale import Scale

FAR = 3.0
"""Doublings of the odds that a league is not away from the middle of its scale."""

APART = 6.0
"""Doublings of the odds that no player of a league is away from its middle: 64 games to 1."""


def scale_doubts(scale: Scale, ratings: ArrayLike, remedy: str) -> list[str]:
    """Return what is odd in the ratings of a league, a note each; NaN is no rating.

    >>> from evenbreak.ratings import SCALES
    >>> scale_doubts(SCALES["npl"], [560, 600, 640], "--scale says")
    ['Note: ratings on the npl scale are about 80, here they are about 600; --scale says']
    >>> scale_doubts(SCALES["npl"], [70, 80, 94, 560], "")
    ['Note: 1 of 4 ratings is more than 180 points from the middle of 87; are all on one scale?']
    """
    import numpy as np

    known = np.asarray(ratings, dtype=float)
    known = known[~np.isnan(known)]
    if not len(known):
        return []
    told = []
    middle = float(np.median(known))  # one slip makes no other scale
    if scale.centre and abs(middle - scale.centre) > FAR * scale.points_per_doubling:
        told.append(
            f"Note: ratings on the {scale.name} scale are about {scale.centre:g}, here they are "
            f"about {middle:.0f}; {remedy}"
        )
    edge = APART * scale.points_per_doubling
    apart = int((np.abs(known - middle) > edge).sum())
    if apart:
        told.append(
            f"Note: {apart:,} of {len(known):,} ratings {'is' if apart == 1 else 'are'} more than "
            f"{edge:.0f} points from the middle of {middle:.0f}; are all on one scale?"
        )
    return told
