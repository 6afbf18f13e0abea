"""`evenbreak physics throw`: how friction between the balls turns the object ball off its line."""

from typing import Any

import click

from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.physics.hit_options import hit_of, hit_options

EXAMPLES = """\b
Examples:
  evenbreak physics throw --cut 30
  evenbreak physics throw --cut 30 --topspin 1 --side -0.3 --mu 0.0556
  evenbreak physics throw --cut 10 --topspin 0 --friction shepard
"""


@click.command("throw", epilog=EXAMPLES)
@hit_options
@faces()
def command(**hit: Any) -> Answer:
    """Find how far friction throws the object ball off the line of centres.

    Throw above 0 is forward: it makes the cut fuller, and the ball misses thick. The speed
    of the shot does not matter here.
    """
    from evenbreak.answers.throw import throw_answer

    return throw_answer(hit_of(**hit))
