"""`evenbreak chart`: charts of races, each of its commands in a module of its own."""

from __future__ import annotations

import importlib

import click

__all__ = ["CHART_COMMANDS", "chart"]

CHART_COMMANDS = {
    "list": "List the charts that come with this program.",
    "show": "Show a chart: who needs how many games.",
    "audit": "Tell how fair a chart is, and which scale it was made for.",
    "design": "Design a chart for a scale.",
}
"""Each command with its line of help; `chart_list` of the module `chart_list`, and so on."""


class ChartCommands(click.Group):
    """A click group that imports a command only to run it."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """Return the names of the commands, in the order of the help text."""
        return list(CHART_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import and return a command, or None if there is none of that name."""
        if cmd_name not in CHART_COMMANDS:
            return None
        name = f"chart_{cmd_name}"
        command: click.Command = getattr(importlib.import_module(f"evenbreak.cli.{name}"), name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the list of commands from the table, without importing any."""
        with formatter.section("Commands"):
            formatter.write_dl(list(CHART_COMMANDS.items()))


@click.command(cls=ChartCommands)
def chart() -> None:
    """List and show handicap charts, audit one, or design one.

    A chart says which race two players play, by the difference of their ratings or by
    their skill levels.
    """
