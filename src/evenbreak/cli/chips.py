"""`evenbreak chips`: chip tournaments and their charts."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "odds": Entry("", "Find each player's odds in a chip tournament."),
    "audit": Entry("", "Check whom a chip chart favours."),
    "design": Entry("", "Design a fairer chip chart."),
}
"""Each command, with its line of help."""


@click.command("chips", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Find the odds of chip tournaments; audit and design chip charts.

    In a chip tournament the loser of a rack pays a chip and goes to the end of the line, the
    winner stays at the table, and whoever has no chips left is out. Weaker players start with
    more chips, by a chart.
    """
