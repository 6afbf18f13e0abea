"""How far friction between the balls throws the object ball off its line."""

import math

from evenbreak.answers.answer import Answer
from evenbreak.answers.hit import Hit, degrees
from evenbreak.answers.parts import Quantities
from evenbreak.answers.shot_units import Units
from evenbreak.answers.worded import worded
from evenbreak.physics.throw import gearing_side, throw_factor, throw_sensitivity

_WORDS = {
    "throw_deg": ("throw, degrees", 2),
    "object_cut_deg": ("angle at which the object ball leaves, degrees", 2),
    "no_throw_side": ("english that cancels the throw, --side", 3),
}
_DETAILS = {
    "throw_factor": ("share of the friction that acts sideways, -1 to 1", 3),
    "sensitivity": ("sensitivity: change of that share per unit of spin", 2),
    "friction_stops": ("the balls stop slipping during contact, which limits the throw", 0),
    "object_side": ("sidespin J that the object ball takes on", 3),
}


def throw_answer(hit: Hit, units: Units) -> Answer:
    """Return the throw of a hit.

    >>> from evenbreak.answers.shot_units import IMPERIAL
    >>> answer = throw_answer(Hit(30.0, 1.0, 0.0, 0.0556, "limited"), IMPERIAL)
    >>> print(answer.sentences[0])
    Throw takes 1.59 degrees off the cut: the object ball goes thick unless you aim thinner.
    """
    found = hit.collide()
    throw = math.degrees(found.throw)
    shot = hit.cut_and_spin
    factor, sensitivity = throw_factor(*shot), throw_sensitivity(*shot)
    given = -2.5 * found.sideways / math.hypot(found.ahead, found.sideways)
    values = {
        "throw_deg": throw,
        "object_cut_deg": hit.cut - hit.hand * throw,
        "throw_factor": factor,
        "sensitivity": sensitivity if math.isfinite(sensitivity) else None,
        "friction_stops": math.tan(abs(found.throw)) < (1.0 - 1e-9) * found.mu * abs(factor),
        "no_throw_side": gearing_side(shot[0]),
        "object_side": given,
    }
    quantities = [*hit.asked(found, units.speed), *worded(values, _WORDS, _DETAILS)]
    return Answer(
        hit.heading(found, units.speed), [throw_words(throw, hit), Quantities(quantities)]
    )


def throw_words(throw: float, hit: Hit) -> str:
    """Return what a throw, in degrees, does to the shot.

    >>> throw_words(1.418, Hit(0.0, 1.0, 0.5, 0.0556, "limited"))
    'The object ball is thrown 1.42 degrees to the left.'
    """
    amount = degrees(abs(throw))
    if float(amount) == 0.0:
        return "There is no throw: the object ball leaves along the line of centres."
    if hit.cut == 0.0:
        side = hit.away if throw > 0.0 else hit.towards
        return f"The object ball is thrown {amount} degrees to the {side}."
    if throw > 0.0:
        return (
            f"Throw takes {amount} degrees off the cut: the object ball goes thick unless you "
            "aim thinner."
        )
    return (
        f"Throw adds {amount} degrees to the cut: the object ball goes thin unless you aim fuller."
    )
