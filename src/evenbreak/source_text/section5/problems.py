"""The answers of problems P5.1 to P5.27, one frame each, and the frame of all printed numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from evenbreak.source_text.section5.numbers import PARTS, Finding, by_problem, deciding_tolerance
from evenbreak.source_text.section5.rows import Derived, Row, difference_cell, number_cell

if TYPE_CHECKING:
    import pandas as pd

PROBLEMS = tuple(f"P5.{number}" for number in range(1, 28))

DERIVED: Derived = {key: function for part in PARTS for key, function in part.DERIVED.items()}
"""What answers each problem beyond the numbers that the text prints."""

COLUMNS = (
    "problem",
    "quantity",
    "inputs",
    "printed",
    "computed",
    "difference",
    "tolerance",
    "verdict",
    "note",
)


def file_of(problem: str) -> str:
    """Return the name of a problem's file, without its ending.

    >>> file_of("P5.7")
    'problem_5_07'
    """
    return f"problem_5_{int(problem.removeprefix('P5.')):02}"


def published_frame(found: Iterable[Finding]) -> pd.DataFrame:
    """Return every number that the text prints, with the one that is computed and the verdict."""
    return _frame(_printed(finding) for finding in found)


def problem_frames(found: Iterable[Finding]) -> Mapping[str, pd.DataFrame]:
    """Return the answer of each problem by the name of its file: what is printed, then the rest."""
    grouped = by_problem(found)
    return {
        file_of(problem): _frame(
            [
                *map(_printed, grouped.get(problem, ())),
                *(_derived(problem, row) for row in DERIVED.get(problem, tuple)()),
            ]
        )
        for problem in PROBLEMS
    }


def _printed(finding: Finding) -> tuple[Any, ...]:
    published, printed = finding.published, finding.published.printed
    return (
        published.problem,
        published.quantity,
        published.inputs,
        printed,
        number_cell(finding.computed),
        None if printed is None else difference_cell(finding.computed, printed),
        number_cell(deciding_tolerance(published)),
        finding.verdict,
        published.note,
    )


def _derived(problem: str, row: Row) -> tuple[Any, ...]:
    computed = row.computed if isinstance(row.computed, str) else number_cell(row.computed)
    return problem, row.quantity, row.inputs, None, computed, None, None, "derived", row.note


def _frame(rows: Iterable[tuple[Any, ...]]) -> pd.DataFrame:
    import pandas as pd

    return pd.DataFrame(list(rows), columns=list(COLUMNS), dtype=object)
