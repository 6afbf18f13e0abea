"""`evenbreak chart show`: the races of a chart."""

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces

EXAMPLES = """\b
Examples:
  evenbreak chart show npl_10
  evenbreak chart show apa_8ball
  evenbreak chart show npl_8 > ours.csv
"""


@click.command("show", epilog=EXAMPLES)
@click.argument("chart", metavar="NAME_OR_FILE")
@faces()
def command(chart: str) -> Answer:
    """Show a chart: who needs how many games.

    NAME_OR_FILE is a chart from `evenbreak chart list` or a CSV file. Into a pipe or
    a file the chart is written as such a CSV file, which you can edit and use.
    """
    from evenbreak.answers.chart.show import chart_show_answer
    from evenbreak.files.charts import find_chart_file

    file = find_chart_file(chart)
    return chart_show_answer(file.chart, warnings=file.warnings)
