"""`evenbreak physics deflect`: where the cue ball goes after the hit."""

from __future__ import annotations

import math
from typing import Any

import click

from evenbreak.cli.kit.callbacks import wants_json
from evenbreak.cli.physics.hit_options import Hit, hit_options
from evenbreak.cli.physics.units import decimals, print_answer

SHOWN = {
    "deflection_deg": ("deflection of the cue ball once it rolls, degrees", 2),
    "deflection_thrown_deg": ("deflection with friction between the balls, degrees", 2),
    "throw_deg": ("throw of the object ball, degrees", 2),
    "departure_deg": ("angle between the two balls' paths at first, degrees", 2),
    "sensitivity": ("change of the deflection by a degree of cut, degrees", 3),
    "largest_deflection_deg": ("largest deflection at any cut, degrees", 2),
    "largest_deflection_cut_deg": ("the cut angle of that, degrees", 2),
    "right_angle_cut_deg": ("cut angle of a deflection by 90 degrees, degrees", 2),
    "object_energy_share": ("the object ball's share of the energy after the hit", 3),
    "object_energy_share_rolling": ("its share once both balls roll", 3),
    "equal_energy_cut_deg": ("cut angle at which both then have as much, degrees", 2),
}

EXAMPLES = """\b
Examples:
  evenbreak physics deflect --cut 30
  evenbreak physics deflect --cut 40 --topspin -1
  evenbreak physics deflect --cut -30 --topspin 0 --mu 0.08
"""


@click.command("deflect", epilog=EXAMPLES)
@hit_options
@wants_json
def command(as_json: bool, **how: Any) -> None:
    """Tell where the cue ball goes after the hit.

    The deflection is the angle from where the cue ball was going to where it goes once it
    rolls, 0 to 180 degrees, away from the object ball's side. --side, --mu and --friction
    only matter where friction between the balls or throw is named.
    """
    from evenbreak.physics import collide, deflection_slope

    hit = Hit(**how)
    found = collide(hit.angle, hit.topspin, hit.side_in_frame, mu=hit.mu, friction=hit.friction)
    at, thrown = _deflection(hit), _thrown_deflection(found)
    answer = {
        **hit.as_answer(),
        "deflection_deg": at,
        "deflection_thrown_deg": thrown,
        "throw_deg": math.degrees(found.throw),
        "departure_deg": _departure(found),
        "sensitivity": None if at is None else deflection_slope(hit.angle, hit.topspin),
        **_marks(hit.topspin),
        **_shares(hit),
    }
    print_answer(
        answer, shown=SHOWN, heading=f"{hit.text}\n{_where(at, thrown, hit)}", as_json=as_json
    )


def _deflection(hit: Hit) -> float | None:
    """Return the deflection without friction in degrees, or None for a ball that stands still."""
    from evenbreak.physics import deflection

    if hit.cut == 0.0 and hit.topspin == 0.0:
        return None
    return math.degrees(deflection(hit.angle, hit.topspin))


def _departure(found: Any) -> float | None:
    """Return the angle between the two paths in degrees, or None for a ball that stands still."""
    slowest = min(math.hypot(*ball[:2]) for ball in (found.object_velocity, found.cue_velocity))
    return None if slowest < 1e-12 else math.degrees(found.departure)


def _thrown_deflection(found: Any) -> float | None:
    """Return the deflection with the friction of the hit in degrees, below 0 to the other side."""
    from evenbreak.physics import roll_velocity

    velocity = roll_velocity(found.cue_velocity[:2], found.ball.radius * found.cue_spin)
    ahead, left = map(float, velocity)
    return None if math.hypot(ahead, left) < 1e-12 else math.degrees(math.atan2(left, ahead))


def _marks(topspin: float) -> dict[str, float | None]:
    """Return the cut angles at which a deflection of this spin is remarkable, in degrees."""
    from evenbreak.physics import (
        deflection,
        largest_deflection_cut,
        right_angle_cut,
        split_roll_cut,
    )

    # With next to no topspin it is that of stun, which is larger the fuller the hit.
    largest = largest_deflection_cut(topspin) if topspin > 1e-9 else None
    square = right_angle_cut(topspin) if -2.5 <= topspin < 0.0 else None
    split = split_roll_cut(topspin) if abs(topspin) <= 2.5 else None
    return {
        "largest_deflection_deg": _degrees(largest and deflection(largest, topspin)),
        "largest_deflection_cut_deg": _degrees(largest),
        "right_angle_cut_deg": _degrees(square),
        "equal_energy_cut_deg": _degrees(split),
    }


def _degrees(angle: float | None) -> float | None:
    return None if angle is None else math.degrees(angle)


def _shares(hit: Hit) -> dict[str, float]:
    """Return the object ball's share of what energy the balls have, without friction."""
    from evenbreak.physics import energy_after_hit, energy_in_roll

    after = energy_after_hit(hit.angle, hit.topspin)
    rolling = energy_in_roll(hit.angle, hit.topspin)
    return {
        "object_energy_share": after.object_ball / (after.object_ball + after.cue_ball),
        "object_energy_share_rolling": rolling.object_ball
        / (rolling.object_ball + rolling.cue_ball),
    }


def _where(deflection: float | None, thrown: float | None, hit: Hit) -> str:
    """Return where the cue ball goes, in a sentence."""
    smooth, rough = _way(deflection, hit), _way(thrown, hit)
    first = f"{'The' if deflection is None else 'Once it rolls, the'} cue ball {smooth}"
    return (
        f"{first}." if smooth == rough else f"{first}; with friction between the balls it {rough}."
    )


def _way(deflection: float | None, hit: Hit) -> str:
    """Return which way a deflection is; below 0 it is to the side of the object ball."""
    if deflection is None:
        return "stands still"
    amount = decimals(abs(deflection))
    straight = {"0.00": "goes straight on", "180.00": "comes straight back"}
    side = hit.other_turn if deflection > 0.0 else hit.turn
    return straight.get(amount, f"goes {amount} degrees to the {side}")
