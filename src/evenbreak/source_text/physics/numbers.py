"""Every number of sections 1 to 4, beside the number that the library computes.

What is printed comes with the package (`reports.published`); `ANSWERS` says how each quantity
is computed from its inputs.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any, NamedTuple

from evenbreak.source_text.physics import collisions, deflections, equipment, natural_roll, tip
from evenbreak.source_text.physics.inputs import Answers, parse_inputs
from evenbreak.source_text.published import PublishedNumber, physics_numbers
from evenbreak.source_text.section5.numbers import deciding_tolerance

PARTS = (equipment, natural_roll, tip, collisions, deflections)
"""The modules that answer the problems."""

ANSWERS: Answers = {key: function for part in PARTS for key, function in part.ANSWERS.items()}
"""How each quantity is computed from its inputs, by problem and quantity."""


_PROBLEM = re.compile(r"(\d)\.(\d+)")


class PhysicsFinding(NamedTuple):
    """A number of the text, what is computed in its place, and the verdict.

    Parameters
    ----------
    published
        the number, as the package data have it.
    computed
        what the library computes or, for a given number, holds itself; None for a given
        number that it does not hold.
    verdict
        agrees, formula, given, erratum, derived, or differs, which should never be.
    """

    published: PublishedNumber
    computed: float | None
    verdict: str


def compute(problem: str, quantity: str, inputs: str) -> Any:
    """Return a quantity of sections 1 to 4, computed from the inputs as the text states them.

    Raises
    ------
    KeyError
        if the sections have no such quantity.

    >>> round(compute("P4.17", "theta, deg", "alpha=30deg"), 2)
    33.67
    """
    return ANSWERS[problem, quantity](parse_inputs(inputs))


def verdict_of(published: PublishedNumber, computed: float | None) -> str:
    """Return what comparing says: agrees, formula, given, erratum, derived or differs.

    A number that is within its tolerance keeps the verdict of the package data, if that is
    agrees, formula or given; an erratum that turns out right agrees.
    """
    if published.printed is None:
        return "derived"
    if computed is None:
        return "given" if published.verdict == "given" else "differs"
    near = abs(computed - float(published.printed)) <= float(deciding_tolerance(published))
    if published.verdict == "erratum":
        return "agrees" if near else "erratum"
    return published.verdict if near else "differs"


@cache
def physics_findings() -> tuple[PhysicsFinding, ...]:
    """Return every number of sections 1 to 4 with its computed value, in the order of the text.

    >>> finding = physics_findings()[0]
    >>> finding.published.quantity, finding.computed, finding.verdict
    ('diameter, in', 2.25, 'given')
    """
    return tuple(map(_found, physics_numbers()))


def place_of(where: str) -> tuple[int, int]:
    """Return the section and the number of the first problem that a place names.

    >>> place_of("P4.3 and P4.10"), place_of("Section 2"), place_of("Exercise 2.1")
    ((4, 3), (2, 0), (2, 2))
    """
    if where.startswith("Section "):
        return int(where.removeprefix("Section ")), 0
    if where.startswith("Exercise "):
        return 2, 2  # It stands after P2.2, whose numbers it needs.
    section, number = _PROBLEM.findall(where)[0]
    return int(section), int(number)


def _found(published: PublishedNumber) -> PhysicsFinding:
    known = published.verdict != "given" or published[:2] in ANSWERS
    computed = float(compute(*published[:3])) if known else None
    return PhysicsFinding(published, computed, verdict_of(published, computed))
