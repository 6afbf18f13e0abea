"""`evenbreak sandbag`: losing on purpose, each of its commands in a module of its own."""

from __future__ import annotations

import click

from evenbreak.cli.groups import LazyGroup

__all__ = ["SANDBAG_COMMANDS", "sandbag"]

SANDBAG_COMMANDS = {
    "pay": "Tell what it pays to lose matches on purpose.",
    "watch": "Weigh the results of a league for sandbagging.",
    "power": "Tell how soon the watch sees a sandbagger.",
}
"""Each command with its line of help; `sandbag_pay` of the module `sandbag_pay`, and so on."""


@click.command(cls=LazyGroup, table=SANDBAG_COMMANDS, prefix="sandbag_")
def sandbag() -> None:
    """Tell what losing on purpose pays, and whether it can be seen.

    A sandbagger loses matches that count for little, so that his rating falls, and is given
    games in those that count.
    """
