"""How a cue ball hits an object ball: the options that say so, and the words for it."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import click

from evenbreak.cli.kit.callbacks import Command
from evenbreak.cli.physics.units import Measure, decimals

MOST_SPIN = 100.0
"""The largest spin J that an option takes; what a cue gives is seldom beyond 2."""

MOST_CUT = 90.0


class Hit(NamedTuple):
    """A hit as it was typed: angles in degrees, right above 0 and left below.

    Parameters
    ----------
    cut
        cut angle: above 0 the object ball goes to the right, below 0 to the left.
    topspin
        J_y: 1 in natural roll, 0 for stun, below 0 for draw.
    side
        J_z: above 0 for right english, below 0 for left english.
    mu, friction
        of the two balls, and the law of it.
    """

    cut: float
    topspin: float
    side: float
    mu: float
    friction: str

    @property
    def angle(self) -> float:
        """The cut angle without its side, in radians."""
        return math.radians(abs(self.cut))

    @property
    def side_in_frame(self) -> float:
        """J_z of this hit, or of its mirror image where the cut is to the left.

        No decimal is sin(30 degrees) to the last bit, and what is left over would be a slip, to
        which the law of the text gives its full throw.
        """
        from evenbreak.physics import gearing_side

        side = -self.side if self.cut < 0.0 else self.side
        without_slip = float(gearing_side(self.angle))
        return without_slip if abs(side - without_slip) < 1e-12 else side

    @property
    def turn(self) -> str:
        """To which side the object ball is cut; a full hit counts as a cut to the right."""
        return "left" if self.cut < 0.0 else "right"

    @property
    def other_turn(self) -> str:
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
    def text(self) -> str:
        """What is hit how, in a sentence.

        >>> Hit(30.0, 1.0, -0.3, 0.0556, "limited").text
        'A cut of 30 degrees to the right; natural roll, outside (left) english.'
        """
        size = abs(self.cut)
        degrees = f"{size:g} degree{'' if size == 1.0 else 's'}"
        cut = f"A cut of {degrees} to the {self.turn}" if self.cut else "A full hit"
        return f"{cut}; {spin_text(self.topspin)}, {self._english_text}."

    @property
    def _english_text(self) -> str:
        if self.english is None:
            return "no english"
        hand = "right" if self.side > 0.0 else "left"
        return f"{self.english} english" if self.cut == 0.0 else f"{self.english} ({hand}) english"

    def as_answer(self) -> dict[str, Any]:
        """Return what was asked, as the first quantities of an answer."""
        return {
            "cut_deg": self.cut,
            "topspin": self.topspin,
            "side": self.side,
            "english": self.english,
            "mu": self.mu,
            "friction": self.friction,
        }


def spin_text(topspin: float) -> str:
    """Return what players call a spin J_y.

    >>> spin_text(1.0), spin_text(0.0), spin_text(-0.5), spin_text(-1.0)
    ('natural roll', 'stun', 'draw (-0.50)', 'reverse natural roll')
    """
    named = {1.0: "natural roll", 0.0: "stun", -1.0: "reverse natural roll"}
    if topspin in named:
        return named[topspin]
    return f"{'topspin' if topspin > 0.0 else 'draw'} ({decimals(topspin)})"


def hit_options(command: Command) -> Command:
    """Add the options --cut, --topspin, --side, --mu and --friction."""
    for option in (
        click.option(
            "--friction",
            type=click.Choice(["limited", "shepard"]),
            default="limited",
            show_default=True,
            help="Let friction end when the slip does, or be the law of the source text.",
        ),
        click.option(
            "--mu",
            metavar="MU",
            type=Measure(0.0, 1.0, "0.0556"),
            default=4.0 / 72.0,
            help="Friction between the two balls.  [default: 4/72 = 0.0556]",
        ),
        click.option(
            "--side",
            metavar="J",
            type=Measure(-MOST_SPIN, MOST_SPIN, "-0.3"),
            default=0.0,
            show_default=True,
            help="Sidespin: right english above 0, left below; outside on a cut to the other side.",
        ),
        click.option(
            "--topspin",
            metavar="J",
            type=Measure(-MOST_SPIN, MOST_SPIN, "1"),
            default=1.0,
            show_default=True,
            help="1 is natural roll, 0 stun, below 0 draw.",
        ),
        click.option(
            "--cut",
            metavar="DEGREES",
            type=Measure(-MOST_CUT, MOST_CUT, "30"),
            required=True,
            help="Cut angle, 0 to 90, the limit of thin cuts; below 0 to the left.",
        ),
    ):
        command = option(command)
    return command
