"""The answers of problems P5.1 to P5.27, one table each."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from evenbreak.source_text.answers import SECTION_5
from evenbreak.source_text.cells import Tables, number_cell
from evenbreak.source_text.findings import Finding, row_of
from evenbreak.source_text.section5.rows import Derived, Row

PROBLEMS = tuple(f"P5.{number}" for number in range(1, 28))

_PROBLEM_OF = {
    "Table 5.1": "P5.10",
    "Table 5.2": "P5.11",
    "Table 5.3": "P5.16",
    "Table 5.4": "P5.24",
    "Table 5.5": "P5.26",
}
"""The problem that a table answers or follows."""

DERIVED: Derived = {key: rows for part in SECTION_5 for key, rows in part.DERIVED.items()}
"""The rows of each problem beyond the numbers that the text prints."""


def file_of(problem: str) -> str:
    """Return the name of a problem's file, without its ending.

    >>> file_of("P5.7")
    'problem_5_07'
    """
    return f"problem_5_{int(problem.removeprefix('P5.')):02}"


def problem_tables(found: Iterable[Finding]) -> Tables:
    """Return the answer of each problem by file name: printed numbers, then the rest."""
    printed: dict[str, list[dict[str, Any]]] = {}
    for finding in found:
        home = finding.published.problem
        printed.setdefault(_PROBLEM_OF.get(home, home), []).append(row_of(finding))
    return {
        file_of(problem): [
            *printed.get(problem, ()),
            *(_derived(problem, row) for row in DERIVED.get(problem, tuple)()),
        ]
        for problem in PROBLEMS
    }


def _derived(problem: str, row: Row) -> dict[str, Any]:
    return {
        "problem": problem,
        "quantity": row.quantity,
        "inputs": row.inputs,
        "printed": None,
        "computed": row.computed if isinstance(row.computed, str) else number_cell(row.computed),
        "difference": None,
        "tolerance": None,
        "verdict": "derived",
        "note": row.note,
    }
