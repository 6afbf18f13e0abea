"""The options of `evenbreak chart design`: limits on races, how matches are played, the aim."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import click

from evenbreak import handicaps
from evenbreak.cli.kit.options import Command, scale_option, with_options
from evenbreak.cli.kit.systems import chart_by_difference
from evenbreak.cli.kit.values import CHANCE, PAIR, SPAN, Number, Whole, refuse
from evenbreak.errors import InputError
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    from evenbreak.answers.chart_design import DesignTask


MOST = 1_000_000
"""The largest number of rows, games or points that an option can have."""

ROWS = 12
"""The most rows of a chart that fits on the wall."""

SPREAD = 2
"""How much the longest matches of printed charts differ, in games."""

ABOVE_0 = Number(1e-6, MOST, "; give a number above 0")
POINTS = Number(-MOST, MOST, " is not a number of rating points; give a number, such as 10")

_PARAMETER = re.compile(
    r"\b(mean_games|games_p90|up_to|rows|spread|games|scale|break_points|target|tilt)\b"
    r"(?= (?:is|are)\b)|(?<=\bnarrow )games\b|(?<=\blower )(?:rows|up_to)\b|(?<=\bor )up_to\b"
)
"""Where a message of the library names a parameter."""


def design_options(command: Command) -> Command:
    """Add the options that describe the chart to be designed."""
    return with_options(
        command,
        click.option(
            "--beside",
            metavar="NAME_OR_FILE",
            multiple=True,
            help="A chart to compare with; can be repeated.",
        ),
        click.option(
            "--up-to",
            type=Whole(1, MOST),
            metavar="D",
            help="The last difference that counts.  [default: where the last race of each --beside "
            "chart is even, or else the hardest race allowed]",
        ),
        click.option(
            "--rule",
            type=click.Choice(["mean", "worst", "nearest"]),
            default="mean",
            help="Minimise the mean unfairness over all whole-point differences, or the largest; "
            "or take the nearest race at each difference by itself.",
        ),
        click.option(
            "--tilt",
            metavar="T",
            type=Number(0.0, 1.0, "; give a number from 0 (the start of a band) to 1 (its end)"),
            default=0.5,
            help="Where in its band a race should be on target: 0 at the start (the stronger "
            "player is never the underdog), 1 at the end.",
        ),
        click.option(
            "--target",
            metavar="P",
            type=CHANCE,
            default=0.5,
            help="The chance that the stronger player should have.",
        ),
        scale_option(),
        click.option(
            "--break-points",
            type=POINTS,
            metavar="B",
            default=0.0,
            show_default=False,
            help="What the break is worth in rating points; goes with --breaks.",
        ),
        click.option(
            "--breaks",
            type=click.Choice(["winner", "loser", "alternate"]),
            help="Who breaks next; either player breaks first with chance 1/2.",
        ),
        click.option(
            "--win-by",
            type=Whole(1, 20),
            metavar="K",
            default=1,
            help="By how many games a race must be won.",
        ),
        click.option(
            "--minutes-per-game",
            metavar="MIN",
            type=ABOVE_0,
            help="How long a game takes; goes with --minutes.",
        ),
        click.option(
            "--minutes",
            metavar="MIN",
            type=ABOVE_0,
            help="The same limit in minutes; goes with --minutes-per-game.",
        ),
        click.option(
            "--games-p90",
            type=Whole(1, MOST),
            metavar="K",
            help="9 out of 10 matches must end within K games, at every difference.",
        ),
        click.option(
            "--rows",
            type=Whole(1, MOST),
            metavar="N",
            help=f"The chart may have at most N rows.  [default: {ROWS}]",
        ),
        click.option(
            "--spread",
            type=Whole(0, MOST),
            metavar="K",
            help="The longest matches of its races may differ by at most K games.  [default: "
            f"{SPREAD}]",
        ),
        click.option(
            "--mean-games",
            metavar="G",
            type=ABOVE_0,
            help="Matches may take at most G games on average.",
        ),
        click.option(
            "--least",
            metavar="M:N",
            type=PAIR,
            default="2:2",
            help="The fewest games that the stronger and the weaker player may need.",
        ),
        click.option(
            "--games",
            metavar="LO..HI",
            type=SPAN,
            required=True,
            help="Races whose longest possible match has LO to HI games.",
        ),
    )


@contextmanager
def options_named(*, in_minutes: bool) -> Iterator[None]:
    """Name the options in errors of the design, in place of the library's parameters.

    If the limit on the length was given in minutes, there is no --games-p90 to name.
    """
    try:
        yield
    except InputError as error:
        text = re.sub(r"\bgames is \((\d+), (\d+)\)", r"games is \1..\2", str(error))
        text = text.replace("raise the fewest games of the weaker player", "raise --least")
        if in_minutes:
            text = re.sub(r"\bgames_p90 is (\d+)", r"--minutes allows \1 games", text)
        named = _PARAMETER.sub(lambda found: "--" + found[0].replace("_", "-"), text)
        raise InputError(named) from error


def task_of(
    *,
    games: tuple[int, int],
    least: tuple[int, int],
    games_p90: int | None,
    minutes: float | None,
    minutes_per_game: float | None,
    scale: Scale,
    win_by: int,
    breaks: str | None,
    break_points: float,
    beside: tuple[str, ...],
    **others: Any,
) -> DesignTask:
    """Return what is asked for, or refuse options that contradict each other."""
    from evenbreak.answers.chart_design import DesignTask
    from evenbreak.games.breaks import BREAK_FORMATS

    if (minutes is None) != (minutes_per_game is None):
        refuse("--minutes and --minutes-per-game go together; give both")
    if minutes is not None and minutes_per_game is not None:
        if games_p90 is not None:
            refuse("--minutes and --games-p90 set the same limit; leave one out")
        games_p90 = int(minutes / minutes_per_game + 1e-9)
        if games_p90 < 1:
            refuse("--minutes is less than a game takes; give more")
    if (breaks is None) != (break_points == 0.0):
        refuse("--breaks and --break-points go together; give both, or leave both out")
    aims = [others[name] for name in ("mean_games", "rows", "spread", "target", "tilt")]
    if others["rule"] == "nearest":
        if aims != [None, None, None, 0.5, 0.5]:
            refuse(
                "--rule nearest takes the race nearest 0.5; leave --mean-games, --rows, --spread, "
                "--target and --tilt out"
            )
    else:
        others["rows"] = ROWS if others["rows"] is None else others["rows"]
        others["spread"] = SPREAD if others["spread"] is None else others["spread"]
    breaking = None if breaks is None else BREAK_FORMATS[breaks]
    rules = handicaps.MatchRules(scale, win_by, breaking, break_points)
    limits = handicaps.RaceLimits(games, *least, games_p90)
    return DesignTask(
        rules,
        limits,
        beside=tuple(chart_by_difference("--beside", name) for name in beside),
        **others,
    )
