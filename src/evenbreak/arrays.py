"""Types of the arrays that functions take and return, and read-only arrays in dataclasses."""

from collections.abc import Callable, Mapping
from dataclasses import fields
from functools import cached_property, wraps
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Places = NDArray[np.intp]
"""Positions in other arrays."""

Bools = NDArray[np.bool_]

FloatOrArray: TypeAlias = Any
"""A number or an array of numbers, or an elementwise result.

As with numpy's own functions, a type checker accepts it as either: a float where all arguments are
numbers (`evenbreak.checks.plain`), otherwise an array of the shape to which they broadcast.
"""

Class = TypeVar("Class", bound=type)
Array = TypeVar("Array", bound=NDArray[Any])
_LONGEST = 60
_PLAIN = frozenset((type(None), bool, int, float, str))


def own_arrays(cls: Class) -> Class:
    """Make instances of a dataclass own their arrays, so that writing to one changes no answer.

    Arrays and sparse matrices passed in are copied unless they are read-only; those that an
    instance holds or caches are read-only.

    >>> from dataclasses import dataclass
    >>> @own_arrays
    ... @dataclass(frozen=True)
    ... class Scores:
    ...     games: Ints
    >>> mine = np.array([7, 5])
    >>> scores = Scores(mine)
    >>> mine[0] = 0
    >>> scores.games
    array([7, 5])
    >>> scores.games[0] = 0
    Traceback (most recent call last):
    ...
    ValueError: assignment destination is read-only
    """
    init: Any = vars(cls)["__init__"]
    names = [field.name for field in fields(cls)]

    @wraps(init)
    def owning(self: Any, *args: Any, **options: Any) -> None:
        init(self, *args, **options)
        for name in names:
            value = getattr(self, name)
            if (own := owned(value)) is not value:
                object.__setattr__(self, name, own)

    setattr(cls, "__init__", owning)  # noqa: B010  mypy refuses to assign a method
    for remembered in vars(cls).values():
        if isinstance(remembered, cached_property):
            remembered.func = _owning(remembered.func)
    return cls


def _owning(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
    @wraps(function)
    def of(self: Any) -> Any:
        return owned(function(self))

    return of


def owned(value: Any) -> Any:
    """Return arrays, or a tuple, list or mapping of them, as read-only copies; else the value."""
    if type(value) in _PLAIN:
        return value
    if isinstance(value, np.ndarray):
        return value if _is_frozen(value) else frozen(np.array(value))
    if hasattr(value, "has_canonical_format"):  # a compressed sparse matrix
        parts = [value.data, value.indices, value.indptr]
        if all(map(_is_frozen, parts)):
            return value
        copy = value.copy()
        copy.has_canonical_format  # noqa: B018  found out once, before nothing can be set
        for part in (copy.data, copy.indices, copy.indptr):
            frozen(part)
        return copy
    if isinstance(value, tuple) and all(map(_is_frozen, value)):
        return value
    if isinstance(value, (tuple, list)) and _holds(value):
        own = {id(one): owned(one) for one in value}
        parts = [own[id(one)] for one in value]  # what is one array stays one
        return value._make(parts) if hasattr(value, "_make") else type(value)(parts)
    if isinstance(value, Mapping) and value and _holds(next(iter(value.values()))):
        return {name: owned(one) for name, one in value.items()}
    return value


def _holds(value: Any) -> bool:
    """Return whether a value is an array, starts with one, or has one among its named parts."""
    if isinstance(value, tuple | list):
        return any(map(_holds, value if hasattr(value, "_make") else value[:1]))
    return isinstance(value, np.ndarray)


def _is_frozen(array: Any) -> bool:
    """Return whether this is an array that cannot be written to, directly or through a base."""
    while isinstance(array, np.ndarray) and not array.flags.writeable:
        if array.base is None:
            return True
        array = array.base
    return False


def frozen(array: Array) -> Array:
    """Return a read-only array."""
    array.flags.writeable = False
    return array


def short_repr(cls: Class) -> Class:
    """Make a dataclass's `repr` show the shapes of its arrays instead of their values.

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


def array_values(cls: Class) -> Class:
    """Make a dataclass own its arrays, with a short `repr`: `own_arrays` and `short_repr`."""
    return own_arrays(short_repr(cls))


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
