"""`evenbreak physics throw`: what friction between the balls does to the object ball's path."""

from __future__ import annotations

import math
from typing import Any

import click

from evenbreak.cli.kit.callbacks import wants_json
from evenbreak.cli.physics.hit_options import Hit, hit_options
from evenbreak.cli.physics.units import decimals, print_answer

SHOWN = {
    "throw_deg": ("throw, degrees", 2),
    "object_cut_deg": ("cut angle at which the object ball leaves, degrees", 2),
    "throw_factor": ("share of the friction that throws it sideways, -1 to 1", 3),
    "sensitivity": ("sensitivity: change of that share by a unit of spin", 2),
    "friction_stops": ("slip ends within the hit, so that the throw is less", 0),
    "no_throw_side": ("english that cancels the throw, --side", 3),
    "object_side": ("english that the object ball gets, J", 3),
}

EXAMPLES = """\b
Examples:
  evenbreak physics throw --cut 30
  evenbreak physics throw --cut 30 --topspin 1 --side -0.3 --mu 0.0556
  evenbreak physics throw --cut 10 --topspin 0 --friction shepard
"""


@click.command("throw", epilog=EXAMPLES)
@hit_options
@wants_json
def command(as_json: bool, **how: Any) -> None:
    """Tell how far friction throws the object ball off its line.

    The line is that of the two centres. A throw above 0 is forward: the ball misses thick.
    The speed does not matter.
    """
    from evenbreak.physics import collide, gearing_side, throw_factor, throw_sensitivity

    hit = Hit(**how)
    shot = (hit.angle, hit.topspin, hit.side_in_frame)
    found = collide(*shot, mu=hit.mu, friction=hit.friction)
    sensitivity = throw_sensitivity(*shot)
    mirror = -1.0 if hit.cut < 0.0 else 1.0
    factor = throw_factor(*shot)
    throw = math.degrees(found.throw)
    object_speed = math.hypot(found.ahead, found.sideways)
    answer = {
        **hit.as_answer(),
        "throw_deg": throw,
        "object_cut_deg": mirror * (abs(hit.cut) - throw),
        "throw_factor": factor,
        "sensitivity": sensitivity if math.isfinite(sensitivity) else None,
        "friction_stops": math.tan(abs(found.throw)) < (1.0 - 1e-9) * hit.mu * abs(factor),
        "no_throw_side": mirror * gearing_side(hit.angle),
        "object_side": -2.5 * mirror * found.sideways / object_speed,
    }
    print_answer(
        answer, shown=SHOWN, heading=f"{hit.text}\n{throw_text(throw, hit)}", as_json=as_json
    )


def throw_text(throw: float, hit: Hit) -> str:
    """Return what a throw in degrees does, in a sentence.

    >>> throw_text(1.591, Hit(30.0, 1.0, 0.0, 0.0556, "limited"))
    'The object ball is thrown 1.59 degrees forward: it misses thick (fuller).'
    >>> throw_text(1.418, Hit(0.0, 1.0, 0.5, 0.0556, "limited"))
    'The object ball is thrown 1.42 degrees to the left.'
    """
    amount = decimals(abs(throw))
    if float(amount) == 0.0:
        return "The object ball is not thrown: it leaves along the line of centres."
    if hit.cut == 0.0:  # neither thick nor thin
        side = hit.other_turn if throw > 0.0 else hit.turn
        return f"The object ball is thrown {amount} degrees to the {side}."
    way = "forward: it misses thick (fuller)" if throw > 0.0 else "backward: it misses thin"
    return f"The object ball is thrown {amount} degrees {way}."
