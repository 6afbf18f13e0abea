"""The units in which lengths, speeds and weights are typed and shown: inches or centimetres."""

import math
from typing import Any, NamedTuple

from evenbreak.answers.kit.columns import quantities_of, quantity_of
from evenbreak.answers.kit.parts import Quantity
from evenbreak.answers.kit.wording import decimals
from evenbreak.physics.collision import Collision, collide
from evenbreak.physics.friction import SlipFriction
from evenbreak.physics.throw import gearing_side
from evenbreak.physics.units import CENTIMETRE, GRAM, INCH, OUNCE


class Unit(NamedTuple):
    """A unit of length, speed or mass.

    Parameters
    ----------
    size
        one of it in SI units: metres, metres per second or kilograms.
    key
        the ending of the names of quantities in this unit.
    words
        its name in the plural.
    """

    size: float
    key: str
    words: str

    def text(self, value: float, places: int = 1) -> str:
        """Return a value, given in SI units, in this unit.

        >>> IMPERIAL.length.text(1.0)
        '39.4 inches'
        """
        return f"{decimals(places)(value / self.size)} {self.words}"

    def typed(self, value: float) -> str:
        """Return a value, given in SI units, as it was typed in this unit.

        >>> IMPERIAL.length.typed(0.9144)
        '36 inches'
        """
        return f"{value / self.size:.6g} {self.words}"

    def quantity(self, key: str, value: float | None) -> Quantity:
        """Return a value, given in SI units, as a quantity in this unit.

        >>> quantity = METRIC.speed.quantity("ball_speed", 1.5)
        >>> quantity.name, quantity.value, quantity.words
        ('ball_speed_m_s', 1.5, 'speed of the ball, metres per second')
        """
        number = None if value is None else float(value) / self.size
        return quantity_of(key, number, unit=self.key, units=self.words)


class Units(NamedTuple):
    """The units of a command: of lengths, speeds and masses."""

    length: Unit
    speed: Unit
    mass: Unit


IMPERIAL = Units(
    Unit(INCH, "in", "inches"),
    Unit(INCH, "in_s", "inches per second"),
    Unit(OUNCE, "oz", "ounces"),
)
"""Inches, inches per second and ounces."""

METRIC = Units(
    Unit(CENTIMETRE, "cm", "centimetres"),
    Unit(1.0, "m_s", "metres per second"),
    Unit(GRAM, "g", "grams"),
)
"""Centimetres, metres per second and grams."""

_TYPICAL = {
    "stick": ((10.0, 30.0), (280.0, 850.0)),
    "ball": ((3.0, 10.0), (85.0, 285.0)),
    "forearm": ((10.0, 320.0), (280.0, 9000.0)),
    "speed": ((0.0, 600.0), (0.0, 15.0)),
    "stick_speed": ((0.0, 600.0), (0.0, 15.0)),
}
"""The typical values of an option, from the least to the most, in imperial and metric units."""


def unit_doubts(units: Units, **typed: float | None) -> list[str]:
    """Return a warning for each option whose value looks as if it is in other units.

    >>> unit_doubts(IMPERIAL, stick=19.0, ball=None, stick_speed=60.0)
    []
    >>> unit_doubts(IMPERIAL, ball=170.0)
    ['--ball 170 ounces is unusual (3 to 10 is typical); for grams add --metric']
    """
    doubts = []
    metric = units is METRIC
    for name, value in typed.items():
        low, high = _TYPICAL[name][metric]
        if value is None or low <= value <= high:
            continue
        kind = "speed" if name.endswith("speed") else "mass"
        other = getattr(IMPERIAL if metric else METRIC, kind).words
        remedy = f"for {other} {'leave out' if metric else 'add'} --metric"
        doubts.append(
            f"--{name.replace('_', '-')} {value:g} {getattr(units, kind).words} is unusual "
            f"({low:g} to {high:g} is typical); {remedy}"
        )
    return doubts


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
