"""`evenbreak runs`: what a player runs in an inning, or scores in several."""

from __future__ import annotations

import click

from evenbreak import stats
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import safety_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import CHANCE, MOST_BALLS, Number, TwoWhole, Whole, refuse
from evenbreak.matches.formats import LONGEST

AVERAGE = Number(0, MOST_BALLS, f"; give a number of balls an inning from 0 to {MOST_BALLS}")
LINE = Number(0, MOST_BALLS, f"; give a number of balls from 0 to {MOST_BALLS}, such as 20 or 20.5")


BALLS = TwoWhole(
    r"\.\.",
    0,
    MOST_BALLS,
    f"give the fewest and the most balls, from 0 to {MOST_BALLS}, with two "
    "dots between them, such as 50..75",
    rising=True,
)

EXAMPLES = """\b
Examples:
  evenbreak runs --mean 24 --at-least 100
  evenbreak runs --mean 24 --over 20
  evenbreak runs --p 0.96 --innings 5 --between 100..150
  evenbreak runs --p 0.96 --safety 0.8 --plot runs.png
"""


@click.command("runs", epilog=EXAMPLES)
@click.option(
    "--mean", metavar="BALLS", type=AVERAGE, help="The player's average, in balls an inning."
)
@click.option("--p", metavar="P", type=CHANCE, help="Or the chance that the player makes a shot.")
@safety_option
@click.option(
    "--innings",
    type=Whole(1, LONGEST),
    metavar="M",
    default=1,
    help="Give the score of M innings instead of the run in one.",
)
@click.option("--at-least", type=Whole(0, MOST_BALLS), metavar="N", help="The chance of N or more.")
@click.option("--between", metavar="LO..HI", type=BALLS, help="The chance of LO to HI.")
@click.option("--over", metavar="N", type=LINE, help="A bet on more than N, such as 20 or 20.5.")
@plot_option
@faces()
def command(
    mean: float | None,
    p: float | None,
    safety: float,
    innings: int,
    at_least: int | None,
    between: tuple[int, int] | None,
    over: float | None,
    plot: str | None,
) -> Answer:
    """Find how long a player's runs are, and what several innings score.

    Describe the player by --mean or by --p.
    """
    from evenbreak.answers.practice.runs import Asked, runs_answer

    if (mean is None) == (p is None):
        refuse("give either --mean or --p")
    law, asked = _law(mean, p, safety, innings), Asked(at_least, between, over)
    if plot is not None:
        from evenbreak.plots.practice import draw_score

        write_plot(draw_score(law, innings, asked=list(asked.ranges.values())), plot)
    return runs_answer(law, asked)


def _law(
    mean: float | None, p: float | None, safety: float, innings: int
) -> stats.RunLength | stats.InningsScore:
    chance = stats.shot_chance(mean, safety) if p is None else p
    return (
        stats.RunLength(chance, safety)
        if innings == 1
        else stats.InningsScore(chance, innings, safety)
    )
