"""Players' units in SI units, and checks of numbers in them.

Multiply to convert to SI, divide to convert back: `9 * INCH` is in meters, `length / INCH` in
inches.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from evenbreak.checks import floats

if TYPE_CHECKING:  # it loads numpy
    from evenbreak.arrays import Floats

INCH = 0.0254
"""Meters in an inch."""

FOOT = 12.0 * INCH
"""Meters in a foot."""

CENTIMETER = 0.01
"""Meters in a centimeter."""

OUNCE = 0.028349523125
"""Kilograms in an ounce (avoirdupois)."""

GRAM = 0.001
"""Kilograms in a gram."""

DEGREE = math.pi / 180.0
"""Radians in a degree."""

GRAVITY = 386.0 * INCH
"""The acceleration of gravity in m/s^2: 386 in/s^2 = 9.8044 m/s^2, the value of the source text."""


LARGEST = 1e50
"""The largest number accepted, so that products of a few numbers still fit into a float."""

LEAST = 1.0 / LARGEST
"""The smallest number accepted if 0 is not."""


def numbers(value: Any, name: str, *, low: float = -LARGEST, high: float = LARGEST) -> Floats:
    """Return numbers as a float array if all of them are from `low` to `high`.

    >>> numbers(-1.0, "speed", low=0.0)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: speed must be a number from 0 to 1e+50; it is -1.0
    """
    return floats(value, name, low=low, high=high)


def positive(value: Any, name: str) -> Floats:
    """Return numbers as a float array if all of them are above 0.

    >>> positive(0.0, "gravity")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: gravity must be a number from 1e-50 to 1e+50; it is 0.0
    """
    return floats(value, name, low=LEAST, high=LARGEST)
