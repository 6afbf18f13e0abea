"""`evenbreak chart list`: the charts that come with this program."""

from __future__ import annotations

from typing import Any

import click

from evenbreak.cli.kit.callbacks import wants_json
from evenbreak.cli.kit.output import SCHEMA_VERSION, print_json, print_table

HEADINGS = {
    "chart": "name",
    "what": "what it is",
    "looked_up_by": "looked up by",
    "races": "races",
    "longest_games": "longest",
}


@click.command("list")
@wants_json
def command(as_json: bool) -> None:
    """List the charts that come with this program.

    How many different races each has, and how many games the longest match can last.
    """
    from evenbreak.handicaps.charts.chart import CHARTS
    from evenbreak.handicaps.charts.level_chart import LEVEL_CHARTS

    rows = [_row(name, title) for name, title in {**CHARTS, **LEVEL_CHARTS}.items()]
    if as_json:
        listed = [dict(zip(HEADINGS, row, strict=True)) for row in rows]
        print_json({"charts": listed, "schema_version": SCHEMA_VERSION})
        return
    print_table(
        list(HEADINGS),
        rows,
        headings=list(HEADINGS.values()),
        heading="Charts that come with evenbreak; the longest match is in games",
        text=lambda _, value: str(value),
        left=3,
    )


def _row(name: str, title: str) -> tuple[Any, ...]:
    from evenbreak.handicaps.charts.chart import CHARTS, chart
    from evenbreak.handicaps.charts.level_chart import level_chart

    if name in CHARTS:
        by, races = "difference", {row[2:] for row in chart(name).rows}
    else:
        table = level_chart(name)
        pairs = [(i, j) for i in table.levels for j in table.levels if i >= j]
        by, races = "skill level", {table.race(*pair) for pair in pairs}
    return name, title, by, len(races), max(m + n - 1 for m, n in races)
