"""Questions about ball, cloth and cue."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, Flag, Named, Number, Text
from evenbreak.fields.question import Field, Question, Says
from evenbreak.questions.common import PlotFile
from evenbreak.questions.english import english_in, english_words
from evenbreak.words import Parameter

LENGTH = Number(0.01, 1e5, example="36", metavar="LENGTH")
SPEED = Number(0.01, 1e5, example="60", metavar="SPEED")
WEIGHT = Number(0.01, 1e5, example="6", metavar="WEIGHT")
SPIN = Number(-100.0, 100.0, example="0.3", metavar="J")
OFFSET = Number(-1.0, 1.0, example="0.4", metavar="B")
PACE = Number(0.0, 1e4, example="80", metavar="SPEED")

_EQUIPMENT = "Cue, ball and cloth"

Weight: TypeAlias = Annotated[float | None, Field(WEIGHT)]
BallWeight: TypeAlias = Annotated[
    float | None, Field(WEIGHT, "Weight of a ball.", usual="6 ounces", section=_EQUIPMENT)
]


def friction(text: str) -> Any:
    """Return a coefficient of friction, or the friction that falls with the speed of the slip.

    >>> friction("0.06"), type(friction("by-speed")).__name__
    (0.06, 'SlipFriction')
    """
    if text.strip().lower() == "by-speed":
        from evenbreak.physics import SlipFriction

        return SlipFriction()
    return Number(0.0, 1.0, example="0.06, or by-speed").read(text)


def squirt_in(text: str) -> float:
    """Return the degrees of squirt at most english.

    >>> squirt_in("low"), squirt_in("2.1")
    (1.8, 2.1)
    """
    from evenbreak.physics import SQUIRTS

    if text.strip().lower() in SQUIRTS:
        return SQUIRTS[text.strip().lower()]
    return Number(
        0.0, 10.0, " isn't a launch angle. Give regular, low, or degrees such as 2.1"
    ).read(text)


def place(text: str) -> tuple[float, float]:
    """Return a place on the table.

    >>> place("25,16")
    (25.0, 16.0)
    """
    parts = text.replace(";", ",").split(",")
    try:
        x, y = (Number(-math.inf, math.inf).read(part) for part in parts)
    except (InputError, ValueError):
        raise InputError(
            f"{text!r} isn't a place on the table. Give two numbers, such as 25,16: the "
            "distance from the head cushion, and from the right cushion."
        ) from None
    return x, y


@dataclass(frozen=True, kw_only=True)
class Units(Question):
    """Units for input and output."""

    metric: Annotated[
        bool, Field(Flag(), "Read and print centimeters, grams and meters per second.")
    ] = False


@dataclass(frozen=True, kw_only=True)
class BallFriction(Question):
    """The friction between the two balls."""

    mu: Annotated[
        Any,
        Field(
            Named(friction, "MU", number=True),
            "Friction between the two balls: a number for any speed, or by-speed.",
            usual="4/72 = 0.0556",
            more="[How to measure it](../../how-to/shots.md#allow-for-throw). `by-speed` is [the "
            "fit to measurements](../../explanation/table-side.md#friction-that-falls-with-speed).",
        ),
    ] = None
    friction: Annotated[
        str,
        Field(
            Choice(("limited", "shepard")),
            "limited: throw stops growing when the balls no longer slip; shepard: the source "
            "text's rule, without that limit.",
        ),
    ] = "limited"


@dataclass(frozen=True, kw_only=True)
class Hit(Units, BallFriction):
    """How tip, cue ball and object ball meet."""

    cut: Annotated[
        float,
        Field(
            Number(-90.0, 90.0, example="30", metavar="DEGREES"),
            "Cut angle; negative for a cut to the left. 90 is the limit for thin cuts.",
        ),
    ]
    topspin: Annotated[
        float, Field(SPIN, "Topspin: 1 is natural roll, 0 is stun, and a negative number is draw.")
    ] = 1.0
    english: Annotated[
        tuple[float, str] | None,
        Field(
            Named(english_in, "ENGLISH", spelled=english_words),
            'Sidespin in players\' words, such as "1 tip outside", "1/2 tip left" or "50% right".',
            more="1.4 tips are 100%; with more, the tip usually slips.",
        ),
    ] = None
    side: Annotated[
        float,
        Field(SPIN, "Sidespin as J: positive for right english, negative for left; 1.25 is 100%."),
    ] = 0.0
    speed: Annotated[
        float | None,
        Field(
            SPEED, "Cue ball speed at the hit; friction then falls as speed rises ({mu} by-speed)."
        ),
    ] = None

    def check(self) -> None:
        """Refuse a speed that changes nothing, a friction that needs one, and two englishes."""
        if self.english is not None and self.side:
            self.refuse("{english} and {side} can't be used together. Leave one out.")
        if self.english is not None and not self.cut and self.english[1].endswith("side"):
            self.refuse(
                "a full hit has no inside and outside. Say whether {english} is left or right."
            )
        by_speed = self.mu is not None and not isinstance(self.mu, float)
        if by_speed and self.speed is None:
            self.refuse(
                "{mu} by-speed needs the speed of the cue ball at the hit. Give {speed} too."
            )
        if isinstance(self.mu, float) and self.speed is not None:
            self.refuse(
                "{speed} {pace:g} changes nothing with {mu} {fixed:g}, which holds at "
                "any speed. Leave one of them out.",
                pace=self.speed,
                fixed=self.mu,
            )

    @property
    def sidespin(self) -> float:
        """J_z; positive for right english."""
        if self.english is None:
            return self.side
        size, way = self.english
        inside = math.copysign(size, self.cut)
        return {"right": size, "left": -size, "inside": inside, "outside": -inside}[way]


@dataclass(frozen=True, kw_only=True)
class Equipment(Question):
    """The cue, the balls and the cloth."""

    stick: Annotated[Weight, Says("Weight of the cue.", usual="18 ounces", section=_EQUIPMENT)] = (
        None
    )
    ball: BallWeight = None
    cloth_mu: Annotated[
        float,
        Field(
            Number(0.01, 1.0, example="0.2", metavar="MU"),
            "Sliding friction between ball and cloth.",
            section=_EQUIPMENT,
        ),
    ] = 0.2
    tip_mu: Annotated[
        float,
        Field(
            Number(0.01, 10.0, example="0.6", metavar="MU"),
            "Static friction between tip and ball.",
            usual="0.577, which means a miscue beyond half the radius",
            section=_EQUIPMENT,
        ),
    ] = 1.0 / math.sqrt(3.0)


SideOffset: TypeAlias = Annotated[
    float, Field(OFFSET, "How far right of center the tip hits; negative for left.")
]
Offset: TypeAlias = Annotated[
    float, Field(OFFSET, "How far above center the tip hits, in ball radii; negative for draw.")
]


@dataclass(frozen=True, kw_only=True)
class TableSpeed(Units):
    """Find how fast a table is from the time of a lag.

    Roll a ball off the foot cushion so that it just reaches the head cushion, time it from
    cushion to cushion, and average a few tries. A table speed of 80 to 100 is normal.
    """

    examples = """\
  evenbreak physics speed --lag-time 7.0
  evenbreak physics speed --lag-time 6.2 --table-length 88
  evenbreak physics speed --lag-time 7.0 --table-length 254 --metric
