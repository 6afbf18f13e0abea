"""Systems of one's own: a class by its module, or by an entry point of another package."""

from __future__ import annotations

import inspect
from importlib import import_module
from importlib.metadata import entry_points
from typing import Any

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.laws import broken_laws
from evenbreak.handicaps.systems.system import System

GROUP = "evenbreak.systems"
"""The entry points by which packages add systems."""


def own_system(name: str) -> System:
    """Return the system of a class (or an instance) named as `module:Class`.

    The module is code that is run, so only a user names one, never a file.

    Raises
    ------
    InputError
        if there is no such module or class, or what it makes does not hold to `broken_laws`.

    >>> own_system("evenbreak.handicaps.systems.none:NoHandicap").name
    'none'
    """
    module, _, attribute = name.partition(":")
    try:
        made = getattr(import_module(module), attribute)
    except ImportError as error:
        raise InputError(
            "system is {name!r}, but {error}; start in the folder of {module}.py, or install it",
            name=name,
            error=str(error),
            module=module,
        ) from None
    except AttributeError:
        raise InputError(
            "system is {name!r}, but {module} has no {attribute}; name a class of it",
            name=name,
            module=module,
            attribute=attribute,
        ) from None
    return _checked(name, made)


def added_systems() -> dict[str, Any]:
    """Return the entry points of installed packages, by the names of their systems."""
    return {point.name.lower(): point for point in entry_points(group=GROUP)}


def added_system(name: str, point: Any) -> System:
    """Return the system of an entry point."""
    return _checked(name, point.load())


def _checked(name: str, made: Any) -> System:
    """Return a system that holds to the laws, or refuse it by the first that it breaks."""
    if inspect.isclass(made) and issubclass(made, System):
        lacking = sorted(getattr(made, "__abstractmethods__", ()))
        if lacking:
            raise InputError(
                "system is {name!r}, a class without {lacking}; write it",
                name=name,
                lacking=" and ".join(lacking),
            )
    try:
        system = made() if callable(made) else made
    except TypeError as error:
        raise InputError(
            "system is {name!r}, which cannot be made without arguments ({error}); give each a "
            "default",
            name=name,
            error=str(error),
        ) from None
    if not isinstance(system, System):
        raise InputError(
            "system is {name!r}, which is no System; let the class be one: class {short}(System)",
            name=name,
            short=getattr(made, "__name__", "Mine"),
        )
    if not isinstance(getattr(system, "name", None), str):
        raise InputError("system is {name!r}, whose systems have no name; give it one", name=name)
    broken = broken_laws(system)
    if broken:
        raise InputError("system is {name!r}: {broken}", name=name, broken=broken[0])
    return system
