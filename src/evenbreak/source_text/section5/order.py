"""The order of section 5: each table belongs to a problem."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from evenbreak.source_text.findings import Finding
from evenbreak.source_text.published import PublishedNumber

_PROBLEM_OF = {
    "Table 5.1": "P5.10",
    "Table 5.2": "P5.11",
    "Table 5.3": "P5.16",
    "Table 5.4": "P5.24",
    "Table 5.5": "P5.26",
}
"""The problem that a table answers or follows."""


def place_of(row: PublishedNumber) -> tuple[int, bool]:
    """Return a key that puts numbers in the order of the text, a table after its problem.

    >>> from evenbreak.source_text.published import published_numbers
    >>> places = {row.problem: place_of(row) for row in published_numbers()}
    >>> places["P5.10"], places["Table 5.1"], places["P5.17"]
    ((10, False), (10, True), (17, False))
    """
    home = "P5.26" if row.problem == "NPL" else _PROBLEM_OF.get(row.problem, row.problem)
    return int(home.removeprefix("P5.")), row.problem != home


def by_problem(found: Iterable[Finding]) -> Mapping[str, list[Finding]]:
    """Return the findings by the problem they belong to, a table with its problem."""
    grouped: dict[str, list[Finding]] = {}
    for finding in found:
        problem = finding.published.problem
        grouped.setdefault(_PROBLEM_OF.get(problem, problem), []).append(finding)
    return grouped
