"""`evenbreak physics aim`: where to aim to allow for throw."""

from dataclasses import replace
from typing import Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.physics.units import Units
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.physics.hit_options import hit_of, hit_options
from evenbreak.cli.physics.measures import LENGTH, metric_option
from evenbreak.errors import InputError

EXAMPLES = """\b
Examples:
  evenbreak physics aim --cut 14.5 --distance 36
  evenbreak physics aim --cut -14.5 --distance 36 --topspin 0 --mu 0.06
  evenbreak physics aim --cut 30 --distance 36 --topspin 0 --speed 60
  evenbreak physics aim --cut 30 --distance 100 --side 0.2 --metric
"""


@click.command("aim", epilog=EXAMPLES)
@hit_options
@click.option("--distance", type=LENGTH, required=True, help="From the object ball to the pocket.")
@metric_option
@faces()
def command(distance: float, units: Units, **hit: Any) -> Answer:
    """Find where to aim so that the thrown object ball goes in.

    --cut is the angle at which the object ball has to leave. The answer is a point beside
    the middle of the pocket: aim at it as if there were no throw. The rule of thumb is
    friction x distance x sine of the cut angle, for a cue ball that rolls without english.
    Hard shots are thrown less than soft ones: give --speed to allow for that.
    """
    from evenbreak.answers.physics.hit import aim_answer
    from evenbreak.answers.physics.units import unit_doubts

    asked = hit_of(units, **hit)
    try:
        answer = aim_answer(asked, distance * units.length.size, units)
    except InputError:
        refuse(
            f"--cut {hit['cut']:g} cannot be reached: friction throws every hit fuller than "
            "that; give a smaller cut angle, or another --topspin or --side"
        )
    return replace(answer, warnings=unit_doubts(units, speed=hit["speed"]))
