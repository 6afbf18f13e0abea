"""`evenbreak physics`: the table side, each of its commands in a module of its own."""

from __future__ import annotations

import click

from evenbreak.cli.groups import LazyGroup

__all__ = ["PHYSICS_COMMANDS", "physics"]

PHYSICS_COMMANDS = {
    "speed": "Tell the speed of a table from the time of a lag.",
    "throw": "Tell how far friction throws the object ball off its line.",
    "aim": "Tell where to aim, so that the thrown ball goes in.",
    "deflect": "Tell where the cue ball goes after the hit.",
    "strike": "Tell what spin and speed a hit off centre gives.",
    "breakcue": "Tell which cue breaks best for an arm.",
    "shot": "Trace a shot, and draw it on its table.",
}
"""Each command with its line of help; `physics_speed` of the module `physics_speed`, and so on."""


@click.command(cls=LazyGroup, table=PHYSICS_COMMANDS, prefix="physics_")
def physics() -> None:
    """Answer what ball, cloth and cue do: throw, aim, deflection, spin.

    Lengths are in inches, weights in ounces, speeds in inches a second, angles in degrees;
    with --metric in centimetres, grams and metres a second. Spin is J = R omega / V: a
    topspin of 1 is natural roll.
    """
