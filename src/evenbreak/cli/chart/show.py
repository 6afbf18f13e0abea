"""`evenbreak chart show`: the races of a chart."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.callbacks import wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    aligned,
    print_json,
    print_table,
    say,
    to_terminal,
)

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.level_chart import LevelChart
    from evenbreak.handicaps.charts.rows import ChartRow

EXAMPLES = """\b
Examples:
  evenbreak chart show npl_10
  evenbreak chart show apa_8ball
  evenbreak chart show npl_8 > ours.csv
"""


@click.command("show", epilog=EXAMPLES)
@click.argument("chart", metavar="NAME_OR_FILE")
@wants_json
def command(chart: str, as_json: bool) -> None:
    """Show a chart: who needs how many games.

    NAME_OR_FILE: a chart that `evenbreak chart list` names, or a CSV file of one. Into a
    pipe or a file goes the chart as such a CSV file, to be changed and read again.
    """
    from evenbreak.files.chart import chart_table, find_chart_file
    from evenbreak.handicaps.charts.chart import Chart

    file = find_chart_file(chart)
    found = file.chart
    for warning in file.warnings:
        say(f"Warning: {warning}")
    columns, rows = chart_table(found)
    if as_json:
        listed = [dict(zip(columns, row, strict=True)) for row in rows]
        print_json({"chart": found.name, "rows": listed, "schema_version": SCHEMA_VERSION})
    elif not to_terminal():
        print_table(columns, rows, headings=(), heading="", text=lambda _, value: str(value))
    else:
        click.echo(_rows_text(found.rows) if isinstance(found, Chart) else _square(found), nl=False)


def _rows_text(rows: Sequence[ChartRow]) -> str:
    cells = [(span_text(row[0], row[1]), f"{row[2]}:{row[3]}") for row in rows]
    return aligned([("difference", "race"), *cells])


def _square(chart: LevelChart) -> str:
    """Return the games that the level of the row needs, and those that of the column needs."""
    header = ["level", *(f"v {level}" for level in chart.levels)]
    rows = [
        [str(own), *("{}:{}".format(*chart.race(own, other)) for other in chart.levels)]
        for own in chart.levels
    ]
    return "The level of the line needs the first number, its opponent's the second.\n\n" + aligned(
        [header, *rows]
    )


def span_text(first: int, last: int | None) -> str:
    """Return a span of rating differences in words.

    >>> span_text(7, 18), span_text(7, 7), span_text(49, None)
    ('7 to 18', '7', '49 and more')
    """
    if last is None:
        return f"{first} and more"
    return f"{first} to {last}" if last > first else str(first)
