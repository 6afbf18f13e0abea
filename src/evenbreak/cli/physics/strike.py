"""`evenbreak physics strike`: what a hit off the centre of the cue ball gives."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import refuse, wants_json
from evenbreak.cli.physics.equipment_options import ball_of, cue_of, doubts, kit_options
from evenbreak.cli.physics.hit_options import spin_text
from evenbreak.cli.physics.units import Measure, Units, decimals, print_answer, wants_metric

if TYPE_CHECKING:
    from evenbreak.physics import Cloth, Strike

EXAMPLES = """\b
Examples:
  evenbreak physics strike --offset 0.4
  evenbreak physics strike --offset -0.3 --side-offset 0.1 --stick 19 --stick-speed 60
  evenbreak physics strike --offset -0.3 --stick-speed 60 --distance 24
"""


@click.command("strike", epilog=EXAMPLES)
@click.option(
    "--offset",
    metavar="B",
    type=Measure(-1.0, 1.0, "0.4"),
    required=True,
    help="How far above the centre the tip hits, over the ball's radius; below 0 for draw.",
)
@click.option(
    "--side-offset",
    metavar="B",
    type=Measure(-1.0, 1.0, "0.2"),
    default=0.0,
    show_default=True,
    help="How far to the right of the centre; below 0 to the left.",
)
@click.option(
    "--stick-speed",
    metavar="SPEED",
    type=Measure(0.01, 1e5, "60"),
    help="Of the cue just before the hit; for speeds and distances.",
)
@click.option(
    "--distance",
    metavar="LENGTH",
    type=Measure(0.0, 1e5, "24"),
    help="Tell the spin that is left when the ball has gone so far; with --stick-speed.",
)
@kit_options
@wants_metric
@wants_json
def command(
    offset: float,
    side_offset: float,
    stick: float | None,
    ball: float | None,
    stick_speed: float | None,
    distance: float | None,
    cloth_mu: float,
    tip_mu: float,
    units: Units,
    as_json: bool,
) -> None:
    """Tell what spin and speed a hit off centre gives, and whether it miscues.

    Offsets are shares of the ball's radius: 0.4 above the centre is natural roll at once.
    """
    from evenbreak.physics import Cloth, strike

    if distance is not None and stick_speed is None:
        refuse(f"--distance {distance:g} needs the speed of the cue; give --stick-speed")
    from_centre = math.hypot(offset, side_offset)
    if from_centre >= 1.0:
        refuse(
            f"--offset {offset:g} with --side-offset {side_offset:g} is beside the ball: "
            f"{from_centre:.3g} of its radius from the centre; give less than 1 together"
        )
    hit = strike(
        1.0 if stick_speed is None else stick_speed * units.speed,
        offset,
        side_offset,
        ball=ball_of(ball, units),
        cue=cue_of(stick, tip_mu, units),
    )
    cloth = Cloth(mu_slide=cloth_mu)
    answer = {
        **_spin(hit),
        **_speeds(hit, cloth, units, known=stick_speed is not None),
        **_later(hit, distance, cloth, units),
    }
    if hit.miscue:  # the tip slips, and none of this comes true
        answer = dict.fromkeys(answer)
    place = _place(hit)
    heading = _text(hit) + doubts(units, stick=stick, ball=ball, stick_speed=stick_speed)
    print_answer({**place, **answer}, shown=_shown(units), heading=heading, as_json=as_json)


def _place(hit: Strike) -> dict[str, Any]:
    """Return where the tip hits, and whether it holds."""
    from evenbreak.physics import miscue_offset

    return {
        "offset": hit.offset,
        "side_offset": hit.side_offset,
        "off_centre": hit.off_centre,
        "miscue": hit.miscue,
        "miscue_offset": miscue_offset(hit.cue.tip_friction),
    }


def _spin(hit: Strike) -> dict[str, Any]:
    """Return the spin, and speeds over that of the cue, just after the hit and in natural roll."""
    from evenbreak.physics import ball_speed_ratio, roll_side, roll_speed

    ratio = ball_speed_ratio(hit.off_centre, hit.ball.mass / hit.cue.mass)
    return {
        "spin_speed_ratio": hit.topspin,
        "side_spin_speed_ratio": hit.side,
        "roll_side_spin_speed_ratio": roll_side(-hit.side_offset, 1.0 + hit.offset),
        "ball_speed_ratio": ratio,
        "roll_speed_ratio": roll_speed(ratio, ratio * hit.topspin),
    }


def _speeds(hit: Strike, cloth: Cloth, units: Units, *, known: bool) -> dict[str, float | None]:
    """Return speeds and distances, or nothing of them where no speed of the cue is known."""
    from evenbreak.physics import drag_distance, roll_speed, stun_distance

    speed, length = units.speed_key, units.length_key
    spin = hit.topspin
    found = {
        f"ball_speed_{speed}": hit.speed / units.speed,
        f"stick_speed_after_{speed}": hit.stick_speed_after / units.speed,
        f"roll_speed_{speed}": roll_speed(hit.speed, hit.speed * spin) / units.speed,
        f"slide_{length}": drag_distance(hit.speed, spin, cloth) / units.length,
        f"stun_{length}": stun_distance(hit.speed, min(spin, 0.0), cloth) / units.length,
    }
    if not known:
        return dict.fromkeys(found)
    return found if spin < 0.0 else {**found, f"stun_{length}": None}


def _later(
    hit: Strike, distance: float | None, cloth: Cloth, units: Units
) -> dict[str, float | None]:
    """Return the spin after a distance, and where to hit for a stun there at the same speed."""
    from evenbreak.errors import InputError
    from evenbreak.physics import ContactPoint, effective_contact, miscue_offset, stun_offset

    names = ("later_spin_speed_ratio", "later_side_spin_speed_ratio", "later_offset", "stun_offset")
    if distance is None:
        return dict.fromkeys(names)
    ahead = distance * units.length
    struck = ContactPoint(-hit.side_offset, 1.0 + hit.offset)
    now = effective_contact(struck, hit.speed, _time_of(ahead, hit, cloth), cloth)
    try:
        stun = stun_offset(hit.speed, ahead, cloth)
    except InputError:  # a ball of this speed does not slide so far
        stun = None
    if stun is not None and -stun > miscue_offset(hit.cue.tip_friction):
        stun = None
    return dict(zip(names, (2.5 * (now.z - 1.0), -2.5 * now.y, now.z - 1.0, stun), strict=True))


def _time_of(ahead: float, hit: Strike, cloth: Cloth) -> float:
    """Return when the ball has slid so far, or begins to roll before that, in seconds."""
    speed, slip = float(hit.speed), 1.0 - float(hit.topspin)
    slowing = math.copysign(cloth.mu_slide * cloth.gravity, slip)
    rolls = 2.0 * abs(slip) * speed / (7.0 * abs(slowing))
    left = speed**2 - 2.0 * slowing * ahead
    return rolls if left < 0.0 else min(rolls, 2.0 * ahead / (speed + math.sqrt(left)))


def _shown(units: Units) -> dict[str, tuple[str, int]]:
    """Return what a terminal shows."""
    speed, length = units.speed_key, units.length_key
    fast, far = units.speed_word, units.length_word
    return {
        "off_centre": ("distance of the tip from the centre, over the radius", 3),
        "miscue_offset": ("the largest without a miscue", 3),
        "spin_speed_ratio": ("topspin J, 1 is natural roll", 3),
        "side_spin_speed_ratio": ("sidespin J, right above 0", 3),
        "roll_side_spin_speed_ratio": ("sidespin J once the ball rolls", 3),
        "ball_speed_ratio": ("speed of the ball over that of the cue", 3),
        "roll_speed_ratio": ("the same once it rolls", 3),
        f"ball_speed_{speed}": (f"speed of the ball, {fast}", 2),
        f"stick_speed_after_{speed}": (f"speed of the cue after the hit, {fast}", 2),
        f"roll_speed_{speed}": (f"speed of the ball once it rolls, {fast}", 2),
        f"stun_{length}": (f"a stun shot after, {far}", 2),
        f"slide_{length}": (f"rolls after, {far}", 2),
        "later_spin_speed_ratio": ("at --distance: topspin J", 3),
        "later_side_spin_speed_ratio": ("at --distance: sidespin J", 3),
        "later_offset": ("at --distance: as if struck so far above the centre", 3),
        "stun_offset": ("--offset for a stun there, at this speed of the ball", 3),
    }


def _text(hit: Strike) -> str:
    """Return what the hit does, in a sentence."""
    from evenbreak.physics import miscue_offset, tip_friction_of

    if hit.miscue:
        holds = math.ceil(1000.0 * tip_friction_of(hit.off_centre)) / 1000.0
        return (
            f"A miscue: the tip slips so far from the centre. Hit within "
            f"{decimals(miscue_offset(hit.cue.tip_friction), 3)} of the radius; only a tip with a "
            f"friction of {holds:g} would hold, --tip-mu {holds:g}."
        )
    hand = "right" if hit.side > 0.0 else "left"
    english = f" and {hand} english" if hit.side else ""
    return f"No miscue. The cue ball leaves with {spin_text(hit.topspin)}{english}."
