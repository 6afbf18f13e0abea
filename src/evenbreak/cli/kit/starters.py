"""The options that say how strong a new player is: --starter and --starter-sd."""

from __future__ import annotations

import click

from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.kit.values import Number, refuse
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES, Scale

POINTS = Number(-1e6, 1e6, " is not a number of rating points; give one such as 80")
SPREAD = Number(0.0, 1e6, " is not a spread; give 0 or more points, such as 30")


def starter_options(command: Command) -> Command:
    """Add --starter and --starter-sd."""
    return with_options(
        command,
        click.option(
            "--starter-sd",
            metavar="POINTS",
            type=SPREAD,
            help="How far off that may be (standard deviation).  [default: what doubles the odds]",
        ),
        click.option(
            "--starter",
            metavar="RATING",
            type=POINTS,
            help="The rating of a new player.  [default: the middle of the scale]",
        ),
    )


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
