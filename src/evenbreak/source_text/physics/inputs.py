"""The inputs of a printed number, such as `alpha=30deg V_0=36in/s`, in SI units and radians."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

from evenbreak.physics.units import DEGREE, INCH, OUNCE

Inputs: TypeAlias = Mapping[str, Any]
"""Numbers in SI units by name, and words by name."""

Answers: TypeAlias = Mapping[tuple[str, str], Callable[[Inputs], Any]]
"""How to compute each quantity that the text prints, by problem and quantity."""

_NUMBER = re.compile(r"(-?\d*\.?\d+(?:/\d+)?)(deg|in|in/s|oz|s)?")
_UNITS = {"": 1.0, "deg": DEGREE, "in": INCH, "in/s": INCH, "oz": OUNCE, "s": 1.0}


def parse_inputs(text: str) -> Inputs:
    """Return what stands before and after each `=`; words without one are for the reader.

    >>> parse_inputs("half ball b/R=1/2 V_0=2in/s balls=pool")
    {'b/R': 0.5, 'V_0': 0.0508, 'balls': 'pool'}
    """
    parts = (word.partition("=") for word in text.split())
    return {name: _value(value) for name, equals, value in parts if equals}


def _value(text: str) -> float | str:
    number = _NUMBER.fullmatch(text)
    if not number:
        return text.replace("_", " ")
    return float(Fraction(number[1])) * _UNITS[number[2] or ""]


def slope(function: Callable[[float], float], at: float) -> float:
    """Return the derivative of a smooth function, to nine digits or more.

    >>> import math
    >>> round(slope(math.sin, 0.0), 9)
    1.0
    """
    step = 3e-4
    near = function(at + step) - function(at - step)
    far = function(at + 2.0 * step) - function(at - 2.0 * step)
    return (8.0 * near - far) / (12.0 * step)


def crossing(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function passes 0, by halving a range at whose ends its signs differ.

    >>> import math
    >>> round(crossing(math.cos, 1.0, 2.0), 9)
    1.570796327
    """
    rises = function(high) > 0.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        if (function(middle) > 0.0) == rises:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)
