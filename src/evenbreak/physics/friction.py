"""Friction: how to measure it, how it slows a sliding block, and its value between two balls.

Section 1 of the source text uses a constant for two balls, which its throw test measures (P1.6). In
measurements at several speeds, the friction falls as the balls slip faster on each other:

    mu(v) = a + b exp(-c v)

During a hit, the friction is that of the initial slip.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from evenbreak.arrays import FloatOrArray, Floats
from evenbreak.checks import number, plain, together
from evenbreak.errors import InputError
from evenbreak.physics.units import GRAVITY, LARGEST, numbers, positive


def friction_of_incline(angle: Any) -> Any:
    """Return the friction of a block that slides down an incline at constant speed (P1.4).

    Parameters
    ----------
    angle
        of the incline, in radians.

    >>> round(friction_of_incline(math.radians(20.0)), 4)
    0.364
    """
    return plain(np.tan(numbers(angle, "angle", low=0.0, high=math.pi / 2.0)))


def friction_of_pull(force: Any, weight: Any) -> Any:
    """Return the friction of a block, from the force that slides it at constant speed.

    Parameters
    ----------
    force, weight
        the reading of the scale that pulls it, and its weight, in the same unit. If instead two
        energies were measured, the force is the energy lost over the distance between them.

    Notes
    -----
    Source: section 1, methods (1) and (3).

    >>> friction_of_pull(1.5, 6.0)
    0.25
    """
    force, weight = numbers(force, "force", low=0.0), positive(weight, "weight")
    together(force=force, weight=weight)
    return plain(force / weight)


def friction_of_speeds(first: Any, second: Any, distance: Any, *, gravity: float = GRAVITY) -> Any:
    """Return the friction of a sliding block, from its speeds at two points of its path.

    Parameters
    ----------
    first, second
        speeds in m/s; it cannot be faster at the second point.
    distance
        in meters.
    gravity
        meters per second squared.

    Raises
    ------
    InputError
        if the block is faster at the second point.

    Notes
    -----
    Source: section 1, method (3): T = T_0 - mu M g x at two points, where the mass cancels.

    >>> friction_of_speeds(5.0, 3.0, 4.0, gravity=10.0)
    0.2
    """
    first, second = numbers(first, "first", low=0.0), numbers(second, "second", low=0.0)
    distance, pull = positive(distance, "distance"), positive(gravity, "gravity")
    together(first=first, second=second, distance=distance, gravity=pull)
    if np.any(second > first):
        raise InputError(
            "second can't be above first, because a sliding block doesn't gain "
            "speed; somewhere it is"
        )
    return plain((first - second) * (first + second) / (2.0 * pull * distance))


def friction_of_throw(sideways: FloatOrArray, ahead: FloatOrArray) -> FloatOrArray:
    """Return the friction between balls, from how far a frozen ball is thrown off line (P1.6).

    Exercise 1.2 measures it with several sets of balls, with chalk, talc or water between them.

    Parameters
    ----------
    sideways, ahead
        how far from its target the second of two frozen balls lands, and how far away that
        target is, in the same unit.

    >>> round(friction_of_throw(4.0, 72.0), 4)
    0.0556
    """
    sideways, ahead = numbers(sideways, "sideways", low=0.0), positive(ahead, "ahead")
    together(sideways=sideways, ahead=ahead)
    return plain(sideways / ahead)


def friction_of_stop(distance: Any, time: Any, *, gravity: float = GRAVITY) -> Any:
    """Return the friction of an object that stops after a distance and a time.

    Parameters
    ----------
    distance
        meters.
    time
        seconds.
    gravity
        meters per second squared.

    Notes
    -----
    Source: section 1, mu = d / (g t^2 / 2). For a sliding block this is the coefficient of
    sliding friction, for a rolling ball the effective coefficient of rolling resistance.

    >>> friction_of_stop(1.0, 1.0, gravity=10.0)
    0.2
    """
    distance, time = numbers(distance, "distance", low=0.0), positive(time, "time")
    pull = positive(gravity, "gravity")
    together(distance=distance, time=time, gravity=pull)
    return plain(distance / (0.5 * pull * time**2))


def sliding_speed(speed: Any, friction: Any, time: Any, *, gravity: float = GRAVITY) -> Any:
    """Return the speed of a block that has slid for a time, in m/s; 0 once it has stopped.

    Parameters
    ----------
    speed
        at the start, in m/s.
    friction
        coefficient of friction between block and cloth.
    time
        seconds since the start.
    gravity
        meters per second squared.

    >>> round(sliding_speed(50.0, 0.2, 0.5, gravity=386.0), 9)
    11.4
    """
    speed, slowing, time = _block(speed, friction, gravity, time=time)
    return plain(np.maximum(speed - slowing * time, 0.0))


def sliding_distance(speed: Any, friction: Any, time: Any, *, gravity: float = GRAVITY) -> Any:
    """Return how far a block has slid after a time, in meters; it stays where it stops.

    Parameters
    ----------
    speed
        at the start, in m/s.
    friction
        coefficient of friction between block and cloth.
    time
        seconds since the start.
    gravity
        meters per second squared.

    >>> round(sliding_distance(50.0, 0.2, 0.5, gravity=386.0), 9)
    15.35
    """
    speed, slowing, time = _block(speed, friction, gravity, time=time)
    moving = np.minimum(time, speed / slowing)
    return plain(speed * moving - 0.5 * slowing * moving**2)


def sliding_power(speed: Any, friction: Any, mass: Any, *, gravity: float = GRAVITY) -> Any:
    """Return dT/dt, the rate at which the energy of a sliding block changes, in watts: below 0.

    Parameters
    ----------
    speed
        of the block now, in m/s.
    friction
        coefficient of friction between block and cloth.
    mass
        of the block, in kilograms.
    gravity
        meters per second squared.

    >>> round(sliding_power(2.0, 0.1, 1.0, gravity=10.0), 9)
    -2.0
    """
    speed, slowing, mass = _block(speed, friction, gravity, mass=mass)
    return plain(-slowing * mass * speed)


def miscue_offset(friction: FloatOrArray) -> FloatOrArray:
    """Return the largest offset b/R from the center without a miscue (P1.7).

    Parameters
    ----------
    friction
        coefficient of static friction between tip and ball.

    >>> round(miscue_offset(1.0), 3)
    0.707
    """
    friction = numbers(friction, "friction", low=0.0)
    return plain(friction / np.hypot(1.0, friction))


def tip_friction_of(offset: FloatOrArray) -> FloatOrArray:
    """Return the static friction of a tip that starts to slip at an offset b/R (P1.7).

    Exercise 1.3 finds the offset with the shaft upright on a ball.

    Parameters
    ----------
    offset
        b/R, 0 to 1: from the center, over the radius of the ball.

    >>> round(tip_friction_of(0.5), 3)
    0.577
    """
    offset = numbers(offset, "offset", low=0.0, high=1.0)
    with np.errstate(divide="ignore"):
        return plain(offset / np.sqrt((1.0 - offset) * (1.0 + offset)))


def _block(speed: Any, friction: Any, gravity: Any, **third: Any) -> tuple[Floats, Floats, Floats]:
    """Return a block's speed, its deceleration and a third number, after checking all of them."""
    block = {
        "speed": numbers(speed, "speed", low=0.0),
        "friction": positive(friction, "friction"),
        "gravity": positive(gravity, "gravity"),
        **{name: numbers(value, name, low=0.0) for name, value in third.items()},
    }
    together(**block)
    speed, friction, gravity, last = block.values()
    return speed, friction * gravity, last


