"""Where to aim to allow for throw."""

import math
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantities
from evenbreak.answers.physics.hit import SQUIRT, Hit, degrees
from evenbreak.answers.physics.units import Unit, Units
from evenbreak.physics.throw import aim, gearing_side, throw_factor, throw_sensitivity


def aim_answer(hit: Hit, distance: float, units: Units) -> Answer:
    """Return where to aim so that the object ball, thrown, reaches its target.

    Parameters
    ----------
    hit
        its cut is the angle at which the object ball has to leave.
    distance
        from the object ball to the middle of the pocket, in metres.
    units
        in which the answer is given.

    Raises
    ------
    InputError
        if the object ball cannot be cut that thin.

    >>> from evenbreak.answers.physics.units import IMPERIAL
    >>> hit = Hit(-14.5, 0.0, 0.0, 0.06, "limited")
    >>> answer = aim_answer(hit, 0.9144, IMPERIAL)
    >>> print(answer.sentences[0])
    Aim 1.57 inches to the left of the middle of the pocket (a thinner cut); throw brings the
    ball back.
    """
    length, (angle, topspin, side) = units.length, hit.cut_and_spin
    friction: dict[str, Any] = {"mu": hit.mu, "friction": hit.friction, "speed": hit.speed}
    found = aim(angle, distance, topspin, side, **friction)
    aimed = hit.collide(found.cut)
    offset = hit.hand * found.offset
    angles = {"throw_deg": math.degrees(found.throw), "aim_cut_deg": math.degrees(found.cut)}
    quantities = [
        *hit.asked(aimed, units.speed),
        length.quantity("distance", distance),
        *quantities_of(angles),
        length.quantity("offset_to_aim", offset),
        length.quantity("rule_offset", hit.hand * found.offset_of_text),
    ]
    left_out = [SQUIRT] if hit.side else []
    return Answer(
        hit.heading(aimed, units.speed, f"{length.typed(distance)} to the pocket"),
        [aim_words(offset, hit.hand * found.cut, hit, length), *left_out, Quantities(quantities)],
    )


def aim_words(offset: float, cut: float, hit: Hit, length: Unit) -> str:
    """Return where to aim, in a sentence.

    Parameters
    ----------
    offset
        to the right of the middle of the pocket, in metres.
    cut
        the cut angle to aim for, below 0 if it is to the side opposite to that of the hit.
    hit, length
        the hit, and the unit of the offset.
    """
    amount = length.text(abs(offset), 2)
    if amount.startswith("0.00 "):
        return f"Aim at the middle of the pocket: throw is less than 0.01 {length.words} there."
    side = "right" if offset > 0.0 else "left"
    thinness = "a thinner cut" if side == hit.towards else "a fuller cut"
    if cut < 0.0:
        thinness = f"a cut to the {hit.away}"
    note = f" ({thinness})" if hit.cut else ""
    return (
        f"Aim {amount} to the {side} of the middle of the pocket{note}; throw brings the ball back."
    )


def throw_answer(hit: Hit, units: Units) -> Answer:
    """Return the throw of a hit.

    >>> from evenbreak.answers.physics.units import IMPERIAL
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
        "throw_sensitivity": sensitivity if math.isfinite(sensitivity) else None,
        "friction_stops": math.tan(abs(found.throw)) < (1.0 - 1e-9) * found.mu * abs(factor),
        "no_throw_side": gearing_side(shot[0]),
        "object_side": given,
    }
    quantities = [*hit.asked(found, units.speed), *quantities_of(values)]
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
