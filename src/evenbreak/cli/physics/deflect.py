"""`evenbreak physics deflect`: where the cue ball goes after the hit."""

from dataclasses import replace
from typing import Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.physics.hit_options import hit_of, hit_options
from evenbreak.cli.physics.measures import metric_option

EXAMPLES = """\b
Examples:
  evenbreak physics deflect --cut 30
  evenbreak physics deflect --cut 40 --topspin -1
  evenbreak physics deflect --cut -30 --topspin 0 --mu 0.08
"""


@click.command("deflect", epilog=EXAMPLES)
@hit_options
@metric_option
@faces()
def command(units: Units, **hit: Any) -> Answer:
    """Find where the cue ball goes after the hit.

    The deflection is the angle between the direction of the shot and the cue ball's path
    once it rolls: 0 to 180 degrees, away from the object ball. --side, --speed, --mu and
    --friction change only the angles that allow for friction between the balls.
    """
    from evenbreak.answers.physics.hit import cue_ball_path_answer
    from evenbreak.answers.physics.units import unit_doubts

    answer = cue_ball_path_answer(hit_of(units, **hit), units)
    return replace(answer, warnings=unit_doubts(units, speed=hit["speed"]))
