"""Checks of arrays, their shapes and columns; numpy is imported only for an array."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, overload

from evenbreak.checks.limits import Limits
from evenbreak.checks.numbers import number_probability
from evenbreak.errors import InputError
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from fractions import Fraction

    import numpy as np
    from numpy.typing import ArrayLike, DTypeLike, NDArray

    from evenbreak.arrays import Floats

_WANTED = {
    "i": "whole numbers",
    "b": "True or False",
    "M": "days of the years 1 to 9999, such as 2026-01-31",
    "O": "text, '' where there is none",
}
"""The values that a column of each dtype must hold."""


@overload
def probability(value: float | Fraction, name: str) -> float: ...


@overload
def probability(value: Sequence[Any], name: str) -> Floats: ...


@overload
def probability(value: Any, name: str) -> Any: ...


def probability(value: Any, name: str) -> Any:
    """Return `value` as a float if it is one probability, as an array if it holds several.

    Parameters
    ----------
    value
        anything that numpy can convert to a float array.
    name
        the value's name in the error.

    Raises
    ------
    InputError
        if a value is not a number from 0 to 1.

    >>> probability(1, "p"), probability([0, 0.5], "p")
    (1.0, array([0. , 0.5]))
    >>> probability(1.5, "p")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: p must be a number from 0 to 1; you gave 1.5
    """
    if hasattr(value, "__len__") or hasattr(value, "ndim"):
        return plain(floats(value, name, low=0.0, high=1.0))
    return number_probability(value, name)


def floats(
    values: Any,
    name: str,
    *,
    low: float = -math.inf,
    high: float = math.inf,
    above: float = -math.inf,
    below: float = math.inf,
    wanted: str = "",
) -> Floats:
    """Return `values` as a float array if all of them are finite and within the limits.

    Parameters
    ----------
    values
        a number, or anything that numpy can convert to a float array, except strings. A single
        number becomes a zero-dimensional array, which `plain` turns back into a float.
    name, low, high, above, below, wanted
        as for `number`.

    Raises
    ------
    InputError
        if a value is not such a number.

    >>> floats([3, 4.5], "speed", low=0)
    array([3. , 4.5])
    >>> floats([3, -1], "speed", low=0)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: speed must be finite numbers, 0 or more; it holds -1.0
    """
    array, limits = _array(values), Limits(low, high, above, below)
    # The smallest and the largest are enough: NaN and infinity show in them.
    if array.size and not limits.hold(array.min(), array.max()):
        many = array.ndim > 0
        wrong = next(x for x in array.flat if not limits.hold(x, x))
        held = f"holds {wrong}" if many else f"is {values!r}"
        raise InputError(
            "{name} must be {what}; it {held}",
            name=Parameter(name),
            held=held,
            what=wanted or limits.numbers(many=many),
        )
    return array


def whole_numbers(
    values: Any, name: str, *, at_least: int | None = None, wanted: str = ""
) -> Floats:
    """Return `values` as a float array if all are whole numbers of at least `at_least`.

    >>> whole_numbers([1, 2.0], "n")
    array([1., 2.])
    >>> whole_numbers([1, 2.5], "n", at_least=0)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: n must be whole numbers, 0 or more; it holds 2.5
    """
    least = -math.inf if at_least is None else at_least
    wanted = wanted or "whole numbers" + ("" if at_least is None else f", {at_least} or more")
    array = floats(values, name, low=least, wanted=wanted)
    broken = array != array.round()
    if broken.any():
        held = f"holds {float(array[broken][0])!r}" if array.ndim else f"is {values!r}"
        raise InputError(
            "{name} must be {wanted}; it {held}", name=Parameter(name), held=held, wanted=wanted
        )
    return array


def column(values: Any, name: str, count: int, each: str, dtype: DTypeLike = float) -> NDArray[Any]:
    """Return a read-only copy of `values`, one value for each player, row or match.

    It is a copy, so later changes to the caller's array have no effect. NaN and infinity are
    allowed if `dtype` is float.

    Parameters
    ----------
    name
        their name in the error.
    count, each
        how many values there must be, and of what: 3, 'players'.
    dtype
        float, int (floats pass if they are whole numbers), bool (0 and 1 pass), days (as dates or
        as strings such as 2026-01-31, NaT or None for no date), or object, for strings.

    Raises
    ------
    InputError
        if the values do not have this type, or there are more or fewer of them.

    >>> column([80.5, 92], "rating", 3, "players")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: rating must have one value for each of 3 players; its shape is (2,)
    >>> column(["no", "yes"], "forfeit", 2, "rows", bool)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: forfeit must be True or False; you gave ['no', 'yes']
    """
    import numpy as np

    kind = np.dtype(dtype)
    try:
        with np.errstate(invalid="ignore"):  # NaN becomes some int, and then differs
            found = _converted(values, kind)
    except (TypeError, ValueError, OverflowError):
        found = None
    if found is None:
        raise InputError(
            "{name} must be {kind}; you gave {values!r}",
            name=Parameter(name),
            values=values,
            kind=_WANTED.get(kind.kind, "numbers"),
        )
    if found.shape != (count,):
        raise InputError(
            "{name} must have one value for each of {count} {each}; its shape is {found_shape}",
            name=Parameter(name),
            found_shape=found.shape,
            count=count,
            each=each,
        )
    found.flags.writeable = False
    return found


def names(values: Iterable[Any], name: str) -> tuple[str, ...]:
    """Return `values` as a tuple if they are distinct strings.

    >>> names(["Ann", float("nan")], "players")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: players must be names; it holds nan, which isn't text
    """
    found = tuple(values)
    for value in found:
        if not isinstance(value, str):
            raise InputError(
                "{name} must be names; it holds {value!r}, which isn't text",
                name=Parameter(name),
                value=value,
            )
    if len(set(found)) < len(found):
        raise InputError("{name} must have each name once; one appears twice", name=Parameter(name))
    return found


def together(**arrays: ArrayLike) -> tuple[int, ...]:
    """Return the broadcast shape of the arrays; numbers have the shape ().

    Raises
    ------
    InputError
        if they do not broadcast; it names each array and its shape.

    >>> together(p=0.5, m=[1, 2, 3])
    (3,)
    >>> together(p=0.5, m=[1, 2], n=[1, 2, 3])
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: shapes must broadcast; m has shape (2,), n has shape (3,)
    """
    arrays = {name: array for name, array in arrays.items() if hasattr(array, "__len__")}
    if not arrays:
        return ()
    import numpy as np

    shapes = {name: shape for name, array in arrays.items() if (shape := np.shape(array))}
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        held = ", ".join(f"{name} has shape {shape}" for name, shape in shapes.items())
        raise InputError("shapes must broadcast; {held}", held=held) from None


def plain(array: Any) -> Any:
    """Return a float for a number or a zero-dimensional array, any other array unchanged.

    >>> import numpy as np
    >>> plain(np.array(2.5)), plain(np.array([2.5]))
    (2.5, array([2.5]))
    """
    return array if getattr(array, "ndim", 0) else float(array)


def _converted(values: Any, kind: np.dtype[Any]) -> NDArray[Any] | None:
    """Return a copy of `values` as this type, or None if that would change their meaning."""
    import numpy as np

    if kind.kind == "O":
        texts = np.array(values, dtype=object)
        return texts if all(isinstance(text, str) for text in texts.flat) else None
    given = _unmasked(values)
    # numpy would read text as numbers, and drop imaginary parts.
    if given.size and given.dtype.kind not in ("MUO" if kind.kind == "M" else "biufO"):
        return None
    found = np.array(given, dtype=kind)
    if kind.kind == "M":
        years = found.astype("datetime64[Y]").astype(int) + 1970
        in_range = np.isnat(found) | ((years >= 1) & (years <= 9999))
        # numpy counts a number as days from 1970.
        numeric = given.dtype.kind == "O" and any(isinstance(day, int) for day in given.flat)
        return found if in_range.all() and not numeric else None
    if kind.kind == "f":
        text = given.dtype.kind == "O" and any(isinstance(value, str) for value in given.flat)
        return None if text else found
    return found if bool((found == given).all()) else None


def _array(values: Any) -> Floats:
    """Return `values` as a float array, with NaN for values that are not numbers."""
    import numpy as np

    try:
        array = _unmasked(values)
        if array.dtype.kind in "biufO":  # else numpy reads text and drops imaginary parts
            return array.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError):
        pass
    return np.array(math.nan)


def _unmasked(values: Any) -> NDArray[Any]:
    """Return `values` as an array, with NaN for masked values."""
    import numpy as np

    if np.ma.is_masked(values):
        return np.asarray(values.astype(float).filled(math.nan))
    return np.asarray(values)
