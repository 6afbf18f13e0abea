"""A hit: the throw, where to aim, and where the cue ball goes."""

import math
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantities, Quantity
from evenbreak.answers.kit.wording import decimals
from evenbreak.answers.physics.units import Unit, Units
from evenbreak.physics.collision import Collision, collide
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
from evenbreak.physics.friction import SlipFriction
from evenbreak.physics.offset import SQUIRTS, TIPS_OF_MOST_ENGLISH, squirt_angle, tips_of_side
from evenbreak.physics.slide import roll_velocity
from evenbreak.physics.throw import aim, gearing_side, throw_factor, throw_sensitivity
from evenbreak.words import Parameter, Sentence, joined, say

degrees = decimals(2)
"""How to show an angle in degrees."""


class Hit(NamedTuple):
    """A hit: angles in degrees, positive to the right and negative to the left.

    With a positive cut, the object ball goes to the right. `topspin` is J_y: 1 is natural roll, 0
    stun, below 0 draw; `side` is J_z: above 0 right english. `mu` is the friction between the
    balls, or how it decreases with slip speed; the cue ball's speed, in m/s, is None if the
    friction doesn't depend on it.
    """

    cut: float
    topspin: float
    side: float
    mu: float | SlipFriction
    friction: str
    speed: float | None = None

    @property
    def hand(self) -> float:
        """The cut's sign: 1.0 to the right and for a full hit, -1.0 to the left."""
        return -1.0 if self.cut < 0.0 else 1.0

    @property
    def cut_and_spin(self) -> tuple[float, float, float]:
        """The cut angle in radians, J_y and J_z.

        No decimal gives sin(30 degrees) to the last bit, and the difference would leave a tiny
        slip, for which the source text's formula gives the full throw.
        """
        angle = math.radians(self.cut)
        without_slip = float(gearing_side(angle))
        exact = abs(self.side - without_slip) < 1e-12
        return angle, self.topspin, without_slip if exact else self.side

    def collide(self, cut: float | None = None) -> Collision:
        """Return what the balls do, using another cut angle in radians if given."""
        angle, topspin, side = self.cut_and_spin
        angle, speed = angle if cut is None else cut, 1.0 if self.speed is None else self.speed
        return collide(angle, topspin, side, speed=speed, mu=self.mu, friction=self.friction)

    @property
    def toward(self) -> str:
        """The side the object ball is cut to; a full hit counts as a cut to the right."""
        return "left" if self.cut < 0.0 else "right"

    @property
    def away(self) -> str:
        """The other side."""
        return "right" if self.cut < 0.0 else "left"

    @property
    def english(self) -> str | None:
        """'outside' or 'inside'; 'left' or 'right' for a full hit; None without english."""
        if self.side == 0.0:
            return None
        if self.cut == 0.0:
            return "right" if self.side > 0.0 else "left"
        return "inside" if (self.side > 0.0) == (self.cut > 0.0) else "outside"

    @property
    def description(self) -> str:
        """What is hit and how, on one line.

        >>> Hit(30.0, 1.0, -0.3, 0.0556, "limited").description
        'A cut of 30 degrees to the right; natural roll, outside (left) english, 0.34 tips'
        """
        english = f"{self.english or 'no'} english"
        if self.english in ("inside", "outside"):
            english = f"{self.english} ({'right' if self.side > 0.0 else 'left'}) english"
        tips = abs(tips_of_side(self.side))
        if 0.0 < tips <= TIPS_OF_MOST_ENGLISH + 1e-9:
            english += f", {tips:.2g} {'tip' if round(tips, 2) == 1.0 else 'tips'}"
        return f"{cut_words(self.cut)}; {spin_words(self.topspin)}, {english}"

    def asked(self, found: Collision, speed: Unit) -> list[Quantity]:
        """Return the question, which comes before the answer in files."""
        values: dict[str, Any] = {
            "-cut_deg": self.cut,
            "topspin": self.topspin,
            "-side": self.side,
            "english": self.english,
            **friction_values(self.mu, found, self.friction),
        }
        return [*quantities_of(values), speed.quantity("-hit_speed", self.speed)]

    def heading(self, found: Collision, speed: Unit, *more: str) -> str:
        """Return what is hit and how, and the assumed friction, in two lines."""
        pace = [] if self.speed is None else [f"cue ball at {speed.typed(self.speed)}"]
        shot = "; ".join([self.description, *pace, *more])
        return f"{shot}\n{friction_words(self.mu, found, self.friction)}"