BALL_FRICTION = 4.0 / 72.0
"""The coefficient of friction between two balls, as measured in P1.6."""


@dataclass(frozen=True)
class SlipFriction:
    """Friction between balls that falls with the speed at which they slip on each other.

    Parameters
    ----------
    fast
        a, the coefficient at a very fast slip.
    more
        b, how much higher it is at a very slow slip.
    decay
        c, how quickly it falls, in seconds per meter.

    Raises
    ------
    InputError
        if one is not a number from 0 to 1e50.

    Notes
    -----
    Source of the defaults: D. G. Alciatore, technical proof TP A.14 (billiards.colostate.edu),
    a fit to the measurements in W. C. Marlow, *The Physics of Pocket Billiards*. pooltool uses
    the same curve.

    >>> [round(SlipFriction().at(slip), 4) for slip in (0.1, 1.0, 10.0)]
    [0.1068, 0.0463, 0.01]
    """

    fast: float = 9.951e-3
    more: float = 0.108
    decay: float = 1.088

    def __post_init__(self) -> None:
        for name in ("fast", "more", "decay"):
            value = number(getattr(self, name), name, low=0.0, high=LARGEST)
            object.__setattr__(self, name, value)

    @property
    def slow(self) -> float:
        """The coefficient at a very slow slip, the largest."""
        return self.fast + self.more

    def at(self, slip: Any) -> Any:
        """Return the coefficient for a slip speed in m/s."""
        slip = numbers(slip, "slip", low=0.0, high=np.inf)
        with np.errstate(over="ignore"):
            return plain(self.fast + self.more * np.exp(-self.decay * slip))


def checked_friction(mu: Any, speed: Any) -> tuple[Floats | SlipFriction, Floats]:
    """Return the friction and speed of a hit, checked; speed-dependent friction needs a speed."""
    if speed is None:
        if isinstance(mu, SlipFriction):
            raise InputError("mu depends on how fast the balls slip. Give the cue ball's speed.")
        speed = 1.0
    speed = numbers(speed, "speed", low=0.0)
    return mu if isinstance(mu, SlipFriction) else numbers(mu, "mu", low=0.0), speed


def one_friction(mu: Any) -> float | SlipFriction:
    """Return the friction of one hit, checked."""
    return mu if isinstance(mu, SlipFriction) else number(mu, "mu", low=0.0, high=LARGEST)


def friction_of_slip(
    mu: Floats | SlipFriction, speed: Floats, left: Floats, up: Floats
) -> Floats | float:
    """Return the coefficient for a slip to the left and up that is given relative to the speed."""
    if not isinstance(mu, SlipFriction):
        return mu
    return np.asarray(mu.at(speed * np.hypot(left, up)))
