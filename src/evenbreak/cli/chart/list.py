"""`evenbreak chart list`: the charts that come with evenbreak."""

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces


@click.command("list")
@faces()
def command() -> Answer:
    """List the charts that come with evenbreak.

    Each is shown with its number of different races and the length of its longest match.
    """
    from evenbreak.answers.chart.show import chart_list_answer

    return chart_list_answer()
