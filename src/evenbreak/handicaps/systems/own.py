"""Systems of one's own: classes by their modules, and what installed packages add."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.laws import broken_laws
from evenbreak.handicaps.systems.system import System
from evenbreak.plugins import lawful, made, why


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
        code = import_module(module)
    except ImportError as error:
        raise InputError(
            "system is {name!r}, but {error}. Start evenbreak in the folder that has "
            "{module}.py, or install {module}.",
            name=name,
            error=str(error),
            module=module,
        ) from None
    except (Exception, SystemExit) as error:
        raise InputError("system is {name!r}: {why}", name=name, why=why(error)) from error
    if not hasattr(code, attribute):
        raise InputError(
            "system is {name!r}, but {module} has no {attribute}. Name one of its classes.",
            name=name,
            module=module,
            attribute=attribute,
        )
    try:
        return lawful_system(made(getattr(code, attribute)))
    except (Exception, SystemExit) as error:
        raise InputError("system is {name!r}: {why}", name=name, why=why(error)) from error


def lawful_system(system: Any) -> System:
    """Return a system that holds to `broken_laws`, or refuse it by the first law that it breaks."""
    if not isinstance(system, System):
        raise InputError(
            "it isn't a System. Derive its class from System: class {short}(System).",
            short=type(system).__name__,
        )
    if not isinstance(getattr(system, "name", None), str):
        raise InputError("its systems have no name. Give the class a name.")
    lawful(system, broken_laws(system))
    return system
