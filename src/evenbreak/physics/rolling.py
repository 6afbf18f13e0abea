"""The energy of a rolling ball, other shapes, and spin without speed (section 2, P2.4 to P2.6).

A round body with inertia k M R^2 that rolls without slipping has (1 + k) times the energy of its
motion; k = 2/5 for a ball. On a slope it accelerates as if only 1 / (1 + k) of the pull acted,
so the rolling resistance measured with one shape gives that of another.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from evenbreak.checks import kind_of, plain, together
from evenbreak.physics.arrays import numbers, positive
from evenbreak.physics.objects import Ball, Cloth
from evenbreak.physics.units import GRAVITY, INCH

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
        its mass in kilograms counts.
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
        metres.
    friction
        the coefficient of rolling friction, as from `rolling_friction`.
    shape
        the moment of inertia in units of M R^2.
    gravity
        metres per second squared, such as `MOON_GRAVITY`.

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
        seconds and metres until natural roll begins.
    roll_time, roll_distance
        seconds and metres from then until it stops.
    """

    roll_speed: Any
    slide_time: Any
    slide_distance: Any
    roll_time: Any
    roll_distance: Any

    @property
    def distance(self) -> Any:
        """The total distance, in metres."""
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
