"""Values made from plain data, such as JSON, as the annotations of classes say."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin, get_type_hints

from evenbreak.errors import InputError
from evenbreak.words import Parameter

Kind = TypeVar("Kind")

_LARGEST = 10**9
_WORDS = {str: "text", bool: "true or false", NoneType: "null"}


@dataclass(frozen=True)
class Between:
    """Where a number must lie, both ends included; it stands in an annotation."""

    least: float
    most: float


def made(kind: type[Kind], data: Any, name: str = "") -> Kind:
    """Return a value of a class from plain data.

    Parameters
    ----------
    kind
        a dataclass or a named tuple. Its annotations are of such classes again, text, numbers,
        `bool`, tuples, sequences, mappings, and unions of these.
    data
        a dictionary with a value for each field that has no default, or for a named tuple a list.
    name
        what the data is called in messages; '' for its fields alone.

    Raises
    ------
    InputError
        if a field is missing, unknown, not of its kind, or outside its limits.

    >>> @dataclass(frozen=True)
    ... class Score:
    ...     match: str
    ...     games: tuple[Annotated[int, Between(0, 100)], ...]
    >>> made(Score, {"match": "F", "games": [5, 3]})
    Score(match='F', games=(5, 3))
    >>> made(Score, {"match": "F", "games": [5, 10**30]})
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: games 2 is 1000000000...0000000000; give a whole number from 0 to
    100
    """
    found: Kind = _value(kind, data, name)
    return found


def _value(kind: Any, data: Any, name: str, limits: Between | None = None) -> Any:
    origin, parts = get_origin(kind), get_args(kind)
    if origin is Annotated:
        limits = next((said for said in parts[1:] if isinstance(said, Between)), None)
        return _value(parts[0], data, name, limits)
    if origin in (Union, UnionType):
        return _one_of(parts, data, name)
    if kind in (int, float):
        return _number(kind, data, name, limits or Between(-_LARGEST, _LARGEST))
    if kind in _WORDS:
        if type(data) is not kind or (kind is str and not _can_be_written(data)):
            raise _not(data, name, _WORDS[kind])
        return data
    if is_dataclass(kind):
        return _fields(kind, data, name)
    if hasattr(kind, "_fields"):
        hints = _hints(kind)
        return kind(*_items([hints[one] for one in kind._fields], data, name))
    if origin is tuple and parts[-1] is not Ellipsis:
        return _items(parts, data, name)
    if origin is Mapping:
        if not isinstance(data, Mapping):
            raise _not(data, name, "names and values")
        return {key: _value(parts[1], one, f"{name} {key}") for key, one in data.items()}
    assert origin in (tuple, Sequence), kind  # noqa: S101 - of a class in this package
    return _items([parts[0]] * len(_listed(data, name)), data, name)


def _can_be_written(text: str) -> bool:
    """Return whether a text is no half of a letter, as JSON may hold one."""
    return not any("\ud800" <= letter <= "\udfff" for letter in text)


def _one_of(kinds: Sequence[Any], data: Any, name: str) -> Any:
    """Return a value of one of several kinds."""
    if data is None and NoneType in kinds:
        return None
    others = [kind for kind in kinds if kind is not NoneType]
    for kind in others[:-1]:
        try:
            return _value(kind, data, name)
        except InputError:
            continue
    return _value(others[-1], data, name)


def _number(kind: type[int] | type[float], data: Any, name: str, limits: Between) -> float:
    whole = kind is int
    if (
        isinstance(data, bool)
        or not isinstance(data, int if whole else int | float)
        or not limits.least <= data <= limits.most
    ):
        what = "a whole number" if whole else "a number"
        raise _not(data, name, f"{what} from {limits.least:,.15g} to {limits.most:,.15g}")
    return data if whole else float(data)


def _fields(kind: Any, data: Any, name: str) -> Any:
    if not isinstance(data, Mapping):
        raise _not(data, name, "names and values")
    hints, prefix = _hints(kind), f"{name} " if name else ""
    if unknown := [key for key in data if key not in hints]:
        raise InputError(
            "{prefix}{unknown} is not known; leave it out",
            prefix=prefix,
            unknown=reprlib.repr(unknown[0]),
        )
    needed = [one.name for one in fields(kind) if one.default is MISSING is one.default_factory]
    if missing := [key for key in needed if key not in data]:
        raise InputError("{prefix}{missing} is missing; add it", prefix=prefix, missing=missing[0])
    values = {key: _value(hints[key], one, f"{prefix}{key}") for key, one in data.items()}
    return kind(**values)


def _items(kinds: Sequence[Any], data: Any, name: str) -> tuple[Any, ...]:
    if len(_listed(data, name)) != len(kinds):
        raise _not(data, name, f"a list of {len(kinds)}")
    pairs = enumerate(zip(kinds, data, strict=True), 1)
    return tuple(_value(kind, one, f"{name} {k}") for k, (kind, one) in pairs)


def _listed(data: Any, name: str) -> Sequence[Any]:
    if not isinstance(data, list | tuple):
        raise _not(data, name, "a list")
    return data


def _not(data: Any, name: str, wanted: str) -> InputError:
    shown = "NaN" if isinstance(data, float) and math.isnan(data) else reprlib.repr(data)
    return InputError(
        "{what} is {shown}; give {wanted}", what=Parameter(name or "it"), shown=shown, wanted=wanted
    )


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind, include_extras=True)
