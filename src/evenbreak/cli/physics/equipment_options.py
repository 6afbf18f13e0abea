"""The options for cue, ball and cloth, and what they stand for."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from evenbreak.cli.physics.measures import measure_option

if TYPE_CHECKING:
    from evenbreak.answers.shot_units import Units
    from evenbreak.cli.kit.options import Command
    from evenbreak.physics import Ball, Cue

ball_option = measure_option(
    "--ball", "WEIGHT", 0.01, 1e5, "6", "Weight of a ball.  [default: 6 ounces]"
)
"""The option --ball."""

_OPTIONS = (
    measure_option(
        "--tip-mu",
        "MU",
        0.01,
        10.0,
        "0.6",
        "Static friction between tip and ball.  [default: 0.577, a miscue beyond half the radius]",
        default=1.0 / math.sqrt(3.0),
    ),
    measure_option(
        "--cloth-mu",
        "MU",
        0.01,
        1.0,
        "0.2",
        "Sliding friction between ball and cloth.",
        default=0.2,
        show_default=True,
    ),
    ball_option,
    measure_option(
        "--stick", "WEIGHT", 0.01, 1e5, "18", "Weight of the cue.  [default: 18 ounces]"
    ),
)


def equipment_options(command: Command) -> Command:
    """Add the options --stick, --ball, --cloth-mu and --tip-mu."""
    for option in _OPTIONS:
        command = option(command)
    return command


def ball_of(weight: float | None, units: Units) -> Ball:
    """Return a pool ball, of another weight if one was typed."""
    from evenbreak.physics import Ball

    return Ball() if weight is None else Ball(mass=weight * units.mass.size)


def cue_of(weight: float | None, tip_mu: float, units: Units) -> Cue:
    """Return a cue with such a tip, of another weight if one was typed."""
    from evenbreak.physics import Cue

    if weight is None:
        return Cue(tip_friction=tip_mu)
    return Cue(mass=weight * units.mass.size, tip_friction=tip_mu)
