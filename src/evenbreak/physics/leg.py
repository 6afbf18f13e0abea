"""One ball's way, from when it is set in motion until it rests, hits something or falls.

It slides and then rolls, as `slide` has it; here the way has an end and a clock.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.physics.arrays import Floats, numbers
from evenbreak.physics.objects import PoolTable
from evenbreak.physics.pockets import pockets
from evenbreak.physics.rolling import Energy, kinetic_energy
from evenbreak.physics.slide import Slide

ENDINGS = ("rest", "hit", "cushion", "pocket")
"""How a leg can end."""

_SLACK = 1e-9
"""A nanometre: what rounding may push a ball into the cushion that it rolls along."""

_INSTANT = 1e-12
"""What rounding may let a ball slide that is struck into natural roll, in seconds."""


class State(NamedTuple):
    """A ball at a time: seconds, metres (2), m/s (2), rad/s (3)."""

    time: float
    position: Floats
    velocity: Floats
    spin: Floats

    @property
    def speed(self) -> float:
        """The speed in m/s."""
        return math.hypot(*self.velocity)


class Phase(NamedTuple):
    """A ball that slides, or rolls, from one state to another.

    Parameters
    ----------
    ball
        'cue ball' or 'object ball'.
    motion
        'slides' or 'rolls'.
    begin, end
        the states at its two ends.
    length
        of the way, in metres.
    """

    ball: str
    motion: str
    begin: State
    end: State
    length: float


@dataclass(frozen=True, eq=False)
class Leg:
    """The way of one ball on the table.

    Parameters
    ----------
    name
        'cue ball' or 'object ball'.
    slide
        the ball from its first moment on, had it room for ever.
    begin, end
        seconds on the clock of the shot.
    ending
        'rest', 'hit' (the cue ball meets the object ball), 'cushion' or 'pocket'.
    pocket
        which pocket, '' where it is none.
    """

    name: str
    slide: Slide
    begin: float
    end: float
    ending: str
    pocket: str = ""

    @property
    def roll_begin(self) -> float:
        """When natural roll begins; the end, where it slides until then."""
        return min(self.begin + float(self.slide.slide_time), self.end)

    def state(self, time: float) -> State:
        """Return the ball at a time of the shot; before and after, as at its ends."""
        now = min(max(time, self.begin), self.end)
        since = now - self.begin
        slide = self.slide
        return State(now, slide.at(since), slide.velocity_at(since), slide.spin_at(since))

    def energy(self, time: float) -> Energy:
        """Return the ball's kinetic energy at a time of the shot, in joules.

        Sidespin counts, and stays even when the ball rests, as nothing here wears it off.
        """
        state = self.state(time)
        radius = self.slide.ball.radius
        rim = radius * float(np.linalg.norm(state.spin))
        return kinetic_energy(self.slide.ball, state.speed, rim)

    @property
    def phases(self) -> tuple[Phase, ...]:
        """What the ball does one after the other; nothing that takes no time."""
        times = {"slides": (self.begin, self.roll_begin), "rolls": (self.roll_begin, self.end)}
        return tuple(
            Phase(self.name, motion, self.state(begin), self.state(end), self._length(begin, end))
            for motion, (begin, end) in times.items()
            if end - begin > _INSTANT
        )

    @property
    def length(self) -> float:
        """The length of the whole way, in metres."""
        return sum(phase.length for phase in self.phases)

    def path(self, points: int = 100, *, motion: str | None = None) -> Floats:
        """Return the way as rows of x, y (metres) and t (seconds).

        Parameters
        ----------
        points
            how many for each of its phases, at even times, 2 or more; where two phases meet,
            the point stands once.
        motion
            'slides' or 'rolls' for that part alone; shape (0, 3) where there is none.

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
        """Return the length of the way between two times: a line, or a piece of a parabola."""
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
    """Return the way of a ball until it rests, or meets what is first in its way.

    Parameters
    ----------
    name, slide, begin
        as `Leg` takes them; the ball begins inside the cushions.
    table
        whose cushions and pockets end the way.
    hit
        the seconds after which it hits the other ball.
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
    # A ball that would only just touch the other has no speed left to hit it with.
    if hit <= cushion and hit < rest * (1.0 - 1e-9):
        return Leg(name, slide, begin, begin + hit, "hit")
    if rest <= cushion:
        return Leg(name, slide, begin, begin + rest, "rest")
    where = [*slide.at(cushion), *slide.velocity_at(cushion), radius]
    taken = (pocket.name for pocket in pockets(table) if pocket.takes(*where))
    pocket = next(taken, "")
    return Leg(name, slide, begin, begin + cushion, "pocket" if pocket else "cushion", pocket)


def time_to(slide: Slide, normal: Floats, level: float) -> float:
    """Return when a ball first goes past a line, from the near side; infinity where never.

    Parameters
    ----------
    slide
        one ball.
    normal, level
        the line of the points whose product with `normal` is `level`, in metres.
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
    """Return a place on the table as an array of x and y, or refuse it."""
    place = numbers(value, name)
    if place.shape != (2,):
        raise InputError(f"{name} has shape {place.shape}; give x and y")
    return place


def on_table(position: Floats, name: str, table: PoolTable, radius: float) -> None:
    """Refuse a ball that is not on the table, or is partly in a cushion."""
    x, y = (float(value) for value in position)
    inside = radius - _SLACK <= x <= table.length - radius + _SLACK
    if not (inside and radius - _SLACK <= y <= table.width - radius + _SLACK):
        raise InputError(
            f"{name} is at ({x:.4g}, {y:.4g}) m; its centre has to be on the table, "
            f"{radius:.4g} m or more inside {table.length:.4g} by {table.width:.4g} m"
        )


def _first_time(room: float, pace: float, gain: float) -> float:
    """Return the first time at which pace t + gain t^2 / 2 passes room from below."""
    square = pace * pace + 2.0 * gain * room
    if square < 0.0 or (pace <= 0.0 and gain <= 0.0):
        return math.inf
    root = math.sqrt(square)
    # Of the two forms of the root the one that subtracts nothing.
    return 2.0 * room / (pace + root) if pace > 0.0 else (root - pace) / gain


def _arc(along: float, beside: float) -> float:
    """Return the integral of sqrt(v^2 + beside^2) by v, from 0 to `along`."""
    if beside < 1e-100:  # along / beside may be more than a float holds
        return 0.5 * along * abs(along)
    return 0.5 * (along * math.hypot(along, beside) + beside**2 * math.asinh(along / beside))
