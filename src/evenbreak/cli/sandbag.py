"""`evenbreak sandbag`: losing on purpose, each of its commands in a module of its own."""

from __future__ import annotations

import importlib

import click

__all__ = ["SANDBAG_COMMANDS", "sandbag"]

SANDBAG_COMMANDS = {
    "pay": "Tell what it pays to lose matches on purpose.",
    "watch": "Weigh the results of a league for sandbagging.",
    "power": "Tell how soon the watch sees a sandbagger.",
}
"""Each command with its line of help; `sandbag_pay` of the module `sandbag_pay`, and so on."""


class SandbagCommands(click.Group):
    """A click group that imports a command only to run it."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """Return the names of the commands, in the order of the help text."""
        return list(SANDBAG_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import and return a command, or None if there is none of that name."""
        if cmd_name not in SANDBAG_COMMANDS:
            return None
        name = f"sandbag_{cmd_name}"
        command: click.Command = getattr(importlib.import_module(f"evenbreak.cli.{name}"), name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the list of commands from the table, without importing any."""
        with formatter.section("Commands"):
            formatter.write_dl(list(SANDBAG_COMMANDS.items()))


@click.command(cls=SandbagCommands)
def sandbag() -> None:
    """Tell what losing on purpose pays, and whether it can be seen.

    A sandbagger loses matches that count for little, so that his rating falls, and is given
    games in those that count.
    """
