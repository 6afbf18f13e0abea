"""`evenbreak breaks`: what each break format is worth to two players in the long run."""

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.chains.ways import Way
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand, via_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import CHANCE, Number
from evenbreak.games.rack import Rack

HIGHEST = 1_000_000
"""The highest stake."""

STAKE = Number(0, HIGHEST, f" is not a stake; give a number from 0 to {HIGHEST}")

EXAMPLES = """\b
Examples:
  evenbreak breaks 0.6 0.55
  evenbreak breaks 0.9 0.5 --win 1 --lose 2
  evenbreak breaks 0.9 0.5 --plot breaks.png
"""


@click.command("breaks", cls=PlainCommand, epilog=EXAMPLES)
@click.argument("p1", metavar="P1", type=CHANCE)
@click.argument("p2", metavar="P2", type=CHANCE)
@click.option(
    "--win",
    metavar="X",
    type=STAKE,
    default="1",
    help="What A wins for each rack won.",
)
@click.option(
    "--lose",
    metavar="Y",
    type=STAKE,
    default="1",
    help="What A pays for each rack lost.",
)
@click.option(
    "--first-break",
    type=click.Choice(["a", "b"]),
    default="a",
    help="Who breaks the first rack; it matters only if the break never passes on.",
)
@via_option
@plot_option
@faces()
def command(
    p1: float,
    p2: float,
    win: float,
    lose: float,
    first_break: str,
    via: Way | None,
    plot: str | None,
) -> Answer:
    """Compare break formats for two players in the long run, the best for A first.

    P1 is A's chance of winning a rack that A breaks, P2 B's chance of winning one that B
    breaks.
    """
    from evenbreak.answers.match.breaks import breaks_answer

    rack = Rack(p1, p2)
    first = "ab".index(first_break) + 1
    if plot is not None:
        from evenbreak.plots.contours import breaks_figure

        write_plot(breaks_figure(rack, first_breaker=first), plot)
    return breaks_answer(rack, win=win, lose=lose, first_breaker=first, via=via)
