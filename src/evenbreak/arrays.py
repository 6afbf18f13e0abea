"""The arrays that functions take and return, by what they hold, and how values show them."""

from dataclasses import fields
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Places = NDArray[np.intp]
"""Positions in other arrays."""

Bools = NDArray[np.bool_]

Class = TypeVar("Class", bound=type)
_LONGEST = 60


def short_repr(cls: Class) -> Class:
    """Let a dataclass say how large its arrays are, instead of printing them.

    >>> from dataclasses import dataclass
    >>> @short_repr
    ... @dataclass
    ... class Scores:
    ...     player: str
    ...     games: Ints
    >>> Scores("Ann", np.arange(300))
    Scores(player='Ann', games=<300 values>)
    """
    setattr(cls, "__repr__", _short_repr)  # noqa: B010  mypy refuses to assign a method
    return cls


def _short_repr(value: Any) -> str:
    shown = (f"{f.name}={_short(getattr(value, f.name))}" for f in fields(value) if f.repr)
    return f"{type(value).__name__}({', '.join(shown)})"


def _short(value: Any) -> str:
    shape = getattr(value, "shape", ())
    if shape:
        return f"<{' x '.join(map(str, shape))} values>"
    text = repr(value)
    if "array(" in text:
        return f"<{type(value).__name__}>"
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