"""
    lag_time: Annotated[
        float,
        Field(
            Number(0.1, 1000.0, example="7.0", metavar="SECONDS"),
            "Seconds from when the ball leaves the foot cushion until it stops at the head "
            "cushion.",
        ),
    ]
    table_length: Annotated[
        float | None,
        Field(
            LENGTH,
            "Length between the noses of the end cushions.",
            usual="100 inches, for a nine-foot table",
        ),
    ] = None
    ball_diameter: Annotated[
        float | None, Field(LENGTH, "Diameter of the ball.", usual="2.25 inches")
    ] = None


@dataclass(frozen=True, kw_only=True)
class Throw(Hit):
    """Find how far friction throws the object ball off the line of centers.

    Positive throw is forward: it makes the cut fuller, and the ball misses thick. Hard shots are
    thrown less than soft ones: give {speed} to allow for that. Without it, friction is {mu} at any
    speed.
    """

    examples = """\
  evenbreak physics throw --cut 30
  evenbreak physics throw --cut 30 --topspin 1 --side -0.3 --mu 0.0556
  evenbreak physics throw --cut 30 --topspin 0 --speed 150
"""


@dataclass(frozen=True, kw_only=True)
class Aim(Hit):
    """Find where to aim so that the thrown object ball goes in.

    {cut} is the angle at which the object ball has to leave. The answer is a point beside the
    middle of the pocket: aim at it as if there were no throw. For a cue ball that rolls without
    english, the rule of thumb is friction x distance x sine of the cut angle. Hard shots are thrown
    less than soft ones: give {speed} to allow for that.
    """

    examples = """\
  evenbreak physics aim --cut 14.5 --distance 36
  evenbreak physics aim --cut 30 --distance 36 --topspin 0 --speed 60
  evenbreak physics aim --cut 30 --distance 36 --english "1 tip outside"
