"""The equipment: ball, cloth, table, cue; the sizes and weights that are allowed (P1.1 to P1.3)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from evenbreak.checks import kind_of, number, one_of
from evenbreak.physics.units import GRAVITY, INCH, LARGEST, LEAST, OUNCE


@dataclass(frozen=True)
class Ball:
    """A uniform sphere.

    Parameters
    ----------
    mass
        kilograms; a pool ball weighs 5.5 to 6 ounces.
    radius
        meters; the diameter of a pool ball is 2.25 inches, to within 0.005.

    Raises
    ------
    InputError
        if one is not a number from 1e-50 to 1e50.

    Notes
    -----
    Source: section 1, P1.1 to P1.3.

    >>> ball = Ball()
    >>> round(ball.diameter / INCH, 3), round(ball.mass / OUNCE, 3)
    (2.25, 6.0)
    """

    mass: float = 6.0 * OUNCE
    radius: float = 1.125 * INCH

    def __post_init__(self) -> None:
        _positive(self, "mass", "kilograms")
        _positive(self, "radius", "meters")

    @property
    def diameter(self) -> float:
        """The diameter in meters."""
        return 2.0 * self.radius

    @property
    def volume(self) -> float:
        """The volume in cubic meters (P1.1)."""
        return 4.0 / 3.0 * math.pi * self.radius**3

    @property
    def density(self) -> float:
        """The density in kilograms per cubic meter (P1.2)."""
        return self.mass / self.volume

    @property
    def inertia(self) -> float:
        """The moment of inertia about any axis through the center, in kg m^2 (P1.3)."""
        return 0.4 * self.mass * self.radius**2


@dataclass(frozen=True)
class Cloth:
    """The cloth that a ball slides and rolls on, and the gravity that holds the ball down.

    Parameters
    ----------
    mu_slide
        coefficient of sliding friction between ball and cloth.
    mu_roll
        effective coefficient of rolling resistance: a rolling ball decelerates at mu_roll
        times gravity.
    gravity
        meters per second squared.

    Raises
    ------
    InputError
        if one is not a number from 1e-50 to 1e50.

    Notes
    -----
    Source: section 1, "table speed" (80 to 100 is normal).

    >>> round(Cloth(mu_roll=0.01).table_speed, 9)
    100.0
    """

    mu_slide: float = 0.2
    mu_roll: float = 0.01
    gravity: float = GRAVITY

    def __post_init__(self) -> None:
        _positive(self, "mu_slide", "such as 0.2")
        _positive(self, "mu_roll", "such as 0.01")
        _positive(self, "gravity", "meters per second squared")

    @property
    def slide_deceleration(self) -> float:
        """A sliding ball's deceleration, in m/s^2."""
        return self.mu_slide * self.gravity

    @property
    def roll_deceleration(self) -> float:
        """A rolling ball's deceleration, in m/s^2."""
        return self.mu_roll * self.gravity

    @property
    def table_speed(self) -> float:
        """The table speed, 1 / mu_roll: the higher, the farther a ball rolls."""
        return 1.0 / self.mu_roll


@dataclass(frozen=True)
class PoolTable:
    """A table: the playing area between the noses of the cushions.

    Parameters
    ----------
    length, width
        meters; 100 by 50 inches on a nine-foot table.

    Raises
    ------
    InputError
        if one is not a number from 1e-50 to 1e50.

    >>> round(PoolTable().length / INCH, 9)
    100.0
    """

    length: float = 100.0 * INCH
    width: float = 50.0 * INCH

    def __post_init__(self) -> None:
        _positive(self, "length", "meters")
        _positive(self, "width", "meters")


@dataclass(frozen=True)
class Cue:
    """A cue stick.

    Parameters
    ----------
    mass
        kilograms; 18 ounces is typical.
    tip_friction
        coefficient of static friction between tip and ball; it sets the offset beyond which
        the tip slips, a miscue (P1.7).

    Raises
    ------
    InputError
        if one is not a number from 1e-50 to 1e50.

    >>> round(Cue().mass / OUNCE, 9)
    18.0
    """

    mass: float = 18.0 * OUNCE
    tip_friction: float = 1.0 / math.sqrt(3.0)

    def __post_init__(self) -> None:
        _positive(self, "mass", "kilograms")
        _positive(self, "tip_friction", "such as 0.6")


def _positive(thing: object, name: str, wanted: str) -> None:
    """Make a field a float, if it is a number within the limits."""
    wanted = f"a number from {LEAST:g} to {LARGEST:g} ({wanted})"
    value = number(getattr(thing, name), name, low=LEAST, high=LARGEST, wanted=wanted)
    object.__setattr__(thing, name, value)


class BallSet(NamedTuple):
    """Balls for a game, according to its rules.

    Parameters
    ----------
    diameters
        those in use, in meters.
    masses
        the smallest and the largest mass, in kilograms.
    tolerance
        the allowed deviation of a diameter, in meters.
    """

    diameters: tuple[float, ...]
    masses: tuple[float, float]
    tolerance: float = 0.005 * INCH


def _set(diameters: tuple[float, ...], least: float, most: float) -> BallSet:
    return BallSet(tuple(inches * INCH for inches in diameters), (least * OUNCE, most * OUNCE))


BALL_SETS: Mapping[str, BallSet] = MappingProxyType(
    {
        "pool": _set((2.25,), 5.5, 6.0),
        "snooker": _set((2 + 1 / 8, 2 + 1 / 16), 5.0, 5.5),
        "carom": _set((2 + 27 / 64, 2 + 3 / 8, 2 + 7 / 16), 7.0, 7.5),
    }
)
"""The ball sets, by game."""

LIQUIDS: Mapping[str, float] = MappingProxyType(
    {
        "water": 997.0,
        "sugar solution": 1330.0,
        "caesium chloride solution": 1890.0,
        "mercury": 13_600.0,
    }
)
"""Densities in kg/m^3 near 25 degrees Celsius; the solutions are saturated (P1.2, whose 1440 for
sugar is too high)."""


def volume_range(balls: BallSet) -> tuple[float, float]:
    """Return the volumes of the smallest and the largest ball of a set, in cubic meters (P1.1).

    >>> low, high = volume_range(BALL_SETS["pool"])
    >>> round(low / INCH**3, 3), round(high / INCH**3, 3)
    (5.924, 6.004)
    """
    kind_of(balls, "balls", BallSet)
    low, high = min(balls.diameters), max(balls.diameters)
    return (
        Ball(radius=(low - balls.tolerance) / 2.0).volume,
        Ball(radius=(high + balls.tolerance) / 2.0).volume,
    )


def density_range(balls: BallSet) -> tuple[float, float]:
    """Return the smallest and the largest density that the rules allow, in kg/m^3 (P1.2).

    >>> [round(density / 1000.0, 2) for density in density_range(BALL_SETS["pool"])]
    [1.58, 1.75]
    """
    smallest, largest = volume_range(balls)
    return balls.masses[0] / largest, balls.masses[1] / smallest


def floats_in(balls: BallSet, liquid: str) -> bool:
    """Return whether every ball of a set floats in a liquid, one of `LIQUIDS` (P1.2).

    Raises
    ------
    InputError
        if it is not one of those liquids.

    >>> [name for name in LIQUIDS if floats_in(BALL_SETS["pool"], name)]
    ['caesium chloride solution', 'mercury']
    """
    return density_range(balls)[1] < LIQUIDS[one_of(liquid, "liquid", tuple(LIQUIDS))]
