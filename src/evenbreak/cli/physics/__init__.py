"""`evenbreak physics`: ball, cloth and cue, a command a module."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "speed": Entry("physics.commands:speed", "Find how fast a table is, from the time of a lag."),
    "throw": Entry(
        "physics.commands:throw", "Find how far friction throws the object ball off its line."
    ),
    "aim": Entry("physics.commands:aim", "Find where to aim to allow for throw."),
    "deflect": Entry("physics.commands:deflect", "Find where the cue ball goes after the hit."),
    "strike": Entry(
        "physics.commands:strike", "Find the spin and speed that a hit off centre gives."
    ),
    "breakcue": Entry("physics.commands:breakcue", "Find the weight of the cue that breaks best."),
    "shot": Entry("physics.commands:shot", "Trace a whole shot, and draw it."),
}
"""Each command, in the module of its name, with its line of help."""


@click.command("physics", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Calculate what ball, cloth and cue do: throw, aim, spin, the cue ball's path.

    Lengths are in inches, weights in ounces, speeds in inches per second, angles in degrees;
    with --metric in centimetres, grams and metres per second. Spin J is the speed of the
    ball's rim over the speed of the ball: a topspin of 1 is natural roll.
    """