"""
    distance: Annotated[float, Field(LENGTH, "Distance from the object ball to the pocket.")]
    squirt: Annotated[
        float,
        Field(
            Named(squirt_in, "SHAFT", spelled=lambda most: f"{most:g}", number=True),
            "Squirt: regular for a regular shaft, low for a low-deflection shaft, or degrees at "
            "100% english.",
            more="`regular` is 2.5 degrees, `low` 1.8; `0` leaves squirt out.",
        ),
    ] = 2.5


@dataclass(frozen=True, kw_only=True)
class Deflect(Hit):
    """Find where the cue ball goes after the hit.

    The deflection is the angle between the direction of the shot and the cue ball's path
    once it rolls: 0 to 180 degrees, away from the object ball. {side}, {speed}, {mu} and
    {friction} change only the angles that allow for friction between the balls.
    """

    examples = """\
  evenbreak physics deflect --cut 30
  evenbreak physics deflect --cut 40 --topspin -1
  evenbreak physics deflect --cut -30 --topspin 0 --mu 0.08
"""


@dataclass(frozen=True, kw_only=True)
class Strike(Units, Equipment):
    """Find the spin and speed from an off-center hit, and whether it is a miscue.

    Offsets are in ball radii: a hit 0.4 above the center gives natural roll at once.
    """

    examples = """\
  evenbreak physics strike --offset 0.4
  evenbreak physics strike --offset -0.3 --side-offset 0.1 --stick 19 --stick-speed 60
  evenbreak physics strike --offset -0.3 --stick-speed 60 --distance 24
"""
    offset: Offset
    side_offset: SideOffset = 0.0
    stick_speed: Annotated[
        float | None,
        Field(SPEED, "Speed of the cue just before the hit; needed for speeds and distances."),
    ] = None
    distance: Annotated[
        float | None,
        Field(
            Number(0.0, 1e5, example="24", metavar="LENGTH"),
            "Also show the spin that is left after this distance; needs {stick_speed}.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a distance without a speed, and a tip that misses the ball."""
        if self.distance is not None and self.stick_speed is None:
            self.refuse(
                "{distance} {far:g} needs the cue's speed. Give {stick_speed}.",
                far=self.distance,
            )
        if self.off_center >= 1.0:
            self.refuse(
                "{offset} {up:g} with {side_offset} {right:g} misses the ball: {off:.3g} radii "
                "from the center; together they must be less than 1",
                up=self.offset,
                right=self.side_offset,
                off=self.off_center,
            )

    @property
    def off_center(self) -> float:
        """How far from the center the tip hits, in ball radii."""
        return math.hypot(self.offset, self.side_offset)


