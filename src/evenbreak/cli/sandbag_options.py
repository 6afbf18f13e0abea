"""What the commands of `evenbreak sandbag` have in common: their league, and their numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import click

from evenbreak.cli.options import Command, number, refuse

if TYPE_CHECKING:
    from evenbreak.handicaps.chart import Chart
    from evenbreak.handicaps.ladder import Ladder
    from evenbreak.handicaps.systems import System

__all__ = ["between", "found_chart", "found_system", "wants_chart", "wants_system", "wide_ladder"]

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


def found_system(name: str) -> System:
    """Return the system of this name, or refuse it."""
    from evenbreak.errors import InputError
    from evenbreak.handicaps.systems import system_of

    try:
        return system_of(name)
    except InputError as error:
        refuse(f"--{error}")


def found_chart(name: str) -> Chart:
    """Return the chart of rating differences of this name or file, or refuse it."""
    from evenbreak.handicaps.chart import Chart
    from evenbreak.reports.read_chart import find_chart

    found = find_chart(name)
    if not isinstance(found, Chart):
        refuse(f"--chart {name!r} is a chart of skill levels; give one of rating differences")
    return found


def wide_ladder(system: System, chart: Chart | None) -> Ladder:
    """Return the ladder of a system against opponents who are rated rightly, a wide one."""
    from evenbreak.handicaps.ladder import Ladder

    return Ladder(system, chart, widest=round(DOUBLINGS * system.scale.points_per_doubling))
