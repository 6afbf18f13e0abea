"""`evenbreak sandbag`: losing on purpose, each of its commands in a module of its own."""

from __future__ import annotations

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "pay": Entry("sandbag.pay", "Tell what it pays to lose matches on purpose."),
    "watch": Entry("sandbag.watch", "Weigh the results of a league for sandbagging."),
    "power": Entry("sandbag.power", "Tell how soon the watch sees a sandbagger."),
}
"""Each command, in the module of its name, with its line of help."""


@click.command("sandbag", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Tell what losing on purpose pays, and whether it can be seen.

    A sandbagger loses matches that count for little, so that his rating falls, and is given
    games in those that count.
    """
