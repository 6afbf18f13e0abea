"""Systems, charts and games from installed packages, available by name to every command.

A package declares them as entry points of the groups `evenbreak.systems`, `evenbreak.charts` and
`evenbreak.games`. Built-in names take precedence, and only the package that has the name is
imported, so a broken package does not affect others.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Literal

from evenbreak.errors import EvenbreakError, InputError

Kind = Literal["system", "chart", "game"]


def added(kind: Kind) -> dict[str, str]:
    """Return the package of each added system, chart or game, by name, without importing any."""
    return {point.name: package_of(point) for point in _points(kind)}


def plugin(kind: Kind, name: str, admit: Callable[[Any], Any], *arguments: Any) -> Any:
    """Return the object that an installed package adds under a name, or None if no package has it.

    Parameters
    ----------
    kind
        the kind of object.
    name
        its name; spaces, hyphens, underscores and case do not matter.
    admit
        function that takes an object that a package adds and returns it, or raises an error for a
        rule that it breaks.
    arguments
        for the class or function that makes the object.

    Raises
    ------
    InputError
        if the package cannot be imported, its object breaks a rule, or two packages have the name.
    """
    points = [point for point in _points(kind) if plain(point.name) == plain(name)]
    if not points:
        return None
    if len(points) > 1:
        raise InputError(
            "{kind} is {name!r}, which both {packages} provide. Uninstall one of them.",
            kind=kind,
            name=name,
            packages=" and ".join(map(package_of, points[:2])),
        )
    try:
        return _admitted(points[0], admit, arguments)
    except (Exception, SystemExit) as error:
        raise InputError(
            "{kind} {name!r} of package {package}: {why}",
            kind=kind,
            name=name,
            package=package_of(points[0]),
            why=why(error),
        ) from error


def made(named: Any, *arguments: Any) -> Any:
    """Return the result of calling a class or function, or the object itself if it is neither.

    Raises
    ------
    InputError
        if the arguments don't fit, or a class lacks methods.

    >>> made(dict, [("a", 1)]), made(3)
    ({'a': 1}, 3)
    """
    if not callable(named):
        if arguments:
            raise InputError("it's already complete and takes no chances. Leave them out.")
        return named
    if lacking := sorted(getattr(named, "__abstractmethods__", ())):
        raise InputError(
            "the class has no {lacking}. Add what's missing.", lacking=" and ".join(lacking)
        )
    try:
        inspect.signature(named).bind(*arguments)
    except TypeError as error:
        raise InputError(
            "it takes different chances ({error}). Give those."
            if arguments
            else "it can't be made without arguments ({error}). Give each parameter a default.",
            error=str(error),
        ) from None
    except ValueError:  # what is written in C may not say what it takes
        pass
    return named(*arguments)


def broken_of(laws: Iterable[Callable[[], Iterable[str]]]) -> list[str]:
    """Return the rules that are broken, as sentences, up to the first rule that raises an error.

    >>> broken_of([lambda: [], lambda: ["it is late"], lambda: 1 / 0, lambda: ["never asked"]])
    ['it is late', 'it failed with ZeroDivisionError: division by zero']
    """
    broken: list[str] = []
    for law in laws:
        try:
            broken += law()
        except Exception as error:
            return [*broken, why(error)]
    return broken


def lawful(value: Any, broken: Sequence[str]) -> Any:
    """Return a value that breaks no rule, or raise an error for the first rule that it breaks."""
    if broken:
        raise InputError("{sentence}", sentence=broken[0])
    return value


def why(error: BaseException) -> str:
    """Return an error's message, with its type if the type is not from this package.

    >>> why(InputError("k is 0")), why(ImportError("No module named 'numpyy'"))
    ('k is 0', "it failed with ImportError: No module named 'numpyy'")
    """
    ours = isinstance(error, EvenbreakError)
    return str(error) if ours else f"it failed with {type(error).__name__}: {error}"


def package_of(point: EntryPoint) -> str:
    """Return an entry point's package and version."""
    return f"{point.dist.name} {point.dist.version}" if point.dist else point.value


def plain(name: str) -> str:
    """Return a name without the characters that do not matter.

    >>> plain(" Last_Ten")
    'last ten'
    """
    return re.sub(r"[-_\s]+", " ", name.strip().lower())


@cache
def _admitted(point: EntryPoint, admit: Callable[[Any], Any], arguments: tuple[Any, ...]) -> Any:
    return admit(made(point.load(), *arguments))


def _points(kind: Kind) -> list[EntryPoint]:
    return sorted(entry_points(group=f"evenbreak.{kind}s"), key=lambda point: point.name)
