"""`evenbreak chips design`: a fairer chip chart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.chips.options import field_options
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import Whole, numbers, refuse

if TYPE_CHECKING:
    from evenbreak.answers.chips import ChipField

_MOST_ROWS = 30

EXAMPLES = """\b
Examples:
  evenbreak chips design
  evenbreak chips design entrants.csv --bands 351,451,501,601 --most 12 > ours.csv
"""


@click.command("design", epilog=EXAMPLES)
@click.argument("entrants", metavar="[ENTRANTS.csv]", required=False)
@field_options
@click.option(
    "--bands",
    metavar="RATING,...",
    help="The ratings at which a row begins.  [default: every half doubling of the odds]",
)
@click.option(
    "--most", type=Whole(1, 50), metavar="N", default=10, show_default=True, help="Chips at most."
)
@click.option(
    "--fewest",
    type=Whole(1, 50),
    metavar="N",
    default=2,
    show_default=True,
    help="Chips at least. More chips make a longer tournament.",
)
@faces()
def command(
    *,
    field: ChipField,
    warnings: list[str],
    bands: str | None,
    fewest: int,
    most: int,
    seed: int,
) -> Answer:
    """Design a chip chart that makes a tournament as even as possible for its players.

    Without ENTRANTS.csv the field is 16 players, spread over four doublings of the odds. Into a
    file the chart is CSV that chips audit and chips odds read. The ratings are taken as right.
    """
    from evenbreak.answers.chips import chip_design_answer

    if fewest > most:
        refuse(f"--fewest is {fewest} and --most {most}; give fewer first")
    return chip_design_answer(
        field, bands=_bands(bands), fewest=fewest, most=most, seed=seed, warnings=warnings
    )


def _bands(text: str | None) -> list[float] | None:
    if text is None:
        return None
    wanted = "give the ratings at which the rows begin, such as 350,450,550"
    try:
        read = numbers(",", range(1, _MOST_ROWS + 1), -1e6, 1e6, wanted)
        return sorted(set(read(text)))
    except click.BadParameter as error:
        refuse(f"--bands is {error.message}")
