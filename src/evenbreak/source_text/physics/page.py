"""The page that shows sections 1 to 4: prose from `page.md`, numbers and figures from here.

In the prose `{{numbers 3.6 3.9}}` stands for the numbers of P3.6 to P3.9, `{{slips 3.6 3.9}}` for
the slips and remarks there, and `{{figure 3.1 ...}}` for a figure with its caption. 3.0 is what
section 3 says before its first problem.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from evenbreak.source_text.cells import markdown_table
from evenbreak.source_text.findings import Finding
from evenbreak.source_text.page import compared, errata_table, filled, slip_blocks, verdicts_table
from evenbreak.source_text.published import physics_errata

_PROBLEM = re.compile(r"(\d)\.(\d+)")


def physics_page(found: Sequence[Finding], tables: Iterable[str]) -> str:
    """Return the page in Markdown.

    Parameters
    ----------
    found
        all numbers of sections 1 to 4 with what is computed.
    tables
        the names of the tables of sections 1 to 4, which are linked under their figures.
    """
    names, slips = list(tables), physics_errata()
    return filled(
        "physics",
        {
            "verdicts": lambda _: verdicts_table(found),
            "numbers": lambda span: _numbers(found, span),
            "slips": lambda span: slip_blocks(
                [slip for slip in slips if _within(slip.where, span)], placed=True
            ),
            "figure": lambda place: _figure(place, names),
            "errata": lambda class_: errata_table(slips, class_),
        },
    )


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


def _within(where: str, span: str) -> bool:
    first, last = map(place_of, span.split())
    return first <= place_of(where) <= last


def _numbers(found: Sequence[Finding], span: str) -> str:
    here = [finding for finding in found if _within(finding.published.problem, span)]
    rows = []
    for finding in sorted(here, key=lambda finding: place_of(finding.published.problem)):
        row = finding.published
        rows.append([f"`{row.quantity}`", row.problem, row.inputs, *compared(finding)])
    return markdown_table(["quantity", "where", "for", "text", "computed", "verdict"], rows, left=3)


def _figure(place: str, tables: Sequence[str]) -> str:
    """Return a figure with its caption and links, from its number and the caption."""
    number, *words = place.split()
    name, caption = f"figure_{number.replace('.', '_')}", " ".join(words)
    behind = [f"{table}.csv" for table in tables if table.startswith(name)]
    links = ", ".join(f"[{file}]({file})" for file in [*behind, f"{name}.svg"])
    return f"![{caption}]({name}.png)\n\n**Figure {number}.** {caption} Files: {links}."
