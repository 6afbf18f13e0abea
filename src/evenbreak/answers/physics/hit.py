"""A hit of the cue ball on an object ball, in words and quantities."""

import math
from typing import Any, NamedTuple

from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantity
from evenbreak.answers.kit.wording import decimals
from evenbreak.answers.physics.units import Unit
from evenbreak.physics.collision import Collision, collide
from evenbreak.physics.friction import SlipFriction
from evenbreak.physics.throw import gearing_side

degrees = decimals(2)
"""How an angle in degrees is shown."""


class Hit(NamedTuple):
    """A hit: angles in degrees, right above 0 and left below.

    Parameters
    ----------
    cut
        cut angle; the object ball goes to the right if it is above 0, to the left if below.
    topspin
        J_y: 1 is natural roll, 0 stun, below 0 draw.
    side
        J_z: right english above 0, left english below.
    mu
        coefficient of friction between the balls, or how it falls with the speed of the slip.
    friction
        the law of friction, one of `FRICTION_LAWS`.
    speed
        of the cue ball, in m/s; None if the friction does not depend on it.
    """

    cut: float
    topspin: float
    side: float
    mu: float | SlipFriction
    friction: str
    speed: float | None = None

    @property
    def hand(self) -> float:
        """The sign of the cut: 1.0 to the right and for a full hit, -1.0 to the left."""
        return -1.0 if self.cut < 0.0 else 1.0

    @property
    def cut_and_spin(self) -> tuple[float, float, float]:
        """The cut angle in radians, J_y and J_z.

        No decimal is sin(30 degrees) to the last bit, and the difference would leave a slip, to
        which the law of the source text gives its full throw.
        """
        angle = math.radians(self.cut)
        without_slip = float(gearing_side(angle))
        exact = abs(self.side - without_slip) < 1e-12
        return angle, self.topspin, without_slip if exact else self.side

    def collide(self, cut: float | None = None) -> Collision:
        """Return what the balls do, at another cut angle in radians if one is given."""
        angle, topspin, side = self.cut_and_spin
        angle, speed = angle if cut is None else cut, 1.0 if self.speed is None else self.speed
        return collide(angle, topspin, side, speed=speed, mu=self.mu, friction=self.friction)

    @property
    def towards(self) -> str:
        """The side to which the object ball is cut; a full hit counts as a cut to the right."""
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
        """What is hit and how, in a line.

        >>> Hit(30.0, 1.0, -0.3, 0.0556, "limited").description
        'A cut of 30 degrees to the right; natural roll, outside (left) english'
        """
        english = f"{self.english or 'no'} english"
        if self.english in ("inside", "outside"):
            english = f"{self.english} ({'right' if self.side > 0.0 else 'left'}) english"
        return f"{cut_words(self.cut)}; {spin_words(self.topspin)}, {english}"

    def asked(self, found: Collision, speed: Unit) -> list[Quantity]:
        """Return what was asked, which files hold before the answer.

        Parameters
        ----------
        found
            the hit, whose friction was used.
        speed
            the unit of speed.
        """
        values: dict[str, Any] = {
            "-cut_deg": self.cut,
            "topspin": self.topspin,
            "-side": self.side,
            "english": self.english,
            **friction_values(self.mu, found, self.friction),
        }
        return [*quantities_of(values), speed.quantity("-hit_speed", self.speed)]

    def heading(self, found: Collision, speed: Unit, *more: str) -> str:
        """Return what is hit and how, and what friction is assumed, in two lines."""
        pace = [] if self.speed is None else [f"cue ball at {speed.typed(self.speed)}"]
        shot = "; ".join([self.description, *pace, *more])
        return f"{shot}\n{friction_words(self.mu, found, self.friction)}"


def friction_values(mu: float | SlipFriction, found: Collision | None, law: str) -> dict[str, Any]:
    """Return the friction between the balls as files hold it: the coefficient of the hit."""
    by_speed = isinstance(mu, SlipFriction)
    known = None if found is None else float(found.mu)
    return {"mu": known if by_speed else mu, "mu_by_speed": by_speed, "friction": law}


def friction_words(mu: float | SlipFriction, found: Collision | None, law: str) -> str:
    """Return what is assumed about the friction between the balls.

    >>> friction_words(0.0556, None, "limited")
    'Friction between the balls: 0.0556, the same at any speed'
    >>> print(friction_words(SlipFriction(), collide(0.5, speed=4.0, mu=SlipFriction()), "limited"))
    Friction between the balls: 0.0113 at this speed, less in harder shots (Alciatore's fit)
    """
    if not isinstance(mu, SlipFriction):
        words = f"{mu:.3g}, the same at any speed"
    else:
        at_hit = "" if found is None else f"{found.mu:.3g} at this speed, "
        source = " (Alciatore's fit)" if mu == SlipFriction() else ""
        words = f"{at_hit}less in harder shots{source}"
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
    "Squirt and swerve are left out: with english the cue ball starts off the line of the cue, to "
    "the side away from the english, and with a raised cue it curves back. Allow for them so that "
    "the cue ball travels along the line given here; to find yours, shoot the length of the table "
    "with this english and see how far off it lands."
)
"""What an answer about where to aim does not know where there is english."""


def spin_words(topspin: float) -> str:
    """Return what players call a spin J_y.

    >>> spin_words(1.0), spin_words(0.0), spin_words(-0.5), spin_words(-1.0)
    ('natural roll', 'stun', 'draw (-0.50)', 'reverse natural roll')
    """
    named = {1.0: "natural roll", 0.0: "stun", -1.0: "reverse natural roll"}
    kind = "topspin" if topspin > 0.0 else "draw"
    return named.get(topspin) or f"{kind} ({degrees(topspin)})"
