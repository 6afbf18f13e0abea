"""Checks of numbers and arrays: functions take what broadcasts, and return floats for floats."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import InputError

Floats = NDArray[np.float64]

LARGEST = 1e50
"""The largest number accepted, so that products of a few of them still fit into a float."""


def numbers(
    value: Any,
    name: str,
    *,
    low: float = -math.inf,
    high: float = math.inf,
    open_low: bool = False,
) -> Floats:
    """Return finite numbers from `low` to `high` as a float array, or refuse them by name.

    Parameters
    ----------
    value
        a number, or something that numpy makes a float array of.
    name
        the name of the parameter, for the error.
    low, high
        the range, ends included; `open_low` excludes `low`.

    Raises
    ------
    InputError
        if a value is not a finite number in the range, is beyond `LARGEST`, or is closer than
        1 / `LARGEST` to an excluded limit of 0.

    >>> numbers(-1.0, "speed", low=0.0)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: speed is -1.0; give a finite number, 0 or more
    """
    try:
        if value is None or isinstance(value, str | bytes):  # numpy takes None for NaN
            raise TypeError
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} is {value!r}; give {_wanted(low, high, open_low)}") from None
    # One pass over the largest and the smallest: NaN and infinity show in them.
    if array.size:
        least, most = float(array.min()), float(array.max())
        right = math.isfinite(least) and math.isfinite(most) and most <= high
        if not (right and (least > low if open_low else least >= low)):
            raise InputError(f"{_held(array, name)}; give {_wanted(low, high, open_low)}")
        if max(-least, most) > LARGEST:
            raise InputError(f"{_held(array, name)}; give at most {LARGEST:g}")
        if open_low and least - low < 1.0 / LARGEST:
            raise InputError(f"{_held(array, name)}; give at least {1.0 / LARGEST:g}")
    return array


def positive(value: Any, name: str) -> Floats:
    """Return finite numbers above 0 as a float array, or refuse them by name.

    >>> positive(0.0, "gravity")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: gravity is 0.0; give a finite number above 0
    """
    return numbers(value, name, low=0.0, open_low=True)


def together(**arrays: Floats) -> None:
    """Refuse arrays whose shapes do not broadcast together, naming them.

    >>> together(cut=np.zeros(2), mu=np.zeros(3))
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: cut has shape (2,), mu has shape (3,); give shapes that broadcast
    """
    shapes = {name: array.shape for name, array in arrays.items() if array.ndim}
    if len(shapes) < 2:
        return
    try:
        np.broadcast_shapes(*shapes.values())
    except ValueError:
        held = ", ".join(f"{name} has shape {shape}" for name, shape in shapes.items())
        raise InputError(f"{held}; give shapes that broadcast") from None


def plain(value: Any) -> Any:
    """Return a float for an array without axes, and any other array as it is.

    >>> plain(np.array(2.5)), plain(np.array([2.5]))
    (2.5, array([2.5]))
    """
    return float(value) if np.ndim(value) == 0 else value


def _held(array: Floats, name: str) -> str:
    if array.ndim == 0:
        return f"{name} is {float(array)!r}"
    return f"{name} holds values from {float(array.min())!r} to {float(array.max())!r}"


def _wanted(low: float, high: float, open_low: bool) -> str:
    if math.isinf(low) and math.isinf(high):
        return "a finite number"
    if math.isinf(high):
        return f"a finite number above {low:g}" if open_low else f"a finite number, {low:g} or more"
    if open_low:
        return f"a number above {low:.6g}, at most {high:.6g}"
    return f"a number from {low:.6g} to {high:.6g}"
