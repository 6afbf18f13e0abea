"""`evenbreak chart list`: the charts that come with evenbreak."""

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces


@click.command("list")
@faces()
def command() -> Answer:
    """List the charts that come with evenbreak.

    Each with the number of its different races, and the games of its longest match.
    """
    from evenbreak.answers.chart_list import chart_list_answer

    return chart_list_answer()
