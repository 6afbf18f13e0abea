"""How each number in the text is computed, and how it compares with the printed one."""

from __future__ import annotations

from functools import cache
from typing import Any

from evenbreak.source_text.physics import section_3, section_4, sections_1_2
from evenbreak.source_text.published import (
    Answers,
    Derived,
    Finding,
    find,
    parse_inputs,
    physics_numbers,
    published_numbers,
)
from evenbreak.source_text.section5 import chains, games, samples

PHYSICS = (sections_1_2, section_3, section_4)
"""The modules that answer the problems in sections 1 to 4."""

SECTION_5 = (samples, games, chains)
"""The modules that answer the problems in section 5."""

ANSWERS: Answers = {
    key: answer for part in (*PHYSICS, *SECTION_5) for key, answer in part.ANSWERS.items()
}
"""How each quantity is computed from its inputs, by problem and quantity."""

DERIVED: Derived = {key: rows for part in SECTION_5 for key, rows in part.DERIVED.items()}
"""The rows for each section 5 problem beyond the numbers that the text prints."""


def compute(problem: str, quantity: str, inputs: str) -> Any:
    """Return a quantity in the text, computed from the inputs as the text states them.

    Raises KeyError if the text has no such quantity.

    >>> compute("P5.5", "P(3:0)", "p=2/3"), round(compute("P4.17", "theta, deg", "alpha=30deg"), 2)
    (Fraction(8, 27), 33.67)
    """
    return ANSWERS[problem, quantity](parse_inputs(inputs))


@cache
def physics_findings() -> tuple[Finding, ...]:
    """Return every number in sections 1 to 4 with its computed value, in the order of the text.

    >>> finding = physics_findings()[0]
    >>> finding.published.quantity, finding.computed, finding.verdict
    ('diameter, in', 2.25, 'given')
    """
    return tuple(find(physics_numbers(), ANSWERS))


@cache
def section_5_findings() -> tuple[Finding, ...]:
    """Return every number in section 5 with its computed value, in the order of the text."""
    return tuple(find(published_numbers(), ANSWERS))
