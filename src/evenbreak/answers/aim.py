"""Where to aim to allow for throw."""

import math
from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.hit import SQUIRT, Hit
from evenbreak.answers.parts import Quantities
from evenbreak.answers.shot_units import Unit, Units
from evenbreak.answers.worded import worded
from evenbreak.physics.throw import aim

_WORDS = {"throw_deg": ("throw, degrees", 2), "aim_cut_deg": ("cut angle to aim for, degrees", 2)}


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

    >>> from evenbreak.answers.shot_units import IMPERIAL
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
        *worded(angles, _WORDS),
        length.quantity("offset", offset, "aim to the right of the middle of the pocket"),
        length.quantity(
            "rule_offset", hit.hand * found.offset_of_text, "the same by the rule of thumb"
        ),
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
