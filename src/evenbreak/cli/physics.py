"""`evenbreak physics`: ball, cloth and cue."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "speed": Entry("", "Find how fast a table is, from the time of a lag."),
    "throw": Entry("", "Find how far friction throws the object ball off its line."),
    "aim": Entry("", "Find where to aim to allow for throw."),
    "deflect": Entry("", "Find where the cue ball goes after the hit."),
    "strike": Entry("", "Find the spin and speed that a hit off centre gives."),
    "breakcue": Entry("", "Find the weight of the cue that breaks best."),
    "shot": Entry("", "Trace a whole shot, and draw it."),
}
"""Each command, with its line of help."""


@click.command("physics", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Calculate what ball, cloth and cue do: throw, aim, spin, the cue ball's path.

    Lengths are in inches, weights in ounces, speeds in inches per second, angles in degrees;
    with --metric in centimetres, grams and metres per second. Spin J is the speed of the
    ball's rim over the speed of the ball: a topspin of 1 is natural roll.
    """
