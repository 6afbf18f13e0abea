"""A hit of cue ball on object ball, in the words of players."""

import math
from typing import Any, NamedTuple

from evenbreak.answers.wording import decimals
from evenbreak.physics.collision import Collision, collide
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
        coefficient of friction between the balls.
    friction
        the law of friction, one of `FRICTION_LAWS`.
    """

    cut: float
    topspin: float
    side: float
    mu: float
    friction: str

    @property
    def mirror(self) -> float:
        """The sign of the cut: -1.0 for one to the left, which is the mirror image."""
        return -1.0 if self.cut < 0.0 else 1.0

    @property
    def in_frame(self) -> tuple[float, float, float]:
        """The hit as a cut to the right: its angle in radians, J_y and J_z.

        No decimal is sin(30 degrees) to the last bit, and the difference would leave a slip, to
        which the law of the source text gives its full throw.
        """
        angle = math.radians(abs(self.cut))
        side, without_slip = self.mirror * self.side, float(gearing_side(angle))
        return angle, self.topspin, without_slip if abs(side - without_slip) < 1e-12 else side

    def collide(self) -> Collision:
        """Return what the balls do, as for a cut to the right."""
        return collide(*self.in_frame, mu=self.mu, friction=self.friction)

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

    @property
    def asked(self) -> dict[str, Any]:
        """What was asked, which files hold before the answer."""
        return {
            "cut_deg": self.cut,
            "topspin": self.topspin,
            "side": self.side,
            "english": self.english,
            "mu": self.mu,
            "friction": self.friction,
        }


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


def spin_words(topspin: float) -> str:
    """Return what players call a spin J_y.

    >>> spin_words(1.0), spin_words(0.0), spin_words(-0.5), spin_words(-1.0)
    ('natural roll', 'stun', 'draw (-0.50)', 'reverse natural roll')
    """
    named = {1.0: "natural roll", 0.0: "stun", -1.0: "reverse natural roll"}
    kind = "topspin" if topspin > 0.0 else "draw"
    return named.get(topspin) or f"{kind} ({degrees(topspin)})"
