"""New players filled in, as --starter and --starter-sd say."""

from __future__ import annotations

from evenbreak.cli.kit.values import refuse
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES, Scale


def with_starters(roster: Roster, scale: Scale, starter: float | None, sd: float | None) -> Roster:
    """Return the roster with new players filled in."""
    import numpy as np

    from evenbreak.handicaps.charts.gap import MOST_DOUBLINGS

    unrated = np.isnan(roster.rating)
    if unrated.any() and starter is None and scale.name not in SCALES:
        name = roster.players[int(unrated.argmax())]
        refuse(f"{name!r} has no rating; give the rating of a new player with --starter RATING")
    spread = scale.points_per_doubling if sd is None else sd
    most = MOST_DOUBLINGS * scale.points_per_doubling / 2.0
    if spread > most:
        refuse(
            f"--starter-sd is {spread:g}, which says nothing about a player; give {most:g} at most"
        )
    return roster.with_starters(scale.centre if starter is None else starter, spread, scale)
