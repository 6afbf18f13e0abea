"""`evenbreak chart design`: the fairest chart for given ratings, within limits on its races."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

from evenbreak import handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import scale_option
from evenbreak.cli.kit.systems import chart_by_difference
from evenbreak.cli.kit.values import CHANCE, PAIR, SPAN, Number, Whole
from evenbreak.errors import InputError
from evenbreak.ratings.scale import Scale

MOST = 1_000_000
"""The largest number of rows, games or points that an option can have."""

EXAMPLES = """\b
Examples:
  evenbreak chart design --games 7..9 --least 5:2 --beside npl_10
  evenbreak chart design --games 5..15 --scale fargo --tilt 0 > ours.csv
  evenbreak chart design --games 17..41 --rows 10 --games-p90 21
"""

_PARAMETER = re.compile(
    r"\b(games_p90|up_to|rows|games|scale|target|tilt)\b(?= (?:is|are)\b)"
    r"|(?<=\bnarrow )games\b|(?<=\blower )(?:rows|up_to)\b|(?<=\bor )up_to\b"
)
"""Where a message of the library names a parameter."""


@click.command("design", epilog=EXAMPLES)
@click.option(
    "--games",
    metavar="LO..HI",
    type=SPAN,
    required=True,
    help="Races whose longest possible match has LO to HI games.",
)
@click.option(
    "--least",
    metavar="M:N",
    type=PAIR,
    default="2:2",
    help="The fewest games that the stronger and the weaker player may need.",
)
@click.option(
    "--games-p90",
    type=Whole(1, MOST),
    metavar="K",
    help="9 out of 10 matches must end within K games, at every difference.",
)
@click.option(
    "--rows",
    type=Whole(1, MOST),
    metavar="N",
    default=12,
    help="The chart may have at most N rows.",
)
@scale_option()
@click.option(
    "--target",
    metavar="P",
    type=CHANCE,
    default=0.5,
    help="The chance that the stronger player should have.",
)
@click.option(
    "--tilt",
    metavar="T",
    type=Number(0.0, 1.0, "; give a number from 0 (the start of a band) to 1 (its end)"),
    default=0.5,
    help="Where in its band a race should be on target: 0 at the start (the stronger player is "
    "never the underdog), 1 at the end.",
)
@click.option(
    "--up-to",
    type=Whole(1, MOST),
    metavar="D",
    help="The last difference that counts.  [default: where the last race of each --beside chart "
    "is even, or else the hardest race allowed]",
)
@click.option(
    "--beside",
    metavar="NAME_OR_FILE",
    multiple=True,
    help="A chart to compare with; can be repeated.",
)
@faces()
def command(
    *,
    games: tuple[int, int],
    least: tuple[int, int],
    games_p90: int | None,
    scale: Scale,
    beside: tuple[str, ...],
    **wishes: Any,
) -> Answer:
    """Design the fairest chart for given ratings, within limits on its races.

    Unfairness is how far the stronger player's chance is from the target. Into a pipe or
    a file the chart is written as a CSV file that the other commands read.
    """
    from evenbreak.answers.chart.design import DesignTask, chart_design_answer

    charts = tuple(chart_by_difference("--beside", name) for name in beside)
    with _options_named():
        limits = handicaps.RaceLimits(games, *least, games_p90)
        task = DesignTask(scale, limits, beside=charts, **wishes)
        design = task.design()
    return chart_design_answer(task, design)


@contextmanager
def _options_named() -> Iterator[None]:
    """Name the options in errors of the design, in place of the library's parameters."""
    try:
        yield
    except InputError as error:
        text = re.sub(r"\bgames is \((\d+), (\d+)\)", r"games is \1..\2", str(error))
        text = text.replace("raise the fewest games of the weaker player", "raise --least")
        named = _PARAMETER.sub(lambda name: "--" + name[0].replace("_", "-"), text)
        raise InputError(named) from error
