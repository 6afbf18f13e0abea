"""Where the cue ball goes after it hits the object ball."""

from __future__ import annotations

import math

from evenbreak.answers.answer import Answer, Quantities, Quantity
from evenbreak.answers.hit import Hit, degrees
from evenbreak.answers.wording import decimals
from evenbreak.physics.collision import Collision
from evenbreak.physics.deflection import (
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


def cue_ball_path_answer(hit: Hit) -> Answer:
    """Return the deflection of the cue ball: the angle by which its path turns.

    >>> answer = cue_ball_path_answer(Hit(30.0, 1.0, 0.0, 0.0556, "limited"))
    >>> print(answer.sentences[0])
    Once it rolls, the cue ball goes 35.73 degrees to the left; without friction between the
    balls it would go 33.67 degrees to the left.
    """
    found = hit.collide()
    angle, topspin, _ = hit.in_frame
    stops = hit.cut == 0.0 and topspin == 0.0
    smooth = None if stops else math.degrees(deflection(angle, topspin))
    rough = _deflection_with_friction(found)
    # With next to no topspin the deflection is that of stun, which is larger the fuller the hit.
    largest = largest_deflection_cut(topspin) if topspin > 1e-9 else None
    quantities = [
        *hit.quantities,
        _angle("deflection_deg", smooth, "deflection without friction between the balls"),
        _angle("deflection_thrown_deg", rough, "deflection with friction between the balls"),
        _angle("throw_deg", math.degrees(found.throw), "throw of the object ball"),
        _angle(
            "departure_deg", _departure(found), "angle between the two paths just after the hit"
        ),
        Quantity(
            "sensitivity",
            None if stops else deflection_slope(angle, topspin),
            "change of the deflection per degree of cut, degrees",
            decimals(3),
            detail=True,
        ),
        _angle(
            "largest_deflection_deg",
            None if largest is None else math.degrees(deflection(largest, topspin)),
            "largest deflection at any cut",
            detail=True,
        ),
        _angle("largest_deflection_cut_deg", _degrees(largest), "cut for that", detail=True),
        _angle(
            "right_angle_cut_deg",
            _degrees(right_angle_cut(topspin)) if -2.5 <= topspin < 0.0 else None,
            "cut for a deflection of 90 degrees",
            detail=True,
        ),
        _angle(
            "equal_energy_cut_deg",
            _degrees(split_roll_cut(topspin)) if abs(topspin) <= 2.5 else None,
            "cut at which both balls roll with the same energy",
            detail=True,
        ),
        *_energy_shares(angle, topspin),
    ]
    return Answer(hit.description, [path_words(rough, smooth, hit), Quantities(quantities)])


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
    """Return the deflection in degrees, below 0 to the side of the object ball."""
    rim_velocity = found.ball.radius * found.cue_spin
    ahead, left = map(float, roll_velocity(found.cue_velocity[:2], rim_velocity))
    return None if math.hypot(ahead, left) < _AT_REST else math.degrees(math.atan2(left, ahead))


def _departure(found: Collision) -> float | None:
    """Return the angle between the two paths in degrees; None if a ball stands still."""
    slowest = min(math.hypot(*ball[:2]) for ball in (found.object_velocity, found.cue_velocity))
    return None if slowest < _AT_REST else math.degrees(found.departure)


def _energy_shares(angle: float, topspin: float) -> list[Quantity]:
    """Return the object ball's share of the energy of both balls, without friction."""
    shares = []
    for name, words, energies in (
        ("object_energy_share", "just after the hit", energy_after_hit(angle, topspin)),
        ("object_energy_share_rolling", "once both roll", energy_in_roll(angle, topspin)),
    ):
        share = energies.object_ball / (energies.object_ball + energies.cue_ball)
        heading = f"the object ball's share of the energy {words}"
        shares.append(Quantity(name, share, heading, decimals(3), detail=True))
    return shares


def _angle(name: str, angle: float | None, words: str, *, detail: bool = False) -> Quantity:
    return Quantity(name, angle, f"{words}, degrees", degrees, detail=detail)


def _degrees(angle: float | None) -> float | None:
    return None if angle is None else math.degrees(angle)
