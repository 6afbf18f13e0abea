"""All systems, and how they are named."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.elo import elo_system
from evenbreak.handicaps.systems.fixed import fixed_length_system
from evenbreak.handicaps.systems.margin import margin_system
from evenbreak.handicaps.systems.npl import NPL
from evenbreak.handicaps.systems.step import step_system
from evenbreak.handicaps.systems.system import System

_NUMBER = re.compile(r"[0-9]{1,9}")


class _Family(NamedTuple):
    """Systems that differ only in numbers.

    Parameters
    ----------
    grammar
        how their names are written.
    make
        the function that makes one of them from its numbers.
    numbers
        the fewest and the most numbers that it takes.
    samples
        the numbers of those that the contract tests try.
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
    }
)
"""The families of systems, by the word with which their names begin."""

SYSTEMS: Mapping[str, System] = MappingProxyType(
    {
        system.name: system
        for family in FAMILIES.values()
        for system in (family.make(*numbers) for numbers in family.samples)
    }
)
"""The samples of every family, by name."""


def system_of(name: Any) -> System:
    """Return the system of this name: a word, and then its numbers.

    Parameters
    ----------
    name
        a word of `FAMILIES` and the numbers of its grammar, set apart by blanks or hyphens, in
        any case: 'npl', 'step 2', 'step-2-1'. A `System` is returned as it is.

    Raises
    ------
    InputError
        if it names no system.

    >>> system_of("npl").charts
    ('npl_8', 'npl_10', 'npl_12', 'npl_20')
    >>> system_of("step 3").name
    'step 3'
    """
    if isinstance(name, System):
        return name
    word, *numbers = re.split(r"\s+|-", str(name).strip().lower())
    family = FAMILIES.get(word)
    if family is None:
        *listed, last = (entry.grammar for entry in FAMILIES.values())
        raise InputError(
            "system is {name!r}; give {listed} or {last}",
            name=name,
            listed=", ".join(listed),
            last=last,
        )
    fewest, most = family.numbers
    if not fewest <= len(numbers) <= most or not all(_NUMBER.fullmatch(each) for each in numbers):
        whole = ", in whole numbers" if most else ""
        raise InputError(
            "system is {name!r}; write it as {grammar}{whole}",
            name=name,
            grammar=family.grammar,
            whole=whole,
        )
    try:
        return family.make(*map(int, numbers))
    except InputError as error:
        raise InputError("system is {name!r}: {error}", name=name, error=error) from None


def steps_of(name: Any) -> StepSystem:
    """Return the system of this name if it moves ratings match by match, by whole points.

    Raises
    ------
    InputError
        if it names no system, or one without such a rule.
    """
    system = system_of(name)
    if not isinstance(system, StepSystem):
        raise InputError(
            "the system {name} does not move ratings by whole points match by match, so there is "
            "no chain to follow here; `evenbreak simulate` plays seasons of it",
            name=system.name,
        )
    return system
