"""What the commands of `evenbreak sandbag` have in common: their league, and their numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.callbacks import Command, number, refuse

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.ladders.ladder import Ladder
    from evenbreak.handicaps.systems.system import System

DOUBLINGS = 4
"""How far a rating may be off: to where the odds of a game are 16 to 1."""

wants_chart: Callable[[Command], Command] = click.option(
    "--chart",
    "chart_name",
    metavar="NAME_OR_FILE",
    help="The chart that says the races.  [default: the system's own]",
)
"""The option --chart."""

wants_system: Callable[[Command], Command] = click.option(
    "--system",
    "system_name",
    default="npl",
    show_default=True,
    metavar="NAME",
    help="How ratings move.",
)
"""The option --system."""


def between(low: float, high: float) -> Callable[..., float | None]:
    """Return the callback of an option that is a number from low to high."""

    def read(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
        if value is None:
            return None
        wanted = f"; give a number from {low:g} to {high:,.15g}"
        return number(str(value), low, high, wanted, ctx=ctx, param=param)

    return read


wants_alpha: Callable[[Command], Command] = click.option(
    "--alpha",
    default="0.01",
    show_default=True,
    metavar="P",
    callback=between(1e-9, 0.5),
    help="The chance that an honest player is ever flagged, at most.",
)
"""The option --alpha."""

wants_honest: Callable[[Command], Command] = click.option(
    "--honest",
    type=click.Choice(["any", "established"]),
    default="any",
    show_default=True,
    help="Who counts as honest: players of any skill, or those rated as rightly as ratings are.",
)
"""The option --honest."""

wants_day_sd: Callable[[Command], Command] = click.option(
    "--day-sd",
    default="0",
    show_default=True,
    metavar="POINTS",
    callback=between(0.0, 10_000.0),
    help="How much the form of honest players varies from day to day.",
)
"""The option --day-sd."""


def found_system(name: str) -> System:
    """Return the system of this name, or refuse it."""
    from evenbreak.errors import InputError
    from evenbreak.handicaps.systems.catalogue import system_of

    try:
        return system_of(name)
    except InputError as error:
        refuse(f"--{error}")


def found_chart(name: str) -> Chart:
    """Return the chart of rating differences of this name or file, or refuse it."""
    from evenbreak.files.chart import find_chart
    from evenbreak.handicaps.charts.chart import Chart

    found = find_chart(name)
    if not isinstance(found, Chart):
        refuse(f"--chart {name!r} is a chart of skill levels; give one of rating differences")
    return found


def watched_ladder(system: System, chart: Chart | None, day_sd: float) -> Ladder:
    """Return the ladder whose law of rating errors the watch goes by, or refuse such a form."""
    from evenbreak.errors import InputError
    from evenbreak.handicaps.ladders.ladder import Ladder

    try:
        return Ladder(system, chart, day_sd=day_sd)
    except InputError as error:
        refuse(f"--{str(error).replace('_', '-', 1)}")


def wide_ladder(system: System, chart: Chart | None) -> Ladder:
    """Return the ladder of a system against opponents who are rated rightly, a wide one."""
    from evenbreak.handicaps.ladders.ladder import Ladder

    return Ladder(system, chart, widest=round(DOUBLINGS * system.scale.points_per_doubling))
