"""Slopes and roots of functions of one number, for answers that the text finds by search."""

from __future__ import annotations

from collections.abc import Callable


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
    """Return where a function passes 0, between two points where its signs differ.

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
