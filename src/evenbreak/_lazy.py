"""Public names that load their module on first use (PEP 562)."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Mapping, Sequence
from types import ModuleType
from typing import Any

__all__ = ["attach"]


def attach(
    package: str, names: Mapping[str, Sequence[str]]
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return the `__getattr__`, `__dir__` and `__all__` of a package that exports lazily.

    Parameters
    ----------
    package
        the package's `__name__`.
    names
        the public names of each module, by the module's name relative to the package.

    >>> __getattr__, __dir__, __all__ = attach("evenbreak", {"errors": ["InputError"]})
    >>> __getattr__("InputError").__name__
    'InputError'
    """
    home = {name: module for module, listed in names.items() for name in listed}

    class Package(ModuleType):
        def __setattr__(self, name: str, value: Any) -> None:
            # Importing the module draw sets draw in its package, which would hide the
            # function draw: the public name wins, whatever was imported first.
            if isinstance(value, ModuleType) and home.get(name) == name:
                value = getattr(value, name)
            super().__setattr__(name, value)

    sys.modules[package].__class__ = Package

    def load(name: str) -> Any:
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(f"{package}.{home[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    return load, lambda: sorted(home), sorted(home)
