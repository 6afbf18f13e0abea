"""`evenbreak oneball`: which shot to take."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import CHANCE, NUMBER

if TYPE_CHECKING:
    from evenbreak.answers.answer import Answer

LOOK_AHEADS = {"infinite": "infinite", "two": "two shots"}

EXAMPLES = """\b
Examples:
  evenbreak oneball 0.4 0.8
  evenbreak oneball 0.4 0.8 --or 0.3:0.3 --or 0.5:0.9
  evenbreak oneball 0.4 0.8 --or 0.3:0.3 --plot shots.png
"""


class TwoChances(click.ParamType):  # type: ignore[type-arg]
    """The two chances of a shot, such as 0.3:0.3."""

    name = "shot"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        """Return the chances that were typed."""
        parts = [part.strip() for part in value.split(":")]
        numbers = [float(part) if NUMBER.fullmatch(part) else math.nan for part in parts]
        if len(numbers) != 2 or not all(0.0 <= number <= 1.0 for number in numbers):
            wanted = "give two numbers from 0 to 1 with a colon between them, such as 0.3:0.3"
            self.fail(f"{value!r}; {wanted}", param, ctx)
        return numbers[0], numbers[1]


@click.command("oneball", cls=PlainCommand, epilog=EXAMPLES)
@click.argument("p1", metavar="P1", type=CHANCE)
@click.argument("p2", metavar="P2", type=CHANCE)
@click.option(
    "--or",
    "others",
    metavar="P1:P2",
    multiple=True,
    type=TwoChances(),
    help="Another shot to choose from; may be given more than once.",
)
@click.option(
    "--look-ahead",
    type=click.Choice(list(LOOK_AHEADS)),
    default="infinite",
    show_default=True,
    help="Rank by the two shots repeated until one is made, or by two shots and then an even game.",
)
@plot_option
@faces()
def command(
    p1: float,
    p2: float,
    others: tuple[tuple[float, float], ...],
    look_ahead: str,
    plot: str | None,
) -> Answer:
    """Choose the best shot in the one-ball game, and give your odds of winning it.

    P1 is your chance of making the shot, P2 the opponent's chance of making what your
    miss leaves. Each --or is another shot that you could take instead.
    """
    from evenbreak.answers.oneball import oneball_answer
    from evenbreak.practice.shots import ShotChoice

    shots = [
        ShotChoice(str(number), *chances)
        for number, chances in enumerate([(p1, p2), *others], start=1)
    ]
    ahead = LOOK_AHEADS[look_ahead]
    if plot is not None:
        from evenbreak.plots.shot_choice import shots_figure

        write_plot(shots_figure(shots, look_ahead=ahead), plot)
    return oneball_answer(shots, look_ahead=ahead)
