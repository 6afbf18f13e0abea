"""`evenbreak physics breakcue`: which cue breaks best for an arm."""

from dataclasses import replace

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.physics.equipment_options import ball_of, ball_option
from evenbreak.cli.physics.measures import WEIGHT, Measure, metric_option

EXAMPLES = """\b
Examples:
  evenbreak physics breakcue --forearm 36
  evenbreak physics breakcue --forearm 36 --stick 19
  evenbreak physics breakcue --forearm 1020 --ball 165 --metric
"""


@click.command("breakcue", epilog=EXAMPLES)
@click.option(
    "--forearm",
    type=Measure("weight", 0.0, 1e6, "36"),
    required=True,
    help="Weight of forearm and hand; of the whole arm if you break from the shoulder.",
)
@ball_option
@click.option("--stick", type=WEIGHT, help="Compare with a cue of this weight.")
@metric_option
@faces()
def command(forearm: float, ball: float | None, stick: float | None, units: Units) -> Answer:
    """Find the weight of the cue that breaks best.

    The best cue passes the largest share of the stroke's energy, that of arm and cue
    together, on to the cue ball. The forearm is taken as a uniform rod swinging from the elbow.
    """
    from evenbreak.answers.physics.strike import break_cue_answer
    from evenbreak.answers.physics.units import unit_doubts

    weight = units.mass
    answer = break_cue_answer(
        forearm * weight.size,
        ball_of(ball, units).mass,
        weight,
        None if stick is None else stick * weight.size,
    )
    return replace(answer, warnings=unit_doubts(units, forearm=forearm, stick=stick, ball=ball))
