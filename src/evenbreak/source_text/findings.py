"""Printed numbers compared with computed ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from decimal import Decimal
from typing import Any, NamedTuple

from evenbreak.source_text.cells import difference_cell, number_cell
from evenbreak.source_text.inputs import Answers, parse_inputs
from evenbreak.source_text.published import PublishedNumber


class Finding(NamedTuple):
    """A printed number, what is computed in its place, and the verdict.

    Parameters
    ----------
    published
        the number in the package data.
    computed
        what the library computes, or has where the text takes a number from elsewhere; None if
        it has no such number.
    verdict
        'agrees', 'formula', 'given', 'erratum' or 'derived' as for `PublishedNumber`; or
        'differs', which should never happen.
    """

    published: PublishedNumber
    computed: float | None
    verdict: str


def find(rows: Iterable[PublishedNumber], answers: Answers) -> Iterator[Finding]:
    """Yield each number with what is computed in its place."""
    for row in rows:
        computed = None
        if row.verdict != "given" or (row.problem, row.quantity) in answers:
            answer = answers[row.problem, row.quantity](parse_inputs(row.inputs))
            computed = float(answer)
        yield Finding(row, computed, verdict_of(row, computed))


def verdict_of(published: PublishedNumber, computed: float | None) -> str:
    """Return the verdict on a printed number, given the computed one.

    Within `deciding_tolerance` the verdict of the package data stands, except that a supposed
    erratum agrees. Outside it the verdict is 'differs', unless the number is an erratum.
    """
    if published.printed is None:
        return "derived"
    if computed is None:
        return "given" if published.verdict == "given" else "differs"
    near = abs(computed - float(published.printed)) <= float(deciding_tolerance(published))
    if published.verdict == "erratum":
        return "agrees" if near else "erratum"
    return published.verdict if near else "differs"


def deciding_tolerance(published: PublishedNumber) -> Decimal:
    """Return how far apart a printed and a computed number may be and still agree.

    That is the tolerance of the number. A known erratum agrees only within half of its last
    printed place, as rounding would leave it.

    >>> known = PublishedNumber("P5.17", "", "", Decimal("0.457"), Decimal("0.0006"), "erratum", "")
    >>> deciding_tolerance(known), deciding_tolerance(known._replace(verdict="agrees"))
    (Decimal('0.0005'), Decimal('0.0006'))
    """
    if published.verdict != "erratum" or published.printed is None:
        return published.tolerance
    return Decimal((0, (5,), int(published.printed.as_tuple().exponent) - 1))


def differing(found: Iterable[Finding]) -> Iterator[str]:
    """Yield a line for each number that does not have the expected verdict."""
    for row, computed, verdict in found:
        if verdict != row.verdict:
            number = "nothing" if computed is None else f"{computed:.10g}"
            yield (
                f"{row.problem}: {row.quantity} ({row.inputs}): printed {row.printed}, "
                f"computed {number}: {verdict}, not {row.verdict}"
            )


def physics_row_of(finding: Finding) -> dict[str, Any]:
    """Return a number of sections 1 to 4 as a row, with what its value is.

    >>> number = PublishedNumber("P2.2", "q", "", Decimal(2), Decimal(0), "formula", "", "formula")
    >>> list(physics_row_of(Finding(number, 2.0, "formula")).items())[3:5]
    [('value', Decimal('2')), ('value_is', 'formula')]
    """
    cells: dict[str, Any] = {}
    for name, cell in row_of(finding).items():
        if name == "printed":
            cells |= {"value": cell, "value_is": finding.published.value_is}
        else:
            cells[name] = cell
    return cells


def row_of(finding: Finding) -> dict[str, Any]:
    """Return a number as a row of a table."""
    row, computed = finding.published, finding.computed
    difference = None
    if computed is not None and row.printed is not None:
        difference = difference_cell(computed, row.printed)
    return {
        "problem": row.problem,
        "quantity": row.quantity,
        "inputs": row.inputs,
        "printed": row.printed,
        "computed": None if computed is None else number_cell(computed),
        "difference": difference,
        "tolerance": number_cell(deciding_tolerance(row)),
        "verdict": finding.verdict,
        "note": row.note,
    }
