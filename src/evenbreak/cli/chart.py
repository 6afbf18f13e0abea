"""`evenbreak chart`: list, show, audit and design handicap charts."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "list": Entry("", "List the charts that there are."),
    "show": Entry("", "Show a chart: who needs how many games."),
    "audit": Entry("", "Check how fair a chart is, and which ratings it fits."),
    "design": Entry("", "Design the fairest chart for given ratings."),
    "team": Entry("", "Find the points that the weaker of two teams gets."),
}
"""Each command, with its line of help."""


@click.command("chart", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """List, show, audit and design handicap charts.

    A chart gives the race that two players play, by the difference of their ratings or
    by their skill levels.
    """
