"""`evenbreak physics strike`: what a hit off the centre of the cue ball gives."""

import math
from dataclasses import replace

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.physics.equipment_options import ball_of, cue_of, equipment_options
from evenbreak.cli.physics.hit_options import tip_options
from evenbreak.cli.physics.measures import SPEED, Measure, metric_option

EXAMPLES = """\b
Examples:
  evenbreak physics strike --offset 0.4
  evenbreak physics strike --offset -0.3 --side-offset 0.1 --stick 19 --stick-speed 60
  evenbreak physics strike --offset -0.3 --stick-speed 60 --distance 24
"""


@click.command("strike", epilog=EXAMPLES)
@tip_options(required=True)
@click.option(
    "--stick-speed",
    type=SPEED,
    help="Speed of the cue just before the hit; needed for speeds and distances.",
)
@click.option(
    "--distance",
    type=Measure("length", 0.0, 1e5, "24"),
    help="Add the spin that is left after this distance; with --stick-speed.",
)
@equipment_options
@metric_option
@faces()
def command(
    offset: float,
    side_offset: float,
    stick: float | None,
    ball: float | None,
    stick_speed: float | None,
    distance: float | None,
    cloth_mu: float,
    tip_mu: float,
    units: Units,
) -> Answer:
    """Find the spin and speed that a hit off centre gives, and whether it is a miscue.

    Offsets are in ball radii: a hit 0.4 above the centre gives natural roll at once.
    """
    from evenbreak.answers.physics.strike import strike_answer
    from evenbreak.answers.physics.units import unit_doubts
    from evenbreak.physics import Cloth, strike

    if distance is not None and stick_speed is None:
        refuse(f"--distance {distance:g} needs the speed of the cue; give --stick-speed")
    from_centre = math.hypot(offset, side_offset)
    if from_centre >= 1.0:
        refuse(
            f"--offset {offset:g} with --side-offset {side_offset:g} misses the ball: "
            f"{from_centre:.3g} radii from the centre; together they must be less than 1"
        )
    answer = strike_answer(
        strike(
            1.0 if stick_speed is None else stick_speed * units.speed.size,
            offset,
            side_offset,
            ball=ball_of(ball, units),
            cue=cue_of(stick, tip_mu, units),
        ),
        units,
        cloth=Cloth(mu_slide=cloth_mu),
        distance=None if distance is None else distance * units.length.size,
        speed_known=stick_speed is not None,
    )
    doubts = unit_doubts(units, stick=stick, ball=ball, stick_speed=stick_speed)
    return replace(answer, warnings=doubts)
