"""What the commands of `evenbreak sandbag` share: options, and the ladders that they ask about."""

from __future__ import annotations

import click

from evenbreak import handicaps
from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.kit.systems import chart_for
from evenbreak.cli.kit.values import Number, refuse


def between(low: float, high: float) -> Number:
    """Return the type of an option that is a number from low to high."""
    return Number(low, high, f"; give a number from {low:g} to {high:,.15g}")


def watch_options(command: Command) -> Command:
    """Add the options that say how the watch judges players."""
    return with_options(
        command,
        click.option(
            "--day-sd",
            default="0",
            metavar="POINTS",
            type=between(0.0, 10_000.0),
            help="How much the form of honest players varies from day to day (standard deviation).",
        ),
        click.option(
            "--honest",
            type=click.Choice(["any", "established"]),
            default="any",
            help="Who counts as honest: players of any skill, or players whose ratings are as "
            "accurate as ratings are in the long run.",
        ),
        click.option(
            "--alpha",
            default="0.01",
            metavar="P",
            type=between(1e-9, 0.5),
            help="The largest chance that an honest player is ever flagged.",
        ),
    )


def watched_ladder(
    system: handicaps.System, chart_name: str | None, day_sd: float
) -> tuple[handicaps.Ladder, list[str]]:
    """Return the ladder whose rating errors the watch assumes, and warnings about its chart."""
    from evenbreak.errors import InputError

    chart, warnings = chart_for(system, chart_name)
    try:
        return handicaps.Ladder(system, chart, day_sd=day_sd), warnings
    except InputError as error:
        refuse(f"--{str(error).replace('_', '-', 1)}")
