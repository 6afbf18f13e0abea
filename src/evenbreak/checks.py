"""Checks of parameters: each returns the value it was given, or says how to mend it.

Scalars are checked without numpy, so that a program which only asks scalar
questions never imports it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, overload

from evenbreak.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Many: TypeAlias = Sequence[float] | NDArray[Any]
    Floats: TypeAlias = NDArray[np.float64]


def probability(value: Any, name: str) -> Any:
    """Return `value` if it is a probability, or an array of them.

    Parameters
    ----------
    value
        a number, or something numpy makes a float array of.
    name
        what the value is called where the caller wrote it.

    Returns
    -------
    float or numpy.ndarray
        a float for a number (integers and `fractions.Fraction` are converted), an
        array otherwise.

    Raises
    ------
    InputError
        if a value is not a number in [0, 1].

    >>> probability(1, "p")
    1.0
    >>> probability(1.5, "p")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: p is 1.5, not a probability; give a number from 0 to 1
    """
    if not hasattr(value, "__len__") and not hasattr(value, "ndim"):
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = math.nan
        if not 0.0 <= number <= 1.0:
            raise InputError(f"{name} is {value!r}, not a probability; give a number from 0 to 1")
        return number
    return _probabilities(value, name)


def number_probability(value: Any, name: str) -> float:
    """Return `value` as a float if it is one probability, not an array of them.

    >>> number_probability([0.4, 0.5], "p1")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: p1 is [0.4, 0.5]; give one number from 0 to 1
    """
    checked = probability(value, name)
    if not isinstance(checked, float):
        raise InputError(f"{name} is {value!r}; give one number from 0 to 1")
    return checked


def number_probabilities(values: Any, name: str, each: str) -> tuple[float, ...]:
    """Return `values` as one probability or more, the i-th of them called `each` i.

    >>> number_probabilities([], "shots", "shot")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: shots is []; give a list of numbers from 0 to 1
    """
    listed = list(values) if hasattr(values, "__iter__") else []
    if not listed:
        raise InputError(f"{name} is {values!r}; give a list of numbers from 0 to 1")
    return tuple(number_probability(value, f"{each} {i}") for i, value in enumerate(listed, 1))


def _probabilities(value: Any, name: str) -> NDArray[Any] | float:
    import numpy as np

    try:
        array = np.asarray(value)
        if array.dtype.kind in "SUc":
            raise ValueError
        array = array.astype(float, copy=False)
    except (TypeError, ValueError):
        raise InputError(
            f"{name} is {value!r}, not an array of probabilities; give numbers from 0 to 1"
        ) from None
    wrong = ~((array >= 0) & (array <= 1))
    if wrong.any():
        first = float(array[wrong].flat[0])
        raise InputError(f"{name} holds {first!r}, not a probability; give numbers from 0 to 1")
    return float(array) if array.ndim == 0 else array


def whole(value: Any, name: str, *, at_least: int = 0) -> int:
    """Return `value` as an int if it is a whole number that is not too small.

    >>> whole(3.0, "m")
    3
    >>> whole(0, "m", at_least=1)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: m is 0; give a whole number, 1 or more
    """
    try:
        number = int(value)
        right = number >= at_least and bool(number == value) and not isinstance(value, str | bytes)
    except (TypeError, ValueError, OverflowError):
        right = False
    if not right:
        raise InputError(f"{name} is {value!r}; give a whole number, {at_least} or more")
    return number


def number_between(value: Any, name: str, least: float, most: float, unit: str = "") -> float:
    """Return `value` as a float if it is a number from `least` to `most`.

    >>> number_between(0.0, "prior_sd", 0.001, 100, "in log-odds")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: prior_sd is 0.0; give a number from 0.001 to 100, in log-odds
    """
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not least <= number <= most:
        wanted = f"give a number from {least:g} to {most:,g}{unit and ', ' + unit}"
        raise InputError(f"{name} is {value!r}; {wanted}")
    return number


def finite(value: Any, name: str, wanted: str = "a finite number") -> float:
    """Return `value` as a float if it is a finite number.

    >>> finite("x", "anchor", "points")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: anchor is 'x'; give points
    """
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise InputError(f"{name} is {value!r}; give {wanted}")
    return number


@overload
def numbers(value: float, name: str) -> float: ...
@overload
def numbers(value: Many, name: str) -> Floats: ...
def numbers(value: float | Many, name: str) -> float | Floats:
    """Return a float for a number and a float array for an array; either may be infinite.

    >>> numbers([1, 2], "difference")
    array([1., 2.])
    """
    if not hasattr(value, "__len__") and not hasattr(value, "ndim"):
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = math.nan
        if math.isnan(number):
            raise InputError(f"{name} is {value!r}; give a number")
        return number
    if isinstance(value, (str, bytes)):
        raise InputError(f"{name} is {value!r}; give a number, not text")
    import numpy as np

    array = np.asarray(value, dtype=float)
    if np.isnan(array).any():
        raise InputError(f"{name} holds a value that is not a number; give numbers")
    return float(array) if array.ndim == 0 else array


def one_of(value: Any, name: str, choices: tuple[Any, ...]) -> Any:
    """Return the one of `choices` that `value` equals: 1 for 1.0 or True.

    >>> one_of(3, "first_breaker", (1, 2))
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: first_breaker is 3; give 1 or 2
    """
    try:
        return choices[choices.index(value)]
    except ValueError:  # of an array too: its comparisons have no one truth
        listed = " or ".join(repr(choice) for choice in choices)
        raise InputError(f"{name} is {value!r}; give {listed}") from None
