"""`evenbreak chips audit`: whom a chip chart favours."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.chips.options import field_options
from evenbreak.cli.kit.faces import faces

if TYPE_CHECKING:
    from evenbreak.answers.chips import ChipField

EXAMPLES = """\b
Examples:
  evenbreak chips audit hoboken
  evenbreak chips audit pharaohs --entrants entrants.csv --tables 6
"""


@click.command("audit", epilog=EXAMPLES)
@click.argument("chart", metavar="NAME|FILE.csv")
@click.option(
    "--entrants",
    metavar="FILE.csv",
    help="The field.  [default: 16 players, spread over four doublings of the odds]",
)
@field_options
@faces()
def command(*, chart: str, field: ChipField, warnings: list[str], seed: int) -> Answer:
    """Check whom a chip chart favours: hoboken, pharaohs, or one in a file.

    Over a whole tournament, and between the last two players if both have all their chips. The
    ratings are taken as right.
    """
    from evenbreak.answers.chips import chip_audit_answer
    from evenbreak.files.charts import chip_chart_of

    return chip_audit_answer(field, chip_chart_of(chart), seed=seed, warnings=warnings)
