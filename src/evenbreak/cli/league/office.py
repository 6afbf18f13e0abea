"""`evenbreak league`: what a league's office makes."""

from __future__ import annotations

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

COMMANDS = {
    "init": Entry("league.init", "Write league.toml from what is in a league's folder."),
    "tidy": Entry("league.tidy:tidy", "One clean list of matches out of all files of results."),
    "table": Entry("league.tables:table", "The table: who is ahead of whom, and why."),
    "fixtures": Entry("league.tables:fixtures", "Who plays whom, when and where; what is left."),
}
"""Each command, with its line of help."""


@click.command("league", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Run the office of a league."""
