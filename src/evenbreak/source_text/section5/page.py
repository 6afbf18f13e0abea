"""The page that shows and explains all of section 5: prose from `page.md`, numbers from here.

In the prose `{{numbers P5.7}}` stands for the printed and computed numbers of a problem,
`{{slips P5.7}}` for the slips and remarks there, and the other names for tables.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from evenbreak.source_text.cells import Tables, markdown_table
from evenbreak.source_text.findings import Finding
from evenbreak.source_text.page import (
    Blocks,
    compared,
    errata_table,
    filled,
    slip_blocks,
    verdicts_table,
)
from evenbreak.source_text.published import Erratum, PublishedNumber, errata
from evenbreak.source_text.section5 import page_tables

_SHOWN_ELSEWHERE = {"mean of two", "W(1/2;n,n)", "W infinite look-ahead", "W two-shot look-ahead"}


def section_5_page(found: Sequence[Finding], tables: Tables) -> str:
    """Return the page in Markdown.

    Parameters
    ----------
    found
        all printed numbers with what is computed.
    tables
        the tables of section 5, by the name of their file.
    """
    return filled("section5", _blocks(found, tables))


def slips_of(place: str) -> list[Erratum]:
    """Return the slips and remarks at a problem, a table or a figure.

    >>> [slip.kind for slip in slips_of("P5.25")]
    ['rounded inputs']
    """
    here = re.compile(rf"{re.escape(place)}(?!\d)")
    return [slip for slip in errata() if here.search(slip.where)]


def _blocks(found: Sequence[Finding], tables: Tables) -> Blocks:
    shown = {
        "games": (page_tables.games_table, "problem_5_09"),
        "values": (page_tables.eigenvalues, "problem_5_23"),
        "steps": (page_tables.steps_table, "problem_5_23"),
        "ladder": (page_tables.ladder_table, "npl_ladder"),
        "off_rule": (page_tables.off_rule_table, "table_5_6_off_rule"),
        "eight_ball": (page_tables.eight_ball_table, "drill_8_ball"),
        **{f"table_5_{n}": (page_tables.TABLES[n], f"table_5_{n}") for n in range(1, 7)},
    }
    return {
        "verdicts": lambda _: verdicts_table(found),
        "numbers": lambda problem: _numbers(found, problem),
        "slips": lambda place: slip_blocks(slips_of(place)),
        "errata": lambda class_: errata_table(errata(), class_),
        "scores": lambda p: page_tables.score_table(tables[f"problem_5_06_scores_{_name(p)}"]),
        "matches": lambda p: page_tables.score_table(tables[f"problem_5_06_matches_{_name(p)}"]),
        "triangle": lambda _: page_tables.triangle_table(),
        "matrix": lambda name: page_tables.matrix_table(name, tables),
        "products": lambda _: page_tables.products_table(found),
        "table_5_22": lambda _: page_tables.table_5_22(found),
        "polynomials": lambda _: page_tables.polynomials(tables["problem_5_27"]),
        **{
            name: lambda _, show=show, file=file: show(tables[file])  # type: ignore[misc]
            for name, (show, file) in shown.items()
        },
    }


def _name(p: str) -> str:
    return p.replace("=", "_").replace("/", "_")


def _numbers(found: Sequence[Finding], problem: str) -> str:
    rows = [
        [finding.published.quantity, _given(finding.published.inputs), *compared(finding)]
        for finding in found
        if finding.published.problem == problem
        and finding.published.printed is not None
        and not _in_a_table(finding.published)
    ]
    return markdown_table(["quantity", "given", "text", "computed", "verdict"], rows, left=2)


def _in_a_table(row: PublishedNumber) -> bool:
    """Return whether a number is shown in a table of its own."""
    if row.problem.startswith("Table"):
        return " less " not in row.quantity
    of_the_ladder = row.problem == "NPL" and row.inputs.startswith("chart")
    return of_the_ladder or row.quantity in _SHOWN_ELSEWHERE


def _given(inputs: str) -> str:
    """Return inputs as the page shows them: lists of scores by name, not in full each time.

    >>> _given("as above"), _given("scores 50 44 46"), _given("p=.96 innings=5")
    ('both lists', 'the scores', 'p=.96 innings=5')
    """
    if inputs.startswith("scores "):
        return "the scores"
    return "both lists" if inputs == "as above" or inputs.startswith("N=5;5") else inputs
