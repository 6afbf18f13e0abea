"""What a shot is played with: the options for cue, ball and cloth, and what they stand for."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from evenbreak.cli.physics.units import METRIC, PLAYERS, Measure, Units

if TYPE_CHECKING:
    from evenbreak.cli.kit.callbacks import Command
    from evenbreak.physics import Ball, Cue

_USUAL = {
    "stick": ((10.0, 30.0), (280.0, 850.0)),
    "ball": ((3.0, 10.0), (85.0, 285.0)),
    "forearm": ((10.0, 320.0), (280.0, 9000.0)),
    "speed": ((0.0, 600.0), (0.0, 15.0)),
    "stick_speed": ((0.0, 600.0), (0.0, 15.0)),
}
"""What is believed of an option: from where to where, in players' and in metric units."""


def kit_options(command: Command) -> Command:
    """Add the options --stick, --ball, --cloth-mu and --tip-mu."""
    for option in (
        click.option(
            "--tip-mu",
            metavar="MU",
            type=Measure(0.01, 10.0, "0.6"),
            default=1.0 / math.sqrt(3.0),
            help="Static friction between tip and ball.  "
            "[default: 0.577, a miscue beyond half the radius]",
        ),
        click.option(
            "--cloth-mu",
            metavar="MU",
            type=Measure(0.01, 1.0, "0.2"),
            default=0.2,
            show_default=True,
            help="Sliding friction between ball and cloth.",
        ),
        click.option(
            "--ball",
            metavar="WEIGHT",
            type=Measure(0.01, 1e5, "6"),
            help="Of a ball.  [default: 6 ounces]",
        ),
        click.option(
            "--stick",
            metavar="WEIGHT",
            type=Measure(0.01, 1e5, "18"),
            help="Of the cue.  [default: 18 ounces]",
        ),
    ):
        command = option(command)
    return command


def doubts(units: Units, **typed: float | None) -> str:
    """Return a line for each option with a number that no player has, as in wrong units.

    >>> doubts(PLAYERS, stick=19.0, ball=None, stick_speed=60.0)
    ''
    >>> doubts(PLAYERS, ball=170.0).strip()
    'Is --ball 170 ounces? 3 to 10 are usual; --metric takes grams.'
    """
    lines = []
    for name, value in typed.items():
        low, high = _USUAL[name][units is not PLAYERS]
        if value is None or low <= value <= high:
            continue
        speed = name.endswith("speed")
        read, other = (
            (its.speed_word if speed else its.mass_word)
            for its in (units, METRIC if units is PLAYERS else PLAYERS)
        )
        remedy = (
            f"--metric takes {other}" if units is PLAYERS else f"without --metric it is {other}"
        )
        lines.append(
            f"\nIs --{name.replace('_', '-')} {value:g} {read}? {low:g} to {high:g} are usual; "
            f"{remedy}."
        )
    return "".join(lines)


def ball_of(weight: float | None, units: Units) -> Ball:
    """Return a pool ball, of another weight if one was typed."""
    from evenbreak.physics import Ball

    return Ball() if weight is None else Ball(mass=weight * units.mass)


def cue_of(weight: float | None, tip_mu: float, units: Units) -> Cue:
    """Return a cue with such a tip, of another weight if one was typed."""
    from evenbreak.physics import Cue

    if weight is None:
        return Cue(tip_friction=tip_mu)
    return Cue(mass=weight * units.mass, tip_friction=tip_mu)
