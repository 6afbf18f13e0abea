"""The catalog of all systems, and their names."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from types import MappingProxyType
from typing import Any, NamedTuple, cast

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.averages import Averages, WinPercent
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.elo import elo_system
from evenbreak.handicaps.systems.fargo_like import FargoLike
from evenbreak.handicaps.systems.level_review import LevelReview, apa_like, tap_like
from evenbreak.handicaps.systems.level_steps import level_steps
from evenbreak.handicaps.systems.napa_like import NapaLike
from evenbreak.handicaps.systems.none import NoHandicap
from evenbreak.handicaps.systems.npl import NPL
from evenbreak.handicaps.systems.step import fixed_length_system, margin_system, step_system
from evenbreak.handicaps.systems.system import System

_NUMBER = re.compile(r"[0-9]{1,9}")


class _Family(NamedTuple):
    """Systems that differ only in numbers, whose place in the name `grammar` shows.

    `numbers` is the fewest and the most numbers that `make` takes, and `samples` are the numbers
    used in the contract tests.
    """

    grammar: str
    make: Callable[..., System]
    numbers: tuple[int, int]
    samples: tuple[tuple[int, ...], ...] = ((),)


FAMILIES: Mapping[str, _Family] = MappingProxyType(
    {
        "npl": _Family("npl", lambda: NPL, (0, 0)),
        "step": _Family("step UP [DOWN]", step_system, (1, 2), ((2,), (2, 1))),
        "margin": _Family("margin [MOST]", margin_system, (0, 1)),
        "elo": _Family("elo [K]", elo_system, (0, 1)),
        "fixed": _Family("fixed [GAMES]", fixed_length_system, (0, 1)),
        "none": _Family("none [GAMES]", NoHandicap, (0, 1)),
        "fargo-like": _Family("fargo-like", FargoLike, (0, 0)),
        "level-review": _Family("level-review", LevelReview, (0, 0)),
        "apa-like": _Family("apa-like", apa_like, (0, 0)),
        "tap-like": _Family("tap-like", tap_like, (0, 0)),
        "level-steps": _Family("level-steps [STEPS]", level_steps, (0, 1)),
        "averages": _Family("averages", Averages, (0, 0)),
        "win-percent": _Family("win-percent", WinPercent, (0, 0)),
        "napa-like": _Family("napa-like", NapaLike, (0, 0)),
    }
)
"""Families of systems, by the first word of their names."""

SYSTEMS: Mapping[str, System] = MappingProxyType(
    {
        system.name: system
        for family in FAMILIES.values()
        for system in (family.make(*numbers) for numbers in family.samples)
    }
)
"""The samples from every family, by name."""


def system_of(name: Any) -> System:
    """Return a system by name: its words, followed by its numbers or parameters.

    Parameters
    ----------
    name
        a name in `FAMILIES` and the numbers in its grammar, separated by spaces or hyphens, in any
        case: 'npl', 'step 2', 'step-2-1'. Systems with open parameters take them by name:
        'level-review window=15 kept=.5'. The systems of installed packages (entry points
        `evenbreak.systems`) are found by their own names. A `System` is returned unchanged.

    Raises
    ------
    InputError
        if there is no such system.

    >>> system_of("npl").charts
    ('npl_8', 'npl_10', 'npl_12', 'npl_20')
    >>> system_of("step 3").name
    'step 3'
    >>> system_of("level review window=15").window
    15
    """
    if isinstance(name, System):
        return name
    written = name.strip().lower() if isinstance(name, str) else ""
    word, rest = _in_parts(written)
    if not is_ours(written):
        return _added(name, written, word)
    options = dict(part.split("=", 1) for part in rest if "=" in part)
    try:
        system = FAMILIES[word].make(*(int(part) for part in rest if "=" not in part))
        return _with_options(system, options, " ".join([word, *rest])) if rest else system
    except InputError as error:
        raise InputError("system is {name!r}: {error}", name=name, error=error) from None


def is_ours(written: str) -> bool:
    """Return whether a name is a built-in one: its words, followed by fitting numbers.

    >>> is_ours("step-2"), is_ours("elo-club")
    (True, False)
    """
    word, rest = _in_parts(written)
    numbers = [part for part in rest if "=" not in part]
    fewest, most = FAMILIES[word].numbers if word else (1, 0)
    return fewest <= len(numbers) <= most and all(map(_NUMBER.fullmatch, numbers))


def _in_parts(written: str) -> tuple[str, list[str]]:
    """Return the built-in word that a name starts with, if any, and the parts after it."""
    written = written.strip().lower()
    word = next((word for word in _BY_LENGTH if _spelled(word).match(written)), "")
    return word, re.split(r"\s+|(?<![=e])-", written[len(word) :])[1:]


_BY_LENGTH = sorted(FAMILIES, key=len, reverse=True)


def _spelled(word: str) -> re.Pattern[str]:
    """Return the ways to write a name: with spaces, hyphens or underscores."""
    return re.compile(word.replace("-", r"[\s_-]") + r"(?![^\s-])")


def _with_options(system: System, options: Mapping[str, str], name: str) -> System:
    """Return a system with parameters set by name, under the name that was asked for."""
    if isinstance(system, StepSystem):
        if options:
            raise InputError("it has no named parameters. Leave out {first}=.", first=min(options))
        return system
    known = [
        field.name
        for field in fields(cast("Any", system))
        if field.name not in ("name", "own_chart")
    ]
    values = {}
    for option, text in options.items():
        if option not in known:
            raise InputError(
                "{option} isn't one of its parameters: {known}",
                option=option,
                known=", ".join(known),
            )
        values[option] = _value(option, text, getattr(system, option))
    return cast("System", replace(cast("Any", system), **values, name=name))


def _value(option: str, text: str, usual: Any) -> Any:
    """Parse a parameter's value; 'none' if it may be left out."""
    if text == "none":
        return None
    if isinstance(usual, str):
        return text
    if isinstance(usual, bool):
        return text in ("1", "yes", "true")
    try:
        return float(text) if isinstance(usual, float) else int(text)
    except ValueError:
        raise InputError(
            "{option} must be a number; you gave {text!r}", option=option, text=text
        ) from None


def _added(name: Any, written: str, word: str) -> System:
    """Return an installed package's system, or raise an error if no package has the name."""
    from evenbreak.handicaps.systems.own import lawful_system
    from evenbreak.plugins import added, plugin

    if (system := plugin("system", written, lawful_system)) is not None:
        return cast("System", system)
    if word:
        raise InputError(
            "system is {name!r}. Write it as {grammar}{whole}.",
            name=name,
            grammar=FAMILIES[word].grammar,
            whole=", in whole numbers" if FAMILIES[word].numbers[1] else "",
        )
    *listed, last = [*(family.grammar for family in FAMILIES.values()), *added("system")]
    raise InputError(
        "system must be {listed} or {last}; you gave {name!r}",
        name=name,
        listed=", ".join(listed),
        last=last,
    )


def steps_of(name: Any) -> StepSystem:
    """Return a system by name if it moves ratings match by match, by whole points.

    Raises
    ------
    InputError
        if it names no system, or one without such a rule.
    """
    system = system_of(name)
    if not isinstance(system, StepSystem):
        raise InputError(
            "the system {name} doesn't move ratings by whole points after every match, so "
            "there's no chain to follow here. To simulate seasons with it, use `evenbreak "
            "simulate --compare`.",
            name=system.name,
        )
    return system
