"""`evenbreak sandbag pay`: what losing on purpose pays."""

from __future__ import annotations

from typing import Any

import click

from evenbreak import handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import chart_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.systems import chart_for, system_option
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.sandbag.options import between

DOUBLINGS = 4
"""How far off a rating may be: to where the odds of a game are 16 to 1."""

MONEY = between(0.0, 1e9)

EXAMPLES = """\b
Examples:
  evenbreak sandbag pay
  evenbreak sandbag pay --chart npl_12 --stake 100 --dumped-stake 5 --plot pay.png
  evenbreak sandbag pay --in-a-row 4 --prize 500 --stake 0
  evenbreak sandbag pay --compare
"""


@click.command("pay", epilog=EXAMPLES)
@chart_option()
@system_option()
@click.option(
    "--dumped",
    type=Whole(1, 100),
    default=12,
    metavar="D",
    help="The most matches that are lost on purpose.",
)
@click.option(
    "--earnest",
    type=Whole(1, 500),
    default=20,
    metavar="E",
    help="How many matches are then played in earnest.",
)
@click.option(
    "--stake",
    type=MONEY,
    default="10",
    metavar="X",
    help="What winning a match in earnest is worth.",
)
@click.option(
    "--dumped-stake",
    type=MONEY,
    default="1",
    metavar="X",
    help="What winning one of the dumped matches would be worth.",
)
@click.option(
    "--in-a-row",
    type=Whole(1, 50),
    default=3,
    metavar="K",
    help="How many matches in a row win a tournament.",
)
@click.option(
    "--prize",
    type=MONEY,
    default="0",
    metavar="X",
    help="What the tournament pays.",
)
@click.option(
    "--from",
    "start",
    type=Whole(-100, 100),
    default=0,
    metavar="ERROR",
    help="How far the rating is above the skill at first, in points.",
)
@click.option("--compare", is_flag=True, help="Compare the charts of the system.")
@plot_option
@faces()
def command(
    chart: str | None, system: handicaps.System, *, compare: bool, plot: str | None, **asked: Any
) -> Answer:
    """Show what it pays to lose matches on purpose.

    Opponents are as good as the player and correctly rated. The player loses up to D matches
    on purpose, then plays E in earnest while the rating climbs back. Nothing is simulated.
    """
    from evenbreak.answers.sandbag.pay import (
        PayQuestion,
        sandbag_charts_answer,
        sandbag_pay,
        sandbag_pay_answer,
    )

    question = PayQuestion(**asked)
    if compare:
        if chart is not None or plot is not None:
            refuse("--compare takes all charts of the system; leave --chart and --plot out")
        ladders = [_wide(system, one) for one in system.known_charts()]
        return sandbag_charts_answer(
            [sandbag_pay(ladder, question, cycles=False) for ladder in ladders], question
        )
    one, warnings = chart_for(system, chart)
    found = sandbag_pay(_wide(system, one), question)
    if plot is not None:
        from evenbreak.plots.league import pay_figure

        write_plot(pay_figure(found.pays), plot)
    return sandbag_pay_answer(found, question, warnings)


def _wide(system: handicaps.System, chart: handicaps.Chart) -> handicaps.Ladder:
    """Return a wide ladder against opponents who are correctly rated."""
    return handicaps.Ladder(
        system, chart, widest=round(DOUBLINGS * system.scale.points_per_doubling)
    )
