"""`evenbreak tournament`: tonight's tournament, each of its commands in a module of its own."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "odds": Entry("tournament.odds", "Find each player's odds of winning the tournament."),
    "time": Entry("tournament.time", "Find when the tournament ends, and when each match starts."),
}
"""Each command, in the module of its name, with its line of help."""


@click.command("tournament", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Find the odds of tonight's tournament, and when it ends."""
