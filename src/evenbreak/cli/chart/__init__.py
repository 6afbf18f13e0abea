"""`evenbreak chart`: charts of races, with each of its commands in a module of its own."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "list": Entry("chart.list", "List the charts that come with evenbreak."),
    "show": Entry("chart.show", "Show a chart: who needs how many games."),
    "audit": Entry("chart.audit", "Check how fair a chart is, and which ratings it fits."),
    "design": Entry("chart.design", "Design the fairest chart for given ratings."),
    "team": Entry("chart.team", "Find the points that the weaker of two teams gets."),
}
"""Each command, with its module and its line of help."""


@click.command("chart", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """List, show, audit and design handicap charts.

    A chart gives the race that two players play, by the difference of their ratings or
    by their skill levels.
    """
