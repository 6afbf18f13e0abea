"""Checks of types, for functions that take an object rather than a number."""

from __future__ import annotations

from typing import Any, TypeVar

from evenbreak.errors import InputError
from evenbreak.words import Parameter

Kind = TypeVar("Kind")


def kind_of(value: Any, name: str, kind: type[Kind]) -> Kind:
    """Return `value` if it has this type.

    Parameters
    ----------
    name
        the value's name in the error.

    Raises
    ------
    InputError
        if it has another type.

    >>> from fractions import Fraction
    >>> kind_of(Fraction(1, 2), "p", Fraction)
    Fraction(1, 2)
    >>> kind_of(0.5, "p", Fraction)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: p must be a Fraction; you gave 0.5
    """
    if not isinstance(value, kind):
        raise InputError(
            "{name} must be a {name_2}; you gave {value!r}",
            name=Parameter(name),
            value=value,
            name_2=kind.__name__,
        )
    return value


def kind_or_usual(value: Any, name: str, kind: type[Kind]) -> Kind:
    """Return `value` if it has this type, or the type's default for None.

    >>> kind_or_usual(None, "size", int)
    0
    """
    return kind() if value is None else kind_of(value, name, kind)
