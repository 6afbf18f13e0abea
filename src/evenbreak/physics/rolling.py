"""Rolling balls: table speed (P1.5), energy, other shapes, and spin without speed (P2.4 to P2.6).

A round body with inertia k M R^2 that rolls without slipping has (1 + k) times the energy of its
motion; k = 2/5 for a ball. On a slope it accelerates as if only 1 / (1 + k) of the pull acted,
so the rolling resistance measured with one shape gives that of another.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import FloatOrArray
from evenbreak.checks import kind_of, plain, together
from evenbreak.physics.objects import Ball, Cloth, PoolTable
from evenbreak.physics.units import GRAVITY, INCH, numbers, positive

MOON_GRAVITY = 63.8 * INCH
"""The acceleration of gravity on the moon, m/s^2 (P2.5)."""

SHAPES: Mapping[str, float] = MappingProxyType(
    {"ball": 0.4, "cylinder": 0.5, "hollow ball": 2.0 / 3.0, "ring": 1.0}
)
"""The moment of inertia of round bodies about their rolling axis, in units of M R^2."""


class Energy(NamedTuple):
    """Kinetic energy in joules: of the motion and of the spin.

    Parameters
    ----------
    translational, rotational
        in joules.
    """

    translational: Any
    rotational: Any

    @property
    def total(self) -> Any:
        """The sum of the two."""
        return self.translational + self.rotational


def kinetic_energy(ball: Ball, speed: Any, rim_speed: Any) -> Energy:
    """Return the energy of a ball with a speed and a rim speed R omega, both in m/s.

    Parameters
    ----------
    ball
        only its mass, in kilograms, counts.
    speed
        V, in m/s.
    rim_speed
        R omega, in m/s.

    Notes
    -----
    Source: P2.4; a ball in natural roll has 5/7 of its energy in its motion.

    >>> energy = kinetic_energy(Ball(), 1.0, 1.0)
    >>> round(energy.translational / energy.total, 6)
    0.714286
    """
    mass = kind_of(ball, "ball", Ball).mass
    speed, rim_speed = numbers(speed, "speed"), numbers(rim_speed, "rim_speed")
    together(speed=speed, rim_speed=rim_speed)
    return Energy(plain(0.5 * mass * speed**2), plain(0.2 * mass * np.square(rim_speed)))


def rolling_friction(mu_roll: Any, *, shape: float = SHAPES["ball"]) -> Any:
    """Return the coefficient of rolling friction, from the effective one of a shape.

    Parameters
    ----------
    mu_roll
        the effective coefficient, deceleration over gravity, which depends on the shape.
    shape
        the moment of inertia in units of M R^2.

    Notes
    -----
    Source: section 2; 7/5 mu_roll for a ball. It is the same for every shape of one material,
    and equals the sine of the slope on which the body rolls at constant speed.

    >>> round(rolling_friction(1 / 96.7), 4)
    0.0145
    """
    inertia, mu_roll = numbers(shape, "shape", low=0.0), numbers(mu_roll, "mu_roll", low=0.0)
    together(mu_roll=mu_roll, shape=inertia)
    return plain((1.0 + inertia) * mu_roll)


def rolling_time(
    distance: Any,
    friction: Any,
    *,
    shape: float = SHAPES["ball"],
    gravity: float = GRAVITY,
) -> Any:
    """Return how long a round body takes to roll a given distance and stop, in seconds (P2.5).

    Parameters
    ----------
    distance
        meters.
    friction
        the coefficient of rolling friction, as from `rolling_friction`.
    shape
        the moment of inertia in units of M R^2.
    gravity
        meters per second squared, such as `MOON_GRAVITY`.

    >>> length = 97.75 * INCH
    >>> round(rolling_time(length, 0.0145, shape=SHAPES["cylinder"], gravity=MOON_GRAVITY), 1)
    17.8
    """
    friction, pull = positive(friction, "friction"), positive(gravity, "gravity")
    distance, inertia = numbers(distance, "distance", low=0.0), numbers(shape, "shape", low=0.0)
    together(distance=distance, friction=friction, shape=inertia, gravity=pull)
    return plain(np.sqrt(2.0 * (1.0 + inertia) * distance / (pull * friction)))


class SpinStop(NamedTuple):
    """A ball that starts with spin but no speed, until it stops.

    Parameters
    ----------
    roll_speed
        of natural roll, in m/s.
    slide_time, slide_distance
        seconds and meters until natural roll starts.
    roll_time, roll_distance
        seconds and meters from then until it stops.
    """

    roll_speed: Any
    slide_time: Any
    slide_distance: Any
    roll_time: Any
    roll_distance: Any

    @property
    def distance(self) -> Any:
        """The total distance, in meters."""
        return self.slide_distance + self.roll_distance


def spin_stop(rim_speed: Any, cloth: Cloth) -> SpinStop:
    """Return how far topspin or draw alone takes a ball (P2.6).

    For example the cue ball after a full hit, which has lost its speed but not its spin.

    Parameters
    ----------
    rim_speed
        R omega in m/s, of either sign.
    cloth
        on which the ball slides and rolls.

    Notes
    -----
    Source: P2.6: the distance grows with the square of the spin.

    >>> stop = spin_stop(90.0, Cloth(mu_slide=0.2, mu_roll=0.0103, gravity=386.0))
    >>> round(stop.slide_distance, 4), round(stop.roll_distance, 4), round(stop.distance, 4)
    (4.2825, 83.1562, 87.4387)
    """
    speed = 2.0 / 7.0 * np.abs(numbers(rim_speed, "rim_speed"))
    kind_of(cloth, "cloth", Cloth)
    pull, resistance = cloth.slide_deceleration, cloth.roll_deceleration
    parts = (
        speed,
        speed / pull,
        speed**2 / (2.0 * pull),
        speed / resistance,
        speed**2 / (2.0 * resistance),
    )
    return SpinStop(*map(plain, parts))


TABLE_SPEEDS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "very slow": (50.0, 70.0),
        "normal": (80.0, 100.0),
        "very fast": (120.0, 150.0),
        "fast billiard": (150.0, math.inf),
    }
)
"""Names for ranges of table speed; new worsted cloth has 100 to 130."""


def lag_distance(table: PoolTable, ball: Ball) -> float:
    """Return how far a ball's center travels from end cushion to end cushion, in meters.

    Parameters
    ----------
    table, ball
        the length of the one and the diameter of the other, in meters, count.

    >>> from evenbreak.physics.units import INCH
    >>> round(lag_distance(PoolTable(), Ball()) / INCH, 9)
    97.75
    """
    return kind_of(table, "table", PoolTable).length - kind_of(ball, "ball", Ball).diameter


def table_speed(
    lag_time: FloatOrArray, *, distance: FloatOrArray = None, gravity: float = GRAVITY
) -> FloatOrArray:
    """Return the table speed from the time that a ball takes to roll a distance and stop.

    Exercise 1.1 times it with a ball let go on a ramp of two cues.

    Parameters
    ----------
    lag_time
        seconds from one end cushion until the ball stops just at the other.
    distance
        meters that its center travels; by default the length of a nine-foot table.
    gravity
        meters per second squared.

    Notes
    -----
    Source: P1.5, g t^2 / (2 d) = 1 / mu_roll; on a nine-foot table nearly 2 t^2.

    >>> round(table_speed(7.0), 1)
    96.7
    """
    meters = positive(_nine_feet() if distance is None else distance, "distance")
    time, pull = positive(lag_time, "lag_time"), positive(gravity, "gravity")
    together(lag_time=time, distance=meters, gravity=pull)
    return plain(0.5 * pull * time**2 / meters)


def lag_speed(lag_time: FloatOrArray, *, distance: FloatOrArray = None) -> FloatOrArray:
    """Return the speed off the last cushion of a ball that rolls a distance and stops (P1.5).

    In m/s; it is twice the mean speed. The parameters are those of `table_speed`.

    Parameters
    ----------
    lag_time
        seconds from one end cushion until the ball stops just at the other.
    distance
        meters that its center travels; by default the length of a nine-foot table.

    >>> from evenbreak.physics.units import INCH
    >>> round(lag_speed(7.0) / INCH, 1)
    27.9
    """
    meters = numbers(_nine_feet() if distance is None else distance, "distance", low=0.0)
    time = positive(lag_time, "lag_time")
    together(lag_time=time, distance=meters)
    return plain(2.0 * meters / time)


def roll_time(speed: FloatOrArray, cloth: Cloth) -> FloatOrArray:
    """Return how long a ball rolls until it stops, in seconds, from its speed in m/s.

    Parameters
    ----------
    speed
        of natural roll at the start, in m/s.
    cloth
        on which the ball rolls: its rolling resistance, and gravity in m/s^2.

    >>> round(roll_time(1.0, Cloth(mu_roll=0.01, gravity=10.0)), 9)
    10.0
    """
    resistance = kind_of(cloth, "cloth", Cloth).roll_deceleration
    return plain(numbers(speed, "speed", low=0.0) / resistance)


def roll_distance(speed: FloatOrArray, cloth: Cloth) -> FloatOrArray:
    """Return how far a ball rolls until it stops, in meters, from its speed in m/s.

    Parameters
    ----------
    speed
        of natural roll at the start, in m/s.
    cloth
        on which the ball rolls: its rolling resistance, and gravity in m/s^2.

    >>> round(roll_distance(1.0, Cloth(mu_roll=0.01, gravity=10.0)), 9)
    5.0
    """
    resistance = kind_of(cloth, "cloth", Cloth).roll_deceleration
    return plain(numbers(speed, "speed", low=0.0) ** 2 / (2.0 * resistance))


def _nine_feet() -> float:
    return lag_distance(PoolTable(), Ball())
