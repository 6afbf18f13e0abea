"""The path of one ball, from its start until it stops, hits something or drops into a pocket.

It slides and then rolls, as described in `slide`; here, the path also has an end and a clock.

A pocket is a straight mouth between the noses of two cushions, across the corner or along the side,
which a ball either fits through or doesn't. A corner of the table is (0, 0); x runs along it from
the head cushion to the foot cushion, and y to the left of that. The source text has no pockets; the
mouths here are 4 1/2 inches at the corners and 5 inches at the sides, the tightest in common use.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import kind_of, whole
from evenbreak.errors import InputError
from evenbreak.physics.objects import PoolTable
from evenbreak.physics.rolling import Energy, kinetic_energy
from evenbreak.physics.slide import Slide
from evenbreak.physics.units import INCH, numbers

_SLACK = 1e-9
"""A nanometer: how far rounding may push a ball into a cushion along which it rolls."""

_INSTANT = 1e-12
"""Slides shorter than this, in seconds, are rounding errors: the ball rolls from the start."""


class State(NamedTuple):
    """State of a ball at a time in seconds: position in meters, velocity in m/s, spin in rad/s."""

    time: float
    position: Floats
    velocity: Floats
    spin: Floats

    @property
    def speed(self) -> float:
        """The speed, in m/s."""
        return math.hypot(*self.velocity)


class Phase(NamedTuple):
    """A part of a path in which the ball only slides, or only rolls.

    Parameters
    ----------
    ball
        'cue ball' or 'object ball'.
    motion
        'slides' or 'rolls'.
    begin, end
        the states at its two ends.
    length
        in meters.
    """

    ball: str
    motion: str
    begin: State
    end: State
    length: float


@dataclass(frozen=True, eq=False)
class Leg:
    """The path of one ball on the table.

    Parameters
    ----------
    name
        'cue ball' or 'object ball'.
    slide
        the ball's motion from the start of the path, as on an endless table.
    begin, end
        seconds on the shot's clock.
    ending
        'rest', 'hit' (the cue ball meets the object ball), 'cushion' or 'pocket'.
    pocket
        the name of the pocket, '' if there is none.
    """

    name: str
    slide: Slide
    begin: float
    end: float
    ending: str
    pocket: str = ""

    @property
    def roll_begin(self) -> float:
        """When natural roll starts, in seconds; the end if the ball only slides."""
        return min(self.begin + float(self.slide.slide_time), self.end)

    def state(self, time: float) -> State:
        """Return the ball at a time in the shot; beyond the path, its state at the nearer end."""
        now = min(max(time, self.begin), self.end)
        since = now - self.begin
        slide = self.slide
        return State(now, slide.at(since), slide.velocity_at(since), slide.spin_at(since))

    def energy(self, time: float) -> Energy:
        """Return the ball's kinetic energy at a time in the shot, in joules.

        Sidespin counts even after the ball has stopped, since in this model it does not wear off.
        """
        state = self.state(time)
        radius = self.slide.ball.radius
        rim = radius * float(np.linalg.norm(state.spin))
        return kinetic_energy(self.slide.ball, state.speed, rim)

    @property
    def phases(self) -> tuple[Phase, ...]:
        """The parts of the path in order, without those that take no time."""
        times = {"slides": (self.begin, self.roll_begin), "rolls": (self.roll_begin, self.end)}
        return tuple(
            Phase(self.name, motion, self.state(begin), self.state(end), self._length(begin, end))
            for motion, (begin, end) in times.items()
            if end - begin > _INSTANT
        )

    @property
    def length(self) -> float:
        """The length of the path, in meters."""
        return sum(phase.length for phase in self.phases)

    def path(self, points: int = 100, *, motion: str | None = None) -> Floats:
        """Return the path as rows of x, y (meters) and t (seconds).

        Parameters
        ----------
        points
            per phase, evenly spaced in time, 2 or more; a point shared by two phases appears once.
        motion
            'slides' or 'rolls' for that part alone; shape (0, 3) if there is none.

        Raises
        ------
        InputError
            if there are fewer than 2 points, or their number is not whole.
        """
        points = whole(points, "points", at_least=2)
        spans = [phase for phase in self.phases if motion in (None, phase.motion)]
        if not spans:
            still = np.array([[*self.slide.position, self.begin]])
            return still if motion is None else still[:0]
        times = np.unique(
            np.concatenate([np.linspace(span.begin.time, span.end.time, points) for span in spans])
        )
        return np.column_stack([self.slide.at(times - self.begin), times])

    def _length(self, begin: float, end: float) -> float:
        """Return the length of the path between two times: a line, or a piece of a parabola."""
        first, last = self.slide.velocity_at(begin - self.begin), self.state(end).velocity
        # The acceleration is constant, so the speed squared is a quadratic in time.
        change = last - first
        across = float(np.linalg.norm(change))
        if across == 0.0:
            return float(np.linalg.norm(first)) * (end - begin)
        axis = change / across
        low, high = float(first @ axis), float(last @ axis)
        beside = abs(float(first[0] * axis[1] - first[1] * axis[0]))
        return (_arc(high, beside) - _arc(low, beside)) * (end - begin) / across


def leg_until(
    name: str,
    slide: Slide,
    begin: float,
    table: PoolTable,
    *,
    hit: float = math.inf,
) -> Leg:
    """Return the path of a ball until it stops, or meets the first thing in its way.

    The ball starts inside the cushions; `hit` is the seconds after which it hits the other ball.
    """
    radius = slide.ball.radius
    walls = {
        (1.0, 0.0): table.length - radius,
        (-1.0, 0.0): -radius,
        (0.0, 1.0): table.width - radius,
        (0.0, -1.0): -radius,
    }
    cushion = min(time_to(slide, np.array(wall), at + _SLACK) for wall, at in walls.items())
    rest = float(slide.stop_time)
    # A ball that only just reaches the other has no speed left to hit it with.
    if hit <= cushion and hit < rest * (1.0 - 1e-9):
        return Leg(name, slide, begin, begin + hit, "hit")
    if rest <= cushion:
        return Leg(name, slide, begin, begin + rest, "rest")
    where = [*slide.at(cushion), *slide.velocity_at(cushion), radius]
    taken = (pocket.name for pocket in pockets(table) if pocket.takes(*where))
    pocket = next(taken, "")
    return Leg(name, slide, begin, begin + cushion, "pocket" if pocket else "cushion", pocket)


def time_to(slide: Slide, normal: Floats, level: float) -> float:
    """Return when a ball first crosses a line, in seconds; infinity if it never does.

    The ball starts on the near side of the line: the points whose product with `normal` is `level`,
    in meters.
    """
    start, rolls, rests = 0.0, float(slide.slide_time), float(slide.stop_time)
    for begin, end in ((start, rolls), (rolls, rests)):
        if end <= begin:
            continue
        first, last = slide.velocity_at(begin), slide.velocity_at(end)
        room = max(level - float(slide.at(begin) @ normal), 0.0)
        pace = float(first @ normal)
        gain = float((last - first) @ normal) / (end - begin)
        took = _first_time(room, pace, gain)
        if took <= end - begin:
            return begin + took
    return math.inf


def place_of(value: Sequence[float], name: str) -> Floats:
    """Return a position on the table as an array, if it is one x and one y."""
    place = numbers(value, name)
    if place.shape != (2,):
        raise InputError(
            "{name} must have x and y; its shape is {place_shape}",
            name=name,
            place_shape=place.shape,
        )
    return place


def on_table(position: Floats, name: str, table: PoolTable, radius: float) -> None:
    """Raise an error if a ball is off the table or overlaps a cushion."""
    x, y = (float(value) for value in position)
    inside = radius - _SLACK <= x <= table.length - radius + _SLACK
    if not (inside and radius - _SLACK <= y <= table.width - radius + _SLACK):
        raise InputError(
            "{name} is at ({x:.4g}, {y:.4g}) m. Give a place at least {radius:.4g} m from each "
            "edge of the {length:.4g} by {width:.4g} m table.",
            name=name,
            x=x,
            y=y,
            radius=radius,
            length=table.length,
            width=table.width,
        )


def _first_time(room: float, pace: float, gain: float) -> float:
    """Return the first time at which pace t + gain t^2 / 2 exceeds room, in seconds."""
    square = pace * pace + 2.0 * gain * room
    if square < 0.0 or (pace <= 0.0 and gain <= 0.0):
        return math.inf
    root = math.sqrt(square)
    # Of the two forms of the root, the one without a difference, which would lose digits.
    return 2.0 * room / (pace + root) if pace > 0.0 else (root - pace) / gain


def _arc(along: float, beside: float) -> float:
    """Return the integral of sqrt(v^2 + beside^2) over v from 0 to `along`."""
    if beside < 1e-100:  # along / beside may overflow
        return 0.5 * along * abs(along)
    return 0.5 * (along * math.hypot(along, beside) + beside**2 * math.asinh(along / beside))


CORNER_MOUTH = 4.5 * INCH
"""Between the noses at a corner, in meters."""

SIDE_MOUTH = 5.0 * INCH
"""Between the noses at a side pocket, in meters."""

POCKET_NAMES = ("head-right", "side-right", "foot-right", "foot-left", "side-left", "head-left")
"""The pockets, counterclockwise from the corner (0, 0)."""


class Pocket(NamedTuple):
    """A pocket: where its mouth is, the direction into it, and its width.

    Parameters
    ----------
    name
        one of `POCKET_NAMES`.
    x, y
        the middle of the mouth, in meters.
    into_x, into_y
        the unit vector straight into it.
    mouth
        its width between the noses of the cushions, in meters.
    """

    name: str
    x: float
    y: float
    into_x: float
    into_y: float
    mouth: float

    def takes(self, x: float, y: float, along_x: float, along_y: float, radius: float) -> bool:
        """Return whether a ball that goes straight on from (x, y) fits through the mouth.

        Parameters
        ----------
        x, y
            the ball's center in meters, no farther away than the mouth is wide.
        along_x, along_y
            its direction, a vector of any length.
        radius
            of the ball, in meters.

        >>> pocket = pockets(PoolTable())[1]
        >>> pocket.takes(pocket.x, 0.03, 0.0, -1.0, 0.0286)
        True
        >>> pocket.takes(pocket.x, 0.03, 1.0, -0.3, 0.0286)
        False
        """
        length = math.hypot(along_x, along_y)
        near = math.hypot(self.x - x, self.y - y) <= self.mouth
        if not near or length == 0.0:
            return False
        beside = abs((self.x - x) * along_y - (self.y - y) * along_x) / length
        return beside <= 0.5 * self.width_from(along_x, along_y) - radius + 1e-9

    def width_from(self, along_x: float, along_y: float) -> float:
        """Return the width of the mouth for a ball coming in this direction, in meters.

        At an angle it is as narrow as it looks from there; from behind it is below 0.

        >>> pocket = pockets(PoolTable())[1]
        >>> pocket.width_from(0.0, -2.0) == pocket.mouth, pocket.width_from(1.0, 0.0)
        (True, 0.0)
        """
        facing = along_x * self.into_x + along_y * self.into_y
        return self.mouth * facing / math.hypot(along_x, along_y)


def pockets(table: PoolTable) -> tuple[Pocket, ...]:
    """Return the six pockets of a table, in the order of `POCKET_NAMES`.

    Parameters
    ----------
    table
        its length and width in meters.

    >>> [pocket.name for pocket in pockets(PoolTable())][2]
    'foot-right'
    """
    kind_of(table, "table", PoolTable)
    slant = math.sqrt(0.5)
    inset = 0.5 * slant * CORNER_MOUTH
    far, across, middle = table.length - inset, table.width - inset, 0.5 * table.length
    places = (
        (inset, inset, -slant, -slant, CORNER_MOUTH),
        (middle, 0.0, 0.0, -1.0, SIDE_MOUTH),
        (far, inset, slant, -slant, CORNER_MOUTH),
        (far, across, slant, slant, CORNER_MOUTH),
        (middle, table.width, 0.0, 1.0, SIDE_MOUTH),
        (inset, across, -slant, slant, CORNER_MOUTH),
    )
    return tuple(Pocket(name, *place) for name, place in zip(POCKET_NAMES, places, strict=True))
