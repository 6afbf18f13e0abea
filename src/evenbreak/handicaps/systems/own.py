"""Custom systems: classes given by their modules, and systems added by installed packages."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.laws import broken_laws
from evenbreak.handicaps.systems.system import System
from evenbreak.plugins import lawful, made, why


def own_system(name: str) -> System:
    """Return the system from a class (or an instance) named `module:Class`.

    The module's code is run, so only a user may name one, never a file.

    Raises
    ------
    InputError
        if there is no such module or class, or the resulting system breaks a rule (see
        `broken_laws`).

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
    """Return a system that follows the rules, or raise an error for the first it breaks."""
    if not isinstance(system, System):
        raise InputError(
            "it isn't a System. Derive its class from System: class {short}(System).",
            short=type(system).__name__,
        )
    if not isinstance(getattr(system, "name", None), str):
        raise InputError("its systems have no name. Give the class a name.")
    lawful(system, broken_laws(system))
    return system
