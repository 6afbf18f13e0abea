"""`evenbreak sandbag`: losing on purpose, each of its commands in a module of its own."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "pay": Entry("sandbag.pay", "Show what it pays to lose matches on purpose."),
    "watch": Entry("sandbag.watch", "Check the results of a league for sandbagging."),
}
"""Each command, in the module of its name, with its line of help."""


@click.command("sandbag", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Show what losing on purpose pays, and whether it can be seen.

    A sandbagger loses matches that count for little, so that their rating falls and they
    are given games in the matches that count.
    """
