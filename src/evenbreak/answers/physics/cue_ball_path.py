"""Where the cue ball goes after it hits the object ball."""

import math

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantities
from evenbreak.answers.physics.hit import Hit, degrees
from evenbreak.answers.physics.units import Units
from evenbreak.physics.collision import Collision
from evenbreak.physics.deflection import (
    EnergyShares,
    deflection,
    deflection_slope,
    energy_after_hit,
    energy_in_roll,
    largest_deflection_cut,
    right_angle_cut,
    split_roll_cut,
)
from evenbreak.physics.slide import roll_velocity

_AT_REST = 1e-12
"""The speed below which a ball counts as standing still, over that of the cue ball."""


def cue_ball_path_answer(hit: Hit, units: Units) -> Answer:
    """Return the deflection of the cue ball: the angle by which its path turns.

    >>> from evenbreak.answers.physics.units import IMPERIAL
    >>> answer = cue_ball_path_answer(Hit(30.0, 1.0, 0.0, 0.0556, "limited"), IMPERIAL)
    >>> print(answer.sentences[0])
    Once it rolls, the cue ball goes 35.73 degrees to the left; without friction between the
    balls it would go 33.67 degrees to the left.
    """
    found = hit.collide()
    angle, topspin, _ = hit.cut_and_spin
    stops = hit.cut == 0.0 and topspin == 0.0
    smooth = None if stops else deflection(angle, topspin)
    rough = _deflection_with_friction(found)
    # With next to no topspin the deflection is that of stun, which is larger the fuller the hit.
    largest = largest_deflection_cut(topspin) if topspin > 1e-9 else None
    answers = {
        "deflection_deg": smooth,
        "deflection_thrown_deg": rough,
        "throw_deg": found.throw,
        "departure_deg": _departure(found),
        "deflection_sensitivity": None if stops else deflection_slope(angle, topspin),
        "largest_deflection_deg": None if largest is None else deflection(largest, topspin),
        "largest_deflection_cut_deg": largest,
        "right_angle_cut_deg": right_angle_cut(topspin) if -2.5 <= topspin < 0.0 else None,
        "equal_energy_cut_deg": split_roll_cut(topspin) if abs(topspin) <= 2.5 else None,
    }
    in_degrees = {
        name: math.degrees(one) if one is not None and name.endswith("_deg") else one
        for name, one in answers.items()
    }
    values = {
        **in_degrees,
        "object_energy_share": _object_share(energy_after_hit(angle, topspin)),
        "object_energy_share_rolling": _object_share(energy_in_roll(angle, topspin)),
    }
    sentence = path_words(in_degrees["deflection_thrown_deg"], in_degrees["deflection_deg"], hit)
    quantities = [*hit.asked(found, units.speed), *quantities_of(values)]
    return Answer(hit.heading(found, units.speed), [sentence, Quantities(quantities)])


def path_words(rough: float | None, smooth: float | None, hit: Hit) -> str:
    """Return where the cue ball goes, in a sentence.

    Parameters
    ----------
    rough, smooth
        the deflection in degrees with and without friction between the balls; None where the
        cue ball stands still.
    hit
        which side the object ball goes to.

    >>> path_words(None, None, Hit(0.0, 0.0, 0.0, 0.0556, "limited"))
    'The cue ball stops dead.'
    """
    first = f"{'Once it rolls, the' if rough is not None else 'The'} cue ball {_way(rough, hit)}"
    if _way(rough, hit) == _way(smooth, hit):
        return f"{first}."
    otherwise = _way(smooth, hit, verbs=("would stop", "would go", "would come"))
    return f"{first}; without friction between the balls it {otherwise}."


def _way(
    angle: float | None, hit: Hit, verbs: tuple[str, str, str] = ("stops", "goes", "comes")
) -> str:
    stop, go, come = verbs
    if angle is None:
        return f"{stop} dead"
    amount = degrees(abs(angle))
    straight = {"0.00": f"{go} straight on", "180.00": f"{come} straight back"}
    side = hit.away if angle > 0.0 else hit.towards
    return straight.get(amount, f"{go} {amount} degrees to the {side}")


def _deflection_with_friction(found: Collision) -> float | None:
    """Return the deflection in radians, below 0 to the side of the object ball."""
    rim_velocity = found.ball.radius * found.cue_spin
    ahead, left = map(float, roll_velocity(found.cue_velocity[:2], rim_velocity))
    if math.hypot(ahead, left) < _AT_REST * found.speed:
        return None
    return math.atan2(-left if found.cut < 0.0 else left, ahead)


def _departure(found: Collision) -> float | None:
    """Return the angle between the two paths in radians; None if a ball stands still."""
    slowest = min(math.hypot(*ball[:2]) for ball in (found.object_velocity, found.cue_velocity))
    return None if slowest < _AT_REST * found.speed else float(found.departure)


def _object_share(energies: EnergyShares) -> float:
    return float(energies.object_ball / (energies.object_ball + energies.cue_ball))
