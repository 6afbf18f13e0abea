"""The sizes and weights of balls that the rules allow (section 1, P1.1 to P1.3)."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from evenbreak.checks import kind_of, one_of
from evenbreak.physics.objects import Ball
from evenbreak.physics.units import INCH, OUNCE


class BallSet(NamedTuple):
    """The balls of a game, according to its rules.

    Parameters
    ----------
    diameters
        the diameters in use, in metres.
    masses
        the smallest and the largest mass, in kilograms.
    tolerance
        the allowed deviation of a diameter, in metres.
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
    """Return the volumes of the smallest and the largest ball of a set, in cubic metres (P1.1).

    Parameters
    ----------
    balls
        the rules of the set: diameters and tolerance in metres.

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

    Parameters
    ----------
    balls
        the rules of the set: diameters in metres, masses in kilograms.

    >>> [round(density / 1000.0, 2) for density in density_range(BALL_SETS["pool"])]
    [1.58, 1.75]
    """
    smallest, largest = volume_range(balls)
    return balls.masses[0] / largest, balls.masses[1] / smallest


def floats_in(balls: BallSet, liquid: str) -> bool:
    """Return whether every ball of a set floats in a liquid, one of `LIQUIDS` (P1.2).

    Parameters
    ----------
    balls
        the rules of the set.
    liquid
        its name, one of `LIQUIDS`.

    Raises
    ------
    InputError
        if it is not one of those liquids.

    >>> [name for name in LIQUIDS if floats_in(BALL_SETS["pool"], name)]
    ['caesium chloride solution', 'mercury']
    """
    return density_range(balls)[1] < LIQUIDS[one_of(liquid, "liquid", tuple(LIQUIDS))]
