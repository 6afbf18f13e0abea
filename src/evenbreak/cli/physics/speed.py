"""`evenbreak physics speed`: how fast a table is, from the time of a lag."""

from __future__ import annotations

import click

from evenbreak.cli.kit.callbacks import refuse, wants_json
from evenbreak.cli.physics.units import (
    PLAYERS,
    Measure,
    Units,
    decimals,
    print_answer,
    wants_metric,
)

LEAST, MOST = 40.0, 250.0
"""Beyond these speeds a wrong time or unit is likelier than such a table."""

EXAMPLES = """\b
Examples:
  evenbreak physics speed --lag-time 7.0
  evenbreak physics speed --lag-time 6.2 --table-length 88
  evenbreak physics speed --lag-time 7.0 --table-length 254 --metric
"""


@click.command("speed", epilog=EXAMPLES)
@click.option(
    "--lag-time",
    metavar="SECONDS",
    type=Measure(0.1, 1000.0, "7.0"),
    required=True,
    help="From the foot cushion until the ball stops, just at the head cushion.",
)
@click.option(
    "--table-length",
    metavar="LENGTH",
    type=Measure(1.0, 1e5, "100"),
    help="Between the noses of the end cushions.  [default: 100 inches, nine feet]",
)
@click.option(
    "--ball-diameter",
    metavar="LENGTH",
    type=Measure(0.01, 1e5, "2.25"),
    help="Of the ball that rolls.  [default: 2.25 inches]",
)
@wants_metric
@wants_json
def command(
    lag_time: float,
    table_length: float | None,
    ball_diameter: float | None,
    units: Units,
    as_json: bool,
) -> None:
    """Tell the speed of a table from the time of a lag.

    Roll a ball off the foot cushion so that it just comes to the head cushion, time it from
    cushion to cushion, and take the mean of several. A table speed of 80 to 100 is normal.
    """
    from evenbreak.physics import Ball, Table, lag_speed, table_speed

    length = Table().length if table_length is None else table_length * units.length
    diameter = Ball().diameter if ball_diameter is None else ball_diameter * units.length
    if length <= diameter:
        refuse(
            f"--table-length {length / units.length:g} leaves no room for a ball of "
            f"{diameter / units.length:g} {units.length_word}; give both in {units.length_word}"
            + (", or leave --metric out" if units is not PLAYERS else "")
        )
    distance = length - diameter
    found = table_speed(lag_time, distance=distance)
    first = lag_speed(lag_time, distance=distance) / units.speed
    speed_key, length_key = f"first_speed_{units.speed_key}", f"roll_{units.length_key}"
    answer = {
        "table_speed": found,
        "mu_roll": 1.0 / found,
        "cloth": cloth_class(found),
        speed_key: first,
        length_key: distance / units.length,
    }
    print_answer(
        answer,
        shown={
            "table_speed": ("table speed", 1),
            "mu_roll": ("effective friction of rolling, 1 / table speed", 4),
            length_key: (f"how far the ball's centre rolls, {units.length_word}", 2),
            speed_key: (f"its speed off the cushion, {units.speed_word}", 2),
        },
        heading=(
            f"The table speed is {decimals(found, 0)}: {answer['cloth']}.{_doubt(found, units)}"
        ),
        as_json=as_json,
    )


def _doubt(speed: float, units: Units) -> str:
    """Return what to look at if hardly any table has such a speed."""
    if LEAST <= speed <= MOST:
        return ""
    return f"\nHardly any table has that: check the time, and that lengths are {units.length_word}."


def cloth_class(speed: float) -> str:
    """Return what a table of this speed is called.

    >>> [cloth_class(speed) for speed in (40.0, 75.0, 100.0, 110.0, 130.0, 160.0)]
    ... # doctest: +NORMALIZE_WHITESPACE
    ['slower than very slow', 'between very slow and normal', 'normal',
     'between normal and very fast', 'very fast', 'fast billiard']
    """
    from evenbreak.physics import TABLE_SPEEDS

    below = None
    for name, (low, high) in TABLE_SPEEDS.items():
        if speed < low:
            return f"slower than {name}" if below is None else f"between {below} and {name}"
        if speed <= high:
            return name
        below = name
    return str(below)
