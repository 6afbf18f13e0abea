"""`evenbreak physics`: the table side, each of its commands in a module of its own."""

from __future__ import annotations

import importlib

import click

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


class PhysicsCommands(click.Group):
    """A click group that imports a command only to run it."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """Return the names of the commands, in the order of the help text."""
        return list(PHYSICS_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import and return a command, or None if there is none of that name."""
        if cmd_name not in PHYSICS_COMMANDS:
            return None
        name = f"physics_{cmd_name}"
        command: click.Command = getattr(importlib.import_module(f"evenbreak.cli.{name}"), name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the list of commands from the table, without importing any."""
        with formatter.section("Commands"):
            formatter.write_dl(list(PHYSICS_COMMANDS.items()))


@click.command(cls=PhysicsCommands)
def physics() -> None:
    """Answer what ball, cloth and cue do: throw, aim, deflection, spin.

    Lengths are in inches, weights in ounces, speeds in inches a second, angles in degrees;
    with --metric in centimetres, grams and metres a second. Spin is J = R omega / V: a
    topspin of 1 is natural roll.
    """
