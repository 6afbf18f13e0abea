"""Every number that section 5 prints, beside the number that the library computes.

What is printed, how exact it must be and what is said of it comes with the package
(`reports.published`); `ANSWERS` says how each quantity is computed from its inputs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from decimal import Decimal
from functools import cache
from typing import Any, NamedTuple

from evenbreak.source_text.published import PublishedNumber
from evenbreak.source_text.section5 import (
    break_formats,
    games_won,
    innings,
    long_run,
    one_ball,
    samples,
)
from evenbreak.source_text.section5.rows import Answers, parse_inputs

PARTS = (samples, games_won, innings, one_ball, break_formats, long_run)
"""The modules that answer the problems."""

ANSWERS: Answers = {key: function for part in PARTS for key, function in part.ANSWERS.items()}
"""How each quantity is computed from its inputs, by problem and quantity."""

_HOME = {
    "Table 5.1": "P5.10",
    "Table 5.2": "P5.11",
    "Table 5.3": "P5.16",
    "Table 5.4": "P5.24",
    "Table 5.5": "P5.26",
}
"""The problem that a table answers or follows."""


class Finding(NamedTuple):
    """A printed number, what is computed in its place, and the verdict."""

    published: PublishedNumber
    computed: float
    verdict: str
    """agrees, erratum, derived (nothing is printed), or differs, which should never be."""


def compute(problem: str, quantity: str, inputs: str) -> Any:
    """Return a quantity of section 5, computed from the inputs as the text states them.

    Raises
    ------
    KeyError
        if section 5 has no such quantity.

    >>> compute("P5.5", "P(3:0)", "p=2/3")
    Fraction(8, 27)
    """
    return ANSWERS[problem, quantity](parse_inputs(inputs))


def verdict_of(published: PublishedNumber, computed: float) -> str:
    """Return what comparing says: agrees, erratum, derived or differs.

    A printed number agrees if it is within `deciding_tolerance`. If it is not, it is an
    erratum where the package data call it one, and otherwise it differs.
    """
    if published.printed is None:
        return "derived"
    if abs(computed - float(published.printed)) <= float(deciding_tolerance(published)):
        return "agrees"
    return "erratum" if published.verdict == "erratum" else "differs"


def deciding_tolerance(published: PublishedNumber) -> Decimal:
    """Return the largest difference with which a number still agrees.

    That is the tolerance of the number; but a number known as an erratum is right only if
    it is what rounding gives, within half of its last printed place.

    >>> known = PublishedNumber("P5.17", "", "", Decimal("0.457"), Decimal("0.0006"), "erratum", "")
    >>> deciding_tolerance(known), deciding_tolerance(known._replace(verdict="agrees"))
    (Decimal('0.0005'), Decimal('0.0006'))
    """
    if published.verdict != "erratum" or published.printed is None:
        return published.tolerance
    return Decimal((0, (5,), int(published.printed.as_tuple().exponent) - 1))


@cache
def findings() -> tuple[Finding, ...]:
    """Return every number of section 5 with its computed value and verdict, in order."""
    from evenbreak.source_text.published import further_numbers, p5_6_tables, published_numbers

    rows = (*published_numbers(), *further_numbers(), *p5_6_tables())
    return tuple(_found(row) for row in sorted(rows, key=_place))


def _place(row: PublishedNumber) -> tuple[int, bool]:
    """Return a key that puts numbers in the order of the text, a table after its problem."""
    home = "P5.26" if row.problem == "NPL" else _HOME.get(row.problem, row.problem)
    return int(home.removeprefix("P5.")), row.problem != home


def _found(published: PublishedNumber) -> Finding:
    computed = float(compute(published.problem, published.quantity, published.inputs))
    return Finding(published, computed, verdict_of(published, computed))


def by_problem(found: Iterable[Finding]) -> Mapping[str, list[Finding]]:
    """Return the findings by the problem they belong to, a table with its problem."""
    grouped: dict[str, list[Finding]] = {}
    for finding in found:
        problem = finding.published.problem
        grouped.setdefault(_HOME.get(problem, problem), []).append(finding)
    return grouped
