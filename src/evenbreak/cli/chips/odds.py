"""`evenbreak chips odds`: each player's odds in a chip tournament."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.chips.options import field_options
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import refuse

if TYPE_CHECKING:
    from evenbreak.answers.chips import ChipField

_MOST_CHIPS = 100

EXAMPLES = """\b
Examples:
  evenbreak chips odds entrants.csv --chart hoboken --tables 4
  evenbreak chips odds entrants.csv --left "Ann=2,Bo=1,Cy=3"
"""


@click.command("odds", epilog=EXAMPLES)
@click.argument("entrants", metavar="ENTRANTS.csv")
@field_options
@click.option(
    "--left",
    metavar="NAME=CHIPS,...",
    help="Instead of --chart: the last players at one table and the chips that they have left, in "
    "the order of the line; the first stays at the table. Up to four are exact.",
)
@click.option(
    "--chart",
    metavar="NAME|FILE.csv",
    help="The chips at the start: hoboken, pharaohs, or a file with the columns rating_from and "
    "chips.",
)
@faces()
def command(
    *, field: ChipField, warnings: list[str], chart: str | None, left: str | None, seed: int
) -> Answer:
    """Find each player's odds of winning a chip tournament.

    The tournament is played out 10,000 times. The ratings are taken as right.
    """
    from evenbreak.answers.chips import chip_odds_answer
    from evenbreak.files.charts import chip_chart_of

    if (chart is None) == (left is None):
        refuse("give one of --chart NAME and --left NAME=CHIPS,...")
    return chip_odds_answer(
        field,
        None if chart is None else chip_chart_of(chart),
        None if left is None else _left(left),
        seed=seed,
        warnings=warnings,
    )


def _left(text: str) -> dict[str, int]:
    found: dict[str, int] = {}
    for part in text.split(","):
        match = re.fullmatch(r"\s*(.+?)\s*=\s*(\d{1,3})\s*", part)
        if match is None or not 1 <= int(match[2]) <= _MOST_CHIPS:
            refuse(f"--left has {part.strip()!r}; give each player's chips, such as Ann=2,Bo=1")
        if match[1] in found:
            refuse(f"--left has {match[1]!r} twice")
        found[match[1]] = int(match[2])
    if len(found) < 2:
        refuse("--left has one player; give two or more")
    return found
