"""The options that say how fast matches are played: --discipline or --minutes-per-game."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.kit.values import Number, refuse

if TYPE_CHECKING:
    from evenbreak.matches.pace import Pace

DISCIPLINES = ("8-ball", "9-ball", "10-ball")
MINUTES = Number(0.001, 1440.0, " is not a number of minutes; give one such as 8 or 7.5")
TURNOVER = Number(0.0, 1440.0, " is not a number of minutes; give one such as 5, or 0")


def pace_options(command: Command) -> Command:
    """Add --discipline and --minutes-per-game."""
    return with_options(
        command,
        click.option(
            "--minutes-per-game",
            metavar="MINUTES",
            type=MINUTES,
            help="Give the lengths in minutes, at this pace on average.",
        ),
        click.option(
            "--discipline",
            type=click.Choice(DISCIPLINES),
            help="Give the lengths in minutes, at the usual pace of this game.",
        ),
    )


def stated_pace(discipline: str | None, minutes_per_game: float | None) -> Pace | str | None:
    """Return the discipline or the pace that the options state, None if they state none."""
    from evenbreak.matches.pace import own_pace

    if discipline is not None and minutes_per_game is not None:
        refuse("--discipline and --minutes-per-game cannot be combined; leave one out")
    return discipline if minutes_per_game is None else own_pace(minutes_per_game)
