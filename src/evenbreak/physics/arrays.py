"""Checks of numbers and arrays: numbers too large to calculate with are refused."""

from __future__ import annotations

from typing import Any

from evenbreak.arrays import Floats
from evenbreak.checks import floats

LARGEST = 1e50
"""The largest number accepted, so that products of a few of them still fit into a float."""

LEAST = 1.0 / LARGEST
"""The smallest number accepted where 0 is not."""


def numbers(value: Any, name: str, *, low: float = -LARGEST, high: float = LARGEST) -> Floats:
    """Return numbers as a float array if all of them are from `low` to `high`.

    >>> numbers(-1.0, "speed", low=0.0)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: speed is -1.0; give a number from 0 to 1e+50
    """
    return floats(value, name, low=low, high=high)


def positive(value: Any, name: str) -> Floats:
    """Return numbers as a float array if all of them are above 0.

    >>> positive(0.0, "gravity")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: gravity is 0.0; give a number from 1e-50 to 1e+50
    """
    return floats(value, name, low=LEAST, high=LARGEST)
