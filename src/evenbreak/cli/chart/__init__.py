"""`evenbreak chart`: charts of races, each of its commands in a module of its own."""

from __future__ import annotations

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "list": Entry("chart.list", "List the charts that come with this program."),
    "show": Entry("chart.show", "Show a chart: who needs how many games."),
    "audit": Entry("chart.audit", "Tell how fair a chart is, and which scale it was made for."),
    "design": Entry("chart.design", "Design a chart for a scale."),
}
"""Each command, in the module of its name, with its line of help."""


@click.command("chart", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """List and show handicap charts, audit one, or design one.

    A chart says which race two players play, by the difference of their ratings or by
    their skill levels.
    """
