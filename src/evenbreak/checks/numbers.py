"""Checks of single values. None of them imports numpy, so scalar questions start without it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeVar

from evenbreak.checks.limits import Limits
from evenbreak.errors import InputError
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from numpy.random import Generator

Choice = TypeVar("Choice")


class ManyAsOne:
    """Base class of numbers that stand for many at once, and that games accept as a single float.

    All of them give the same answer to a comparison, or the comparison raises its own error (see
    `evenbreak.chains.family_numbers`).
    """

    __slots__ = ()


def number(
    value: Any,
    name: str,
    *,
    low: float = -math.inf,
    high: float = math.inf,
    above: float = -math.inf,
    below: float = math.inf,
    wanted: str = "",
) -> float:
    """Return `value` as a float if it is one finite number within the limits.

    Parameters
    ----------
    value
        a number; strings and arrays with dimensions are errors.
    name
        the value's name in the error.
    low, high
        the limits, included.
    above, below
        the limits, excluded.
    wanted
        the valid values, for the error message; default: the limits.

    Raises
    ------
    InputError
        if the value is not such a number.

    >>> number(7, "drift", low=0)
    7.0
    >>> number("x", "half_life", above=0, wanted="a number of days above 0")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: half_life must be a number of days above 0; you gave 'x'
    """
    found, limits = _float(value), Limits(low, high, above, below)
    if not limits.hold(found, found):
        raise InputError(
            "{name} must be {what}; you gave {value!r}",
            name=Parameter(name),
            value=value,
            what=wanted or limits.numbers(),
        )
    return found


def positive(value: Any, name: str, *, wanted: str = "") -> float:
    """Return `value` as a float if it is one finite number above 0.

    >>> positive(0, "mass")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: mass must be a finite number above 0; you gave 0
    """
    return number(value, name, above=0.0, wanted=wanted)


def number_probability(value: Any, name: str) -> float:
    """Return `value` as a float if it is a single probability.

    >>> number_probability([0.4, 0.5], "p1")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: p1 must be one number from 0 to 1; you gave [0.4, 0.5]
    """
    found: Any = value if isinstance(value, ManyAsOne) else _float(value)
    if not 0.0 <= found <= 1.0:
        many = isinstance(value, list | tuple) or hasattr(value, "ndim")
        wanted = "one" if many else "a"
        raise InputError(
            "{name} must be {wanted} number from 0 to 1; you gave {value!r}",
            name=Parameter(name),
            value=value,
            wanted=wanted,
        )
    return found  # type: ignore[no-any-return]


def exact_probability(value: Any, name: str) -> Any:
    """Return a single probability for exact answers: a `Fraction` or a formula unchanged.

    A formula is a sympy expression with symbols.

    >>> from fractions import Fraction
    >>> exact_probability(Fraction(1, 3), "p1"), exact_probability(1, "p1")
    (Fraction(1, 3), 1.0)
    """
    if getattr(value, "free_symbols", None):
        return value
    found = number_probability(value, name)
    return value if isinstance(value, Fraction) else found


def number_probabilities(values: Any, name: str, each: str) -> tuple[float, ...]:
    """Return `values` as one or more probabilities; errors call the i-th of them `each` i.

    >>> number_probabilities([], "shots", "shot")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: shots must be a list of numbers from 0 to 1; you gave []
    """
    listed = list(values) if hasattr(values, "__iter__") else []
    if not listed:
        raise InputError(
            "{name} must be a list of numbers from 0 to 1; you gave {values!r}",
            name=Parameter(name),
            values=values,
        )
    return tuple(number_probability(value, f"{each} {i}") for i, value in enumerate(listed, 1))


def whole(
    value: Any,
    name: str,
    *,
    at_least: int | None = 0,
    at_most: int | None = None,
    wanted: str = "",
) -> int:
    """Return `value` as an int if it is a whole number within the limits.

    Parameters
    ----------
    value
        a whole number, of any numeric type.
    name
        the value's name in the caller's code.
    at_least, at_most
        the smallest and the largest number allowed; None: no limit.
    wanted
        the valid values, for the error message; default: the limits.

    Raises
    ------
    InputError
        if the value is not such a number.

    >>> whole(3.0, "m")
    3
    >>> whole(0, "m", at_least=1)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: m must be a whole number, 1 or more; you gave 0
    """
    try:
        found = int(value)
        right = bool(found == value) and not isinstance(value, str | bytes)
    except (TypeError, ValueError, OverflowError):
        right = False
    too_small = right and at_least is not None and found < at_least
    if not right or too_small or (at_most is not None and found > at_most):
        limits = "" if at_least is None else f", {at_least} or more"
        if at_most is not None:
            limits = (
                f" from {at_least} to {at_most}" if at_least is not None else f", at most {at_most}"
            )
        raise InputError(
            "{name} must be {what}; you gave {value!r}",
            name=Parameter(name),
            value=value,
            what=wanted or "a whole number" + limits,
        )
    return found


def increasing(values: Iterable[Any], name: str, *, at_least: int | None = 0) -> tuple[int, ...]:
    """Return increasing whole numbers; errors refer to each by name and position.

    Raises
    ------
    InputError
        if one is not a whole number within the limit, or not larger than the one before.

    >>> increasing([2, 3, 5], "level")
    (2, 3, 5)
    >>> increasing([2, 2], "level")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: level must increase; 2 comes after 2
    """
    found = tuple(whole(one, f"{name} {i}", at_least=at_least) for i, one in enumerate(values, 1))
    for below, above in pairwise(found):
        if below >= above:
            raise InputError(
                "{name} must increase; {above} comes after {below}",
                name=Parameter(name),
                above=above,
                below=below,
            )
    return found


def seed_of(value: Any, name: str = "seed") -> int:
    """Return a seed: `value` if it is a whole number from 0 up, or one drawn from a generator.

    >>> seed_of(7)
    7
    >>> import numpy as np
    >>> seed_of(np.random.default_rng(1)) == seed_of(np.random.default_rng(1))
    True
    """
    if hasattr(value, "integers"):
        return int(value.integers(2**63))
    return int(_seed_or_generator(value, name))


def generator_of(value: Any, name: str = "rng") -> Generator:
    """Return a random generator: `value` itself, or one with this seed; None: a random seed.

    >>> bool(generator_of(7).integers(100) == generator_of(7).integers(100))
    True
    >>> generator_of(-1)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: rng must be a whole number, 0 or more, or a numpy.random.Generator;
        you gave -1
    """
    import numpy as np

    return np.random.default_rng(None if value is None else _seed_or_generator(value, name))


def _seed_or_generator(value: Any, name: str) -> Any:
    if hasattr(value, "integers"):
        return value
    return whole(value, name, wanted="a whole number, 0 or more, or a numpy.random.Generator")


def one_of(value: Any, name: str, choices: tuple[Choice, ...]) -> Choice:
    """Return the element of `choices` that `value` equals: 1 for 1.0 or True.

    >>> one_of(3, "first_breaker", (1, 2))
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: first_breaker must be 1 or 2; you gave 3
    """
    try:
        return choices[choices.index(value)]
    except ValueError:  # an array raises it too: its comparison is not one truth value
        *others, last = map(repr, choices)
        listed = f"{', '.join(others)} or {last}"
        raise InputError(
            "{name} must be {listed}; you gave {value!r}",
            name=Parameter(name),
            value=value,
            listed=listed,
        ) from None


def _float(value: Any) -> float:
    """Return a single number as a float, or NaN if it isn't a number."""
    if isinstance(value, str | bytes) or getattr(value, "ndim", False):
        return math.nan
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        return math.nan
