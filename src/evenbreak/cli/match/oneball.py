"""`evenbreak oneball`: which shot to take."""

from __future__ import annotations

import click

from evenbreak import plots, practice
from evenbreak.answers.kit.answer import Answer
from evenbreak.chains.ways import Way
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand, via_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import CHANCE, numbers, refuse

LOOK_AHEADS = {"infinite": "infinite", "two": "two shots", "all": "all shots"}

MOST_SHOTS = 1000
"""The most shots to look ahead."""

EXAMPLES = """\b
Examples:
  evenbreak oneball 0.4 0.8
  evenbreak oneball 0.4 0.8 --or 0.3:0.3 --or 0.5:0.9
  evenbreak oneball 0.4 0.8 0.5 0.2 --or 0.3:0.3:0.2:0.4
  evenbreak oneball 0.4 0.8 --or 0.3:0.3 --plot shots.png
"""


_chances = numbers(
    ":",
    range(2, MOST_SHOTS + 1),
    0.0,
    1.0,
    "give two or more numbers from 0 to 1 with colons between them, such as 0.3:0.3",
)


@click.command("oneball", cls=PlainCommand, epilog=EXAMPLES)
@click.argument("p1", metavar="P1", type=CHANCE)
@click.argument("p2", metavar="P2", type=CHANCE)
@click.argument("later", metavar="[P3 ...]", type=CHANCE, nargs=-1)
@click.option(
    "--or",
    "others",
    metavar="P1:P2[:P3...]",
    multiple=True,
    type=_chances,
    help="Another shot to choose from; can be repeated.",
)
@click.option(
    "--look-ahead",
    type=click.Choice(list(LOOK_AHEADS)),
    help="Rank by the first two shots repeated until one is made, or by the first two or all of "
    "the shots, after which the game is even.  [default: all if there is a P3, else infinite]",
)
@via_option
@plot_option
@faces()
def command(
    p1: float,
    p2: float,
    later: tuple[float, ...],
    others: tuple[tuple[float, ...], ...],
    look_ahead: str | None,
    via: Way | None,
    plot: str | None,
) -> Answer:
    """Choose the best shot in the one-ball game, and give your odds of winning it.

    P1 is your chance of making the shot, P2 the opponent's chance of making what your
    miss leaves. If you know more, give the chances of the shots after those two: P3 is
    yours, P4 the opponent's, and so on. Each --or is another shot that you could take
    instead.
    """
    from evenbreak.answers.match.oneball import oneball_answer

    shots = [
        practice.ShotChoice(str(number), chances[0], chances[1], chances[2:])
        for number, chances in enumerate([(p1, p2, *later), *others], start=1)
    ]
    known = any(shot.later for shot in shots)
    ahead = LOOK_AHEADS[look_ahead or ("all" if known else "infinite")]
    if plot is not None and ahead == "all shots":
        refuse("--plot draws two chances a shot; add --look-ahead infinite or two")
    if plot is not None:
        write_plot(plots.shots_figure(shots, look_ahead=ahead), plot)
    return oneball_answer(shots, look_ahead=ahead, via=via)
