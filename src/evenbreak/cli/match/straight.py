"""`evenbreak straight`: a match of 14.1 straight pool, and its spot."""

from __future__ import annotations

from fractions import Fraction

import click

from evenbreak import matches, stats
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand, safety_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import CHANCE, MOST_BALLS, PAIR, Number, refuse

AVERAGE = Number(0, MOST_BALLS, f" is not an average; give balls an inning from 0 to {MOST_BALLS}")
REMEDY = "give two averages A B, or --p1 and --p2"

EXAMPLES = """\b
Examples:
  evenbreak straight 9 4 --points 100
  evenbreak straight 24 19 --points 150:130 --first b
  evenbreak straight --p1 0.9 --p2 0.85 --points 100 --safety 0.8
  evenbreak straight 24 19 --points 150 --plot spot.png
"""


@click.command("straight", cls=PlainCommand, epilog=EXAMPLES)
@click.argument("averages", nargs=-1, metavar="[A B]", type=AVERAGE)
@click.option("--p1", metavar="P", type=CHANCE, help="Chance that A makes a shot.")
@click.option("--p2", metavar="P", type=CHANCE, help="Chance that B makes a shot.")
@click.option(
    "--points",
    metavar="N|M:N",
    type=PAIR,
    required=True,
    help="The points to win: A needs M, B needs N.",
)
@safety_option
@click.option(
    "--first",
    type=click.Choice(["a", "b"]),
    default="a",
    help="Who has the first inning.",
)
@plot_option
@faces()
def command(
    averages: tuple[float, ...],
    p1: float | None,
    p2: float | None,
    points: tuple[int, int],
    safety: float,
    first: str,
    plot: str | None,
) -> Answer:
    """Give the odds of a match of 14.1 straight pool, and the spot that makes it even.

    Describe the players by the balls that A and B average an inning, or by --p1 and --p2.
    """
    from evenbreak.answers.match.straight import straight_answer

    shots: list[Fraction | float]
    if averages and (p1 is not None or p2 is not None):
        refuse(f"the players are given twice; {REMEDY}")
    if averages:
        if len(averages) != 2:
            given = " ".join(f"{average:g}" for average in averages)
            refuse(f"the averages are {given}; {REMEDY}")
        shots = [stats.shot_chance(average, safety) for average in averages]
    elif p1 is None or p2 is None:
        refuse(f"the players are missing; {REMEDY}")
    else:
        shots = [p1, p2]
    match = matches.StraightPool(
        *points,
        *shots,
        safety_1=safety,
        safety_2=safety,
        first="ab".index(first) + 1,
    )
    if plot is not None:
        from evenbreak.plots.practice import plot_spot

        if not any(shots) or not safety:
            refuse("nobody ever makes a ball, so there is nothing to draw; leave --plot out")
        write_plot(plot_spot(match), plot)
    return straight_answer(match, (averages[0], averages[1]) if averages else None)