def friction_values(mu: float | SlipFriction, found: Collision | None, law: str) -> dict[str, Any]:
    """Return the friction between the balls for files: the coefficient in this hit."""
    by_speed = isinstance(mu, SlipFriction)
    known = None if found is None else float(found.mu)
    return {"mu": known if by_speed else mu, "mu_by_speed": by_speed, "friction": law}


def friction_words(mu: float | SlipFriction, found: Collision | None, law: str) -> str:
    """Return the assumption about the friction between the balls.

    >>> friction_words(0.0556, None, "limited")
    'Friction between the balls: 0.0556, the same at any speed'
    >>> print(friction_words(SlipFriction(), collide(0.5, speed=4.0, mu=SlipFriction()), "limited"))
    Friction between the balls: 0.0113 at this speed, less on harder shots (Alciatore's fit)
    """
    if not isinstance(mu, SlipFriction):
        words = f"{mu:.3g}, the same at any speed"
    else:
        at_hit = "" if found is None else f"{found.mu:.3g} at this speed, "
        source = " (Alciatore's fit)" if mu == SlipFriction() else ""
        words = f"{at_hit}less on harder shots{source}"
    throughout = "; it acts throughout the hit" if law == "shepard" else ""
    return f"Friction between the balls: {words}{throughout}"


def cut_words(cut: float) -> str:
    """Return a cut angle in degrees, in words.

    >>> cut_words(1.0), cut_words(-14.5), cut_words(0.0)
    ('A cut of 1 degree to the right', 'A cut of 14.5 degrees to the left', 'A full hit')
    """
    if cut == 0.0:
        return "A full hit"
    size = abs(cut)
    side = "left" if cut < 0.0 else "right"
    return f"A cut of {size:g} degree{'' if size == 1.0 else 's'} to the {side}"


SQUIRT = (
    "Squirt and swerve are left out. With english, the cue ball leaves the tip a little to one "
    "side of the cue's line, away from the english; with a raised cue, it then curves back. "
    "Allow for both, so that the cue ball travels along the line given here. To find out how "
    "much, shoot the length of the table with this english and see how far off the ball lands."
)
"""What an answer about where to aim can't tell if there is english."""


def spin_words(topspin: float) -> str:
    """Return what players call a spin of J_y.

    >>> spin_words(1.0), spin_words(0.0), spin_words(-0.5), spin_words(-1.0)
    ('natural roll', 'stun', 'draw (-0.50)', 'reverse natural roll')
    """
    named = {1.0: "natural roll", 0.0: "stun", -1.0: "reverse natural roll"}
    kind = "topspin" if topspin > 0.0 else "draw"
    return named.get(topspin) or f"{kind} ({degrees(topspin)})"


SWERVE = say(
    "Swerve is left out: a raised cue makes the ball curve back to the side of the english, most "
    "in soft, long shots. Cues differ: shoot the length of the table hard with 100% english, and "
    "give {squirt} the degrees by which the ball lands off line.",
    squirt=Parameter("squirt"),
)
"""What an answer about where to aim can't tell if squirt is allowed for."""


def squirt_words(angle: float, units: Units) -> Sentence:
    """Return where to point the cue so that the cue ball travels along its line.

    The angle is in degrees, positive with right english.

    >>> from evenbreak.answers.physics.units import IMPERIAL
    >>> print(squirt_words(-1.0, IMPERIAL))
    Point the cue 1.00 degrees to the left of the line that the cue ball has to travel (0.21 inches
    a foot): with left english it squirts to the right.
    """
    side, other = ("right", "left") if angle > 0.0 else ("left", "right")
    apart, far = (12.0, "foot") if units.length.key == "in" else (100.0, "meter")
    return say(
        "Point the cue {angle} degrees to the {side} of the line that the cue ball has to "
        "travel ({apart:.2f} {words} a {far}): with {side} english it squirts to the {other}.",
        angle=degrees(abs(angle)),
        side=side,
        apart=apart * math.tan(math.radians(abs(angle))),
        words=units.length.words,
        far=far,
        other=other,
    )


