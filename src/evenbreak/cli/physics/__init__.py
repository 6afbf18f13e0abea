"""`evenbreak physics`: the table side, each of its commands in a module of its own."""

from __future__ import annotations

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "speed": Entry("physics.speed", "Tell the speed of a table from the time of a lag."),
    "throw": Entry("physics.throw", "Tell how far friction throws the object ball off its line."),
    "aim": Entry("physics.aim", "Tell where to aim, so that the thrown ball goes in."),
    "deflect": Entry("physics.deflect", "Tell where the cue ball goes after the hit."),
    "strike": Entry("physics.strike", "Tell what spin and speed a hit off centre gives."),
    "breakcue": Entry("physics.breakcue", "Tell which cue breaks best for an arm."),
    "shot": Entry("physics.shot", "Trace a shot, and draw it on its table."),
}
"""Each command, in the module of its name, with its line of help."""


@click.command("physics", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Answer what ball, cloth and cue do: throw, aim, deflection, spin.

    Lengths are in inches, weights in ounces, speeds in inches a second, angles in degrees;
    with --metric in centimetres, grams and metres a second. Spin is J = R omega / V: a
    topspin of 1 is natural roll.
    """