@dataclass(frozen=True, kw_only=True)
class BreakCue(Units):
    """Find the cue weight that breaks best.

    The best cue passes the largest share of the stroke's energy (the energy of arm and cue
    together) on to the cue ball. The forearm is treated as a uniform rod swinging from the elbow.
    """

    examples = """\
  evenbreak physics breakcue --forearm 36
  evenbreak physics breakcue --forearm 36 --stick 19
  evenbreak physics breakcue --forearm 1020 --ball 165 --metric
"""
    forearm: Annotated[
        float,
        Field(
            Number(0.0, 1e6, example="36", metavar="WEIGHT"),
            "Weight of your forearm and hand, or of your whole arm if you break from the shoulder.",
        ),
    ]
    ball: BallWeight = None
    stick: Annotated[Weight, Says("Compare with a cue of this weight.")] = None


@dataclass(frozen=True, kw_only=True)
class Shot(Units, BallFriction, Equipment):
    """Trace a shot: where both balls go, and where they stop.

    Place the object ball with {cut} and {distance} (the shot then goes along the middle of the
    table). Or give {cue_ball}, {object_ball} and {pocket}, and the shot is aimed at that pocket. A
    ball is followed up to its first cushion.
    """

    examples = """\
  evenbreak physics shot --cut 30 --distance 24 --speed 80 --offset -0.3
  evenbreak physics shot --cut -45 --distance 20 --speed 50 --plot shot.svg
  evenbreak physics shot --cue-ball 25,16 --object-ball 50,25 --pocket foot-left --speed 60
"""
    cut: Annotated[
        float | None,
        Field(
            Number(-89.0, 89.0, example="30", metavar="DEGREES"),
            "Cut angle; negative for a cut to the left.",
        ),
    ] = None
    distance: Annotated[
        float | None, Field(LENGTH, "Distance between the centers of the two balls.")
    ] = None
    cue_ball: Annotated[
        tuple[float, float] | None,
        Field(
            Named(place, "X,Y"),
            "Position of the cue ball: X from the head cushion, Y from the right one.",
            usual="25,25 inches",
        ),
    ] = None
    object_ball: Annotated[
        tuple[float, float] | None,
        Field(Named(place, "X,Y"), "The object ball's position, instead of {cut}."),
    ] = None
    pocket: Annotated[
        str | None,
        Field(
            Text("NAME"),
            "Aim there, allowing for throw: head-, side- or foot-, then left or right.",
        ),
    ] = None
    speed: Annotated[float | None, Field(PACE, "Speed of the cue ball just after the tip.")] = None
    stick_speed: Annotated[float | None, Field(PACE, "Speed of the cue, instead of {speed}.")] = (
        None
    )
    offset: Offset = 0.0
    side_offset: SideOffset = 0.0
    table_speed: Annotated[
        float,
        Field(
            Number(5.0, 1000.0, example="100", metavar="NUMBER"),
            "How fast the table is, as found by `physics speed`.",
            section="Table",
        ),
    ] = 100.0
    table_length: Annotated[
        float | None,
        Field(
            Number(20.0, 1e4, example="88", metavar="LENGTH"),
            "Length between the end cushions; the width is half of it.",
            usual="100 inches",
            section="Table",
        ),
    ] = None
    plot: PlotFile = None

    def check(self) -> None:
        """Refuse balls or speeds that are given twice, or not at all."""
        angles, places = (
            [name for name in names if getattr(self, name) is not None]
            for names in (("cut", "distance"), ("object_ball", "pocket"))
        )
        if angles and places:
            self.refuse(
                "{angle} and {where} both place the balls. Use either {cut} and "
                "{distance}, or {cue_ball}, {object_ball} and {pocket}.",
                angle=Parameter(angles[0]),
                where=Parameter(places[-1]),
            )
        if len(angles or places) != 2:
            self.refuse(
                "missing positions: give {cut} and {distance}, or {cue_ball}, "
                "{object_ball} and {pocket}"
            )
        if (self.speed is None) == (self.stick_speed is None):
            self.refuse(
                "give either {speed}, the cue ball's speed, or {stick_speed}, the cue's speed"
            )