def aim_answer(
    hit: Hit, distance: float, units: Units, *, squirt: float = SQUIRTS["regular"]
) -> Answer:
    """Return where to aim so that the thrown object ball reaches its target.

    The hit's cut is the angle at which the object ball must leave; the distance to the pocket is in
    meters, and the squirt is in degrees at 100% english. Raises InputError if the ball can't be cut
    that thin.
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
    off = squirt_angle(hit.side, squirt)
    quantities += quantities_of({"squirt_deg": off})
    lines: list[str] = [aim_words(offset, hit.hand * found.cut, hit, length)]
    if off:
        lines = [joined([*lines, squirt_words(off, units)]), SWERVE]
    elif hit.side:
        lines.append(SQUIRT)
    return Answer(
        hit.heading(aimed, units.speed, f"{length.typed(distance)} to the pocket"),
        [*lines, Quantities(quantities)],
    )


def aim_words(offset: float, cut: float, hit: Hit, length: Unit) -> str:
    """Return where to aim, in a sentence.

    The offset is in meters to the right of the pocket's center; the cut is negative on the side
    opposite the hit's.
    """
    amount = length.text(abs(offset), 2)
    if length.is_nothing(offset, 2):
        return f"Aim at the middle of the pocket: throw is less than 0.01 {length.words} there."
    side = "right" if offset > 0.0 else "left"
    thinness = "a thinner cut" if side == hit.toward else "a fuller cut"
    if cut < 0.0:
        thinness = f"a cut to the {hit.away}"
    note = f" ({thinness})" if hit.cut else ""
    return (
        f"Aim {amount} to the {side} of the middle of the pocket{note}; throw brings it back in "
        "line."
    )


def throw_answer(hit: Hit, units: Units) -> Answer:
    """Return a hit's throw.

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
    """Return the effect of a throw, in degrees, on the shot.

    >>> throw_words(1.418, Hit(0.0, 1.0, 0.5, 0.0556, "limited"))
    'The object ball is thrown 1.42 degrees to the left.'
    """
    amount = degrees(abs(throw))
    if float(amount) == 0.0:
        return "There is no throw: the object ball leaves along the line of centers."
    if hit.cut == 0.0:
        side = hit.away if throw > 0.0 else hit.toward
        return f"The object ball is thrown {amount} degrees to the {side}."
    if throw > 0.0:
        return (
            f"Throw takes {amount} degrees off the cut: the object ball goes thick unless you "
            "aim thinner."
        )
    return (
        f"Throw adds {amount} degrees to the cut: the object ball goes thin unless you aim fuller."
    )


_AT_REST = 1e-12
"""The speed, relative to the cue ball's, below which a ball counts as stopped."""


def cue_ball_path_answer(hit: Hit, units: Units) -> Answer:
    """Return the cue ball's deflection: the angle by which its path turns.

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

    Deflections are in degrees, with and without friction between the balls; None: it stops dead.

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
    side = hit.away if angle > 0.0 else hit.toward
    return straight.get(amount, f"{go} {amount} degrees to the {side}")


def _deflection_with_friction(found: Collision) -> float | None:
    """Return the deflection in radians, negative toward the object ball's side."""
    rim_velocity = found.ball.radius * found.cue_spin
    ahead, left = map(float, roll_velocity(found.cue_velocity[:2], rim_velocity))
    if math.hypot(ahead, left) < _AT_REST * found.speed:
        return None
    return math.atan2(-left if found.cut < 0.0 else left, ahead)


def _departure(found: Collision) -> float | None:
    """Return the angle between the two paths in radians; None if a ball is stopped."""
    slowest = min(math.hypot(*ball[:2]) for ball in (found.object_velocity, found.cue_velocity))
    return None if slowest < _AT_REST * found.speed else float(found.departure)


def _object_share(energies: EnergyShares) -> float:
    return float(energies.object_ball / (energies.object_ball + energies.cue_ball))
