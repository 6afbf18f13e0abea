"""`evenbreak physics throw`: how friction between the balls turns the object ball off its line."""

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
  evenbreak physics throw --cut 30
  evenbreak physics throw --cut 30 --topspin 1 --side -0.3 --mu 0.0556
  evenbreak physics throw --cut 30 --topspin 0 --speed 150
  evenbreak physics throw --cut 10 --topspin 0 --friction shepard
"""


@click.command("throw", epilog=EXAMPLES)
@hit_options
@metric_option
@faces()
def command(units: Units, **hit: Any) -> Answer:
    """Find how far friction throws the object ball off the line of centres.

    Throw above 0 is forward: it makes the cut fuller, and the ball misses thick. Hard shots
    are thrown less than soft ones: give --speed to allow for that. Without it, friction is
    --mu at any speed.
    """
    from evenbreak.answers.physics.hit import throw_answer
    from evenbreak.answers.physics.units import unit_doubts

    answer = throw_answer(hit_of(units, **hit), units)
    return replace(answer, warnings=unit_doubts(units, speed=hit["speed"]))
