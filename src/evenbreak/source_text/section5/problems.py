"""The answers of problems P5.1 to P5.27, one table each."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from evenbreak.source_text.answers import SECTION_5
from evenbreak.source_text.cells import Tables, number_cell
from evenbreak.source_text.findings import Finding, row_of
from evenbreak.source_text.section5.order import by_problem
from evenbreak.source_text.section5.rows import Derived, Row

PROBLEMS = tuple(f"P5.{number}" for number in range(1, 28))

DERIVED: Derived = {key: rows for part in SECTION_5 for key, rows in part.DERIVED.items()}
"""What answers each problem beyond the numbers that the text prints."""


def file_of(problem: str) -> str:
    """Return the name of a problem's file, without its ending.

    >>> file_of("P5.7")
    'problem_5_07'
    """
    return f"problem_5_{int(problem.removeprefix('P5.')):02}"


def problem_tables(found: Iterable[Finding]) -> Tables:
    """Return the answer of each problem by the name of its file: what is printed, then the rest."""
    grouped = by_problem(found)
    return {
        file_of(problem): [
            *map(row_of, grouped.get(problem, ())),
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
