"""The page that shows and explains all of section 5: prose from `index.md`, numbers from here.

In the prose `{{numbers P5.7}}` stands for the printed and computed numbers of a problem,
`{{slips P5.7}}` for what is wrong in it or to be remarked, and the other names for tables.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from importlib.resources import files
from typing import TYPE_CHECKING

from evenbreak.source_text.published import Erratum, PublishedNumber, errata
from evenbreak.source_text.section5 import page_tables
from evenbreak.source_text.section5.long_run import HANDICAPS, ahead_formula
from evenbreak.source_text.section5.markdown import markdown_table, short
from evenbreak.source_text.section5.matrices import matrix_table
from evenbreak.source_text.section5.numbers import Finding

if TYPE_CHECKING:
    import pandas as pd

_PLACE = re.compile(r"\{\{(\w+)(?: ([^}]*))?\}\}")
_SHOWN_ELSEWHERE = {"mean of two", "W(1/2;n,n)", "W infinite look-ahead", "W two-shot look-ahead"}

Frames = Mapping[str, "pd.DataFrame"]


def index_page(found: Sequence[Finding], frames: Frames) -> str:
    """Return the page in Markdown.

    Parameters
    ----------
    found
        all printed numbers with what is computed.
    frames
        the tables of section 5, by the name of their file.
    """
    blocks = _blocks(found, frames)
    template = files("evenbreak.source_text.section5").joinpath("index.md").read_text("utf-8")
    page = _PLACE.sub(lambda place: blocks[place[1]](place[2] or ""), template)
    # A problem without slips leaves an empty paragraph.
    return re.sub(r"\n{3,}", "\n\n", page)


def slips_of(place: str) -> list[Erratum]:
    """Return the slips of the text at a problem, a table or a figure, and what else is said.

    >>> [slip.kind for slip in slips_of("P5.25")]
    ['rounded inputs']
    """
    here = re.compile(rf"{re.escape(place)}(?!\d)")
    return [slip for slip in errata() if here.search(slip.where)]


def _blocks(found: Sequence[Finding], frames: Frames) -> Mapping[str, Callable[[str], str]]:
    return {
        "verdicts": lambda _: _verdicts(found),
        "numbers": lambda problem: _numbers(found, problem),
        "slips": _slips,
        "scores": lambda p: page_tables.score_table(frames[f"problem_5_06_scores_{_name(p)}"]),
        "matches": lambda p: page_tables.score_table(frames[f"problem_5_06_matches_{_name(p)}"]),
        "triangle": lambda _: page_tables.triangle_table(),
        "games": lambda _: page_tables.games_table(frames["problem_5_09"]),
        "matrix": matrix_table,
        "eigenvalues": page_tables.eigenvalues_table,
        "values": lambda _: page_tables.eigenvalues(frames["problem_5_23"]),
        "table_5_1": lambda _: page_tables.table_5_1(frames["table_5_1"]),
        "table_5_2": lambda _: page_tables.table_5_2(frames["table_5_2"]),
        "table_5_3": lambda _: page_tables.table_5_3(frames["table_5_3"]),
        "products": lambda _: page_tables.products_table(found),
        "table_5_22": lambda _: page_tables.table_5_22(found),
        "steps": lambda _: page_tables.steps_table(frames["problem_5_23"]),
        "table_5_4": lambda _: page_tables.table_5_4(frames["table_5_4"]),
        "table_5_5": lambda _: page_tables.table_5_5(frames["table_5_5"]),
        "table_5_6": lambda _: page_tables.table_5_6(frames["table_5_6"]),
        "ladder": lambda _: page_tables.ladder_table(frames["npl_ladder"]),
        "polynomials": lambda _: markdown_table(
            ["match", "W"], [[f"{m}:{n}", f"`{ahead_formula(m, n)}`"] for m, n in HANDICAPS]
        ),
        "errata": lambda class_: errata_table(errata(), class_),
    }


def _name(p: str) -> str:
    return p.replace("=", "_").replace("/", "_")


def _verdicts(found: Sequence[Finding]) -> str:
    count = Counter(finding.verdict for finding in found)
    return markdown_table(
        ["verdict", "numbers"], [*sorted(count.items()), ["all", sum(count.values())]]
    )


def _numbers(found: Sequence[Finding], problem: str) -> str:
    rows = [
        [
            row.quantity,
            _given(row.inputs),
            _printed(row.printed),
            short(computed),
            "**erratum**" if verdict == "erratum" else verdict,
        ]
        for row, computed, verdict in found
        if row.problem == problem and row.printed is not None and not _in_a_table(row)
    ]
    return markdown_table(["quantity", "given", "text", "computed", "verdict"], rows, left=2)


def _printed(number: Decimal) -> str:
    """Return a number as printed: with its digits, or as a fraction.

    >>> _printed(Decimal("0.90")), _printed(Decimal("0.3950617283950617"))
    ('0.90', '32/81')
    """
    as_fraction = Fraction(number).limit_denominator(100)
    return str(number) if len(str(number)) <= 8 else str(as_fraction)


def _in_a_table(row: PublishedNumber) -> bool:
    """Return whether a number is shown in a table of its own."""
    if row.problem.startswith("Table"):
        return " less " not in row.quantity
    of_the_ladder = row.problem == "NPL" and row.inputs.startswith("chart")
    return of_the_ladder or row.quantity in _SHOWN_ELSEWHERE


def _given(inputs: str) -> str:
    """Return inputs as a reader would like them: lists of scores by name, not over and over.

    >>> _given("as above"), _given("scores 50 44 46"), _given("p=.96 innings=5")
    ('both lists', 'the scores', 'p=.96 innings=5')
    """
    if inputs.startswith("scores "):
        return "the scores"
    return "both lists" if inputs == "as above" or inputs.startswith("N=5;5") else inputs


def errata_table(slips: Sequence[Erratum], class_: str) -> str:
    """Return all slips of a class, or all remarks, as a table."""
    rows = [
        [slip.where, slip.printed, slip.correct, slip.kind, slip.why]
        for slip in slips
        if slip.class_ == class_
    ]
    right = "right" if class_ == "slip" else "what holds"
    return markdown_table(["where", "the text", right, "kind", "why"], rows, left=5)


def _slips(place: str) -> str:
    return "\n>\n".join(map(slip_block, slips_of(place)))


def slip_block(slip: Erratum) -> str:
    """Return a slip as a block to set in where it occurs."""
    names = {"slip": "Slip", "remark": "Remark", "copy": "The copy used"}
    name = names[slip.class_] + (f": {slip.kind}" if slip.class_ != "copy" else "")
    label = "What holds" if slip.class_ == "remark" else "Right"
    right = f" {label}: {slip.correct}." if slip.correct else ""
    return f"> **{name}.** The text: {slip.printed}.{right} {slip.why}"
