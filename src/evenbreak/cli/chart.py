"""`evenbreak chart`: charts of races, each of its commands in a module of its own."""

from __future__ import annotations

import click

from evenbreak.cli.groups import LazyGroup

__all__ = ["CHART_COMMANDS", "chart"]

CHART_COMMANDS = {
    "list": "List the charts that come with this program.",
    "show": "Show a chart: who needs how many games.",
    "audit": "Tell how fair a chart is, and which scale it was made for.",
    "design": "Design a chart for a scale.",
}
"""Each command with its line of help; `chart_list` of the module `chart_list`, and so on."""


@click.command(cls=LazyGroup, table=CHART_COMMANDS, prefix="chart_")
def chart() -> None:
    """List and show handicap charts, audit one, or design one.

    A chart says which race two players play, by the difference of their ratings or by
    their skill levels.
    """
