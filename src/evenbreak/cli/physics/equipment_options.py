"""The options for cue, ball and cloth, and what they stand for."""

from __future__ import annotations

import math

import click

from evenbreak import physics
from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.physics.measures import WEIGHT, Measure

ball_option = click.option("--ball", type=WEIGHT, help="Weight of a ball.  [default: 6 ounces]")
"""The option --ball."""

_OPTIONS = (
    click.option(
        "--tip-mu",
        type=Measure("mu", 0.01, 10.0, "0.6"),
        default=1.0 / math.sqrt(3.0),
        show_default=False,
        help="Static friction between tip and ball.  "
        "[default: 0.577, a miscue beyond half the radius]",
    ),
    click.option(
        "--cloth-mu",
        type=Measure("mu", 0.01, 1.0, "0.2"),
        default=0.2,
        help="Sliding friction between ball and cloth.",
    ),
    ball_option,
    click.option("--stick", type=WEIGHT, help="Weight of the cue.  [default: 18 ounces]"),
)


def equipment_options(command: Command) -> Command:
    """Add the options --stick, --ball, --cloth-mu and --tip-mu."""
    return with_options(command, *_OPTIONS)


def ball_of(weight: float | None, units: Units) -> physics.Ball:
    """Return a pool ball, of another weight if one was typed."""
    return physics.Ball() if weight is None else physics.Ball(mass=weight * units.mass.size)


def cue_of(weight: float | None, tip_mu: float, units: Units) -> physics.Cue:
    """Return a cue with such a tip, of another weight if one was typed."""
    if weight is None:
        return physics.Cue(tip_friction=tip_mu)
    return physics.Cue(mass=weight * units.mass.size, tip_friction=tip_mu)
