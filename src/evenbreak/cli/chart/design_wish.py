"""What `evenbreak chart design` is asked for: limits on races, how they are played, the rule."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from evenbreak.cli.kit.callbacks import NUMBER, Command, pair, refuse, span
from evenbreak.errors import InputError

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.charts.match_rules import MatchRules
    from evenbreak.handicaps.charts.race_limits import RaceLimits

RULES = {
    "mean": "the least mean unfairness",
    "worst": "the least largest unfairness",
    "nearest": "the race with W nearest 0.5 at each difference",
}
"""What is made best, in words."""


_PARAMETER = re.compile(
    r"\b(mean_games|games_p90|up_to|rows|games|scale|break_points|target|tilt)\b"
    r"(?= (?:is|are)\b)|(?<=\bnarrow )games\b|(?<=\blower )(?:rows|up_to)\b|(?<=\bor )up_to\b"
)
"""Where a message of the library names a parameter."""


class Wish(NamedTuple):
    """What is asked for, apart from how it is printed."""

    play: MatchRules
    limits: RaceLimits
    rule: str
    target: float
    tilt: float
    up_to: int | None
    mean_games: float | None
    rows: int | None
    beside: tuple[Chart, ...]


def _above_0(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    if value is None:
        return None
    number = float(value) if NUMBER.fullmatch(value.strip()) else 0.0
    if not 0.0 < number < 1e6:
        raise click.BadParameter(f"{value!r}; give a number above 0", ctx=ctx, param=param)
    return number


def limit_options(command: Command) -> Command:
    """Add the options that say which races a chart may hold and how they are played."""
    for add in (
        click.option(
            "--break-points",
            type=float,
            metavar="B",
            default=0.0,
            help="What the break is worth in rating points; goes with --breaks.",
        ),
        click.option(
            "--breaks",
            type=click.Choice(["winner", "loser", "alternate"]),
            help="Who breaks next; the first break is drawn.",
        ),
        click.option(
            "--win-by",
            type=click.IntRange(1, 20),
            metavar="K",
            default=1,
            show_default=True,
            help="By how many games a race must be won.",
        ),
        click.option(
            "--minutes-per-game",
            metavar="MIN",
            callback=_above_0,
            help="How long a game takes; goes with --minutes.",
        ),
        click.option(
            "--minutes",
            metavar="MIN",
            callback=_above_0,
            help="The same limit in minutes; goes with --minutes-per-game.",
        ),
        click.option(
            "--games-p90",
            type=click.IntRange(1),
            metavar="K",
            help="Let 9 of 10 matches end within K games, at every difference.",
        ),
        click.option(
            "--rows",
            type=click.IntRange(1),
            metavar="N",
            help="Let the chart have N rows at the most.",
        ),
        click.option(
            "--mean-games",
            metavar="G",
            callback=_above_0,
            help="Let matches take G games in the mean, at most.",
        ),
        click.option(
            "--least",
            metavar="M:N",
            callback=pair,
            default="1:1",
            show_default=True,
            help="The fewest games that the stronger and the weaker may need.",
        ),
        click.option(
            "--games",
            metavar="LO..HI",
            callback=span,
            required=True,
            help="Races of which the longest possible match has LO to HI games.",
        ),
    ):
        command = add(command)
    return command


@contextmanager
def options_named(*, in_minutes: bool) -> Iterator[None]:
    """Name in an error of the design the options in place of the library's parameters.

    Where the limit on the length was given in minutes, no --games-p90 was.
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


def wish_of(
    *,
    games: tuple[int, int],
    least: tuple[int, int],
    games_p90: int | None,
    minutes: float | None,
    minutes_per_game: float | None,
    scale: str,
    win_by: int,
    breaks: str | None,
    break_points: float,
    beside: tuple[str, ...],
    rule: str,
    **others: Any,
) -> Wish:
    """Return what is asked for, or refuse what contradicts itself."""
    from evenbreak.games.breaks import BREAK_FORMATS
    from evenbreak.handicaps.charts.match_rules import MatchRules
    from evenbreak.handicaps.charts.race_limits import RaceLimits

    if (minutes is None) != (minutes_per_game is None):
        refuse("--minutes and --minutes-per-game go together; give both")
    if minutes is not None and minutes_per_game is not None:
        if games_p90 is not None:
            refuse("--minutes and --games-p90 are one limit said twice; leave one out")
        games_p90 = int(minutes / minutes_per_game + 1e-9)
        if games_p90 < 1:
            refuse("--minutes is less than a game takes; give more")
    if (breaks is None) != (break_points == 0.0):
        refuse("--breaks and --break-points go together; give both, or leave both out")
    wishes = (others["mean_games"], others["rows"], others["target"], others["tilt"])
    if rule == "nearest" and wishes != (None, None, 0.5, 0.5):
        refuse(
            "--rule nearest takes the race nearest 0.5; leave --mean-games, --rows, --target, "
            "--tilt out"
        )
    play = MatchRules(
        scale, win_by, None if breaks is None else BREAK_FORMATS[breaks], break_points
    )
    limits = RaceLimits(games, *least, games_p90)
    return Wish(play, limits, rule, beside=tuple(map(_chart_beside, beside)), **others)


def _chart_beside(name: str) -> Chart:
    from evenbreak.files.chart import find_chart
    from evenbreak.handicaps.charts.chart import Chart

    found = find_chart(name)
    if not isinstance(found, Chart):
        refuse("--beside names a chart of skill levels; name one of rating differences")
    return found
