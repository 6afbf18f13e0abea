"""`evenbreak physics speed`: how fast a table is, from the time of a lag."""

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.physics.measures import LENGTH, Measure, metric_option

EXAMPLES = """\b
Examples:
  evenbreak physics speed --lag-time 7.0
  evenbreak physics speed --lag-time 6.2 --table-length 88
  evenbreak physics speed --lag-time 7.0 --table-length 254 --metric
"""


@click.command("speed", epilog=EXAMPLES)
@click.option(
    "--lag-time",
    type=Measure("seconds", 0.1, 1000.0, "7.0"),
    required=True,
    help="How long the ball rolls from the foot cushion to its stop at the head cushion.",
)
@click.option(
    "--table-length",
    type=LENGTH,
    help="Between the noses of the end cushions.  [default: 100 inches, nine feet]",
)
@click.option("--ball-diameter", type=LENGTH, help="Of the ball.  [default: 2.25 inches]")
@metric_option
@faces()
def command(
    lag_time: float, table_length: float | None, ball_diameter: float | None, units: Units
) -> Answer:
    """Find how fast a table is, from the time of a lag.

    Roll a ball off the foot cushion so that it just reaches the head cushion, time it from
    cushion to cushion, and average a few tries. A table speed of 80 to 100 is normal.
    """
    from evenbreak.answers.physics.strike import table_speed_answer
    from evenbreak.physics import Ball, PoolTable

    unit = units.length
    length = PoolTable().length if table_length is None else table_length * unit.size
    diameter = Ball().diameter if ball_diameter is None else ball_diameter * unit.size
    if length <= diameter:
        refuse(
            f"--table-length {length / unit.size:g} leaves no room for a ball of "
            f"{diameter / unit.size:g} {unit.words}; give both in {unit.words}"
        )
    return table_speed_answer(lag_time, length - diameter, units)
