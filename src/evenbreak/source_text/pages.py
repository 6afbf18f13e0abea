"""The pages that show the text: prose from `templates`; numbers, slips and figures from here.

In the prose, `{{numbers P5.7}}` or `{{numbers 3.6 3.9}}` stands for the numbers in one problem or
in all from P3.6 to P3.9, `{{slips ...}}` for the slips and remarks there, `{{figure 3.1 ...}}` for
a figure with its caption, and other names stand for tables. 3.0 is section 3 up to its first
problem.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from importlib.resources import files

from evenbreak.source_text.cells import Tables, markdown_table, number_cell, short
from evenbreak.source_text.published import (
    Erratum,
    Finding,
    PublishedNumber,
    errata,
    physics_errata,
)
from evenbreak.source_text.section5 import page_tables

_PLACE = re.compile(r"\{\{(\w+)(?:\s([^}]*))?\}\}")

Blocks = Mapping[str, Callable[[str], str]]
"""The functions that fill the places in a template, by each place's first word; they get the other
words."""


def filled(section: str, blocks: Blocks) -> str:
    """Return a section's page, with every `{{place}}` in its template filled in."""
    template = files("evenbreak.source_text").joinpath(f"templates/{section}.md").read_text("utf-8")
    page = _PLACE.sub(lambda place: blocks[place[1]](place[2] or ""), template)
    # A problem without slips leaves an empty paragraph.
    return re.sub(r"\n{3,}", "\n\n", page.replace("[contents]", contents(page)))


def contents(page: str) -> str:
    r"""Return links to a page's sections.

    >>> print(contents("# Top\n\n## Was it luck? P5.19\n\n### Not this\n\n## Runs\n"))
    - [Was it luck? P5.19](#was-it-luck-p519)
    - [Runs](#runs)
    """
    headings = re.findall(r"^## (.+)$", page, re.MULTILINE)
    return "\n".join(f"- [{heading}](#{_anchor(heading)})" for heading in headings)


def _anchor(heading: str) -> str:
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def verdicts_table(findings: Iterable[Finding]) -> str:
    """Return how many numbers have each verdict."""
    count = Counter(finding.verdict for finding in findings)
    return markdown_table(
        ["verdict", "numbers"], [*sorted(count.items()), ["all", sum(count.values())]]
    )


def compared(finding: Finding) -> list[str]:
    """Return what the text prints, the computed value and the verdict, as table cells.

    If the text has only a formula or words, the value is in parentheses.
    """
    computed, verdict = finding.computed, finding.verdict
    text = printed_text(finding.published.printed)
    return [
        f"({text})" if finding.published.value_is in {"formula", "words"} else text,
        "" if computed is None else short(number_cell(computed)),
        "**erratum**" if verdict == "erratum" else verdict,
    ]


def printed_text(number: Decimal | None) -> str:
    """Return a number as printed: with its digits, or as a fraction if it is one.

    >>> printed_text(Decimal("28.10")), printed_text(Decimal("-0.7142857142857143"))
    ('28.10', '-5/7')
    """
    if number is None:
        return ""
    fraction = Fraction(number).limit_denominator(100)
    exact = abs(float(number - Decimal(float(fraction)))) < 1e-12
    return str(fraction) if exact and len(number.as_tuple().digits) > 12 else f"{number:f}"


def errata_table(slips: Iterable[Erratum], class_: str) -> str:
    """Return all slips in a class, or all remarks, as a table."""
    rows = [
        [slip.where, slip.printed, slip.correct, slip.kind, slip.why]
        for slip in slips
        if slip.class_ == class_
    ]
    right = "right" if class_ == "slip" else "what holds"
    return markdown_table(["where", "the text", right, "kind", "why"], rows, left=5)


def slip_blocks(slips: Sequence[Erratum], *, placed: bool = False) -> str:
    """Return slips as block quotes; `placed` adds each one's place in the text."""
    return "\n>\n".join(_slip_block(slip, f"{slip.where}. " if placed else "") for slip in slips)


def _slip_block(slip: Erratum, where: str) -> str:
    names = {"slip": "Slip", "remark": "Remark", "copy": "The copy used"}
    name = names[slip.class_] + (f": {slip.kind}" if slip.class_ != "copy" else "")
    label = "What holds" if slip.class_ == "remark" else "Right"
    right = f" {label}: {slip.correct}." if slip.correct else ""
    return f"> {where}**{name}.** The text: {slip.printed}.{right} {slip.why}"


_SHOWN_ELSEWHERE = {"mean of two", "W(1/2;n,n)", "W infinite look-ahead", "W two-shot look-ahead"}


def section_5_page(findings: Sequence[Finding], tables: Tables) -> str:
    """Return the page in Markdown, given all printed numbers and the tables by file name."""
    return filled("section5", _blocks(findings, tables))


def slips_of(place: str) -> list[Erratum]:
    """Return the slips and remarks at a problem, a table or a figure.

    >>> [slip.kind for slip in slips_of("P5.25")]
    ['rounded inputs']
    """
    here = re.compile(rf"{re.escape(place)}(?!\d)")
    return [slip for slip in errata() if here.search(slip.where)]


def _blocks(findings: Sequence[Finding], tables: Tables) -> Blocks:
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
        "verdicts": lambda _: verdicts_table(findings),
        "numbers": lambda problem: _numbers(findings, problem),
        "slips": lambda place: slip_blocks(slips_of(place)),
        "errata": lambda class_: errata_table(errata(), class_),
        "scores": lambda p: page_tables.score_table(tables[f"problem_5_06_scores_{_name(p)}"]),
        "matches": lambda p: page_tables.score_table(tables[f"problem_5_06_matches_{_name(p)}"]),
        "triangle": lambda _: page_tables.triangle_table(),
        "matrix": lambda name: page_tables.matrix_table(name, tables),
        "products": lambda _: page_tables.products_table(findings),
        "table_5_22": lambda _: page_tables.table_5_22(findings),
        "polynomials": lambda _: page_tables.polynomials(tables["problem_5_27"]),
        **{
            name: lambda _, show=show, file=file: show(tables[file])  # type: ignore[misc]
            for name, (show, file) in shown.items()
        },
    }


def _name(p: str) -> str:
    return p.replace("=", "_").replace("/", "_")


def _numbers(findings: Sequence[Finding], problem: str) -> str:
    rows = [
        [finding.published.quantity, _given(finding.published.inputs), *compared(finding)]
        for finding in findings
        if finding.published.problem == problem
        and finding.published.printed is not None
        and not _in_a_table(finding.published)
    ]
    return markdown_table(["quantity", "given", "text", "computed", "verdict"], rows, left=2)


def _in_a_table(row: PublishedNumber) -> bool:
    """Return whether a number is shown in a separate table."""
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


_PROBLEM = re.compile(r"(\d)\.(\d+)")


def physics_page(findings: Sequence[Finding], tables: Iterable[str]) -> str:
    """Return the page in Markdown, given all numbers and table names in sections 1 to 4."""
    names, slips = list(tables), physics_errata()
    return filled(
        "physics",
        {
            "verdicts": lambda _: verdicts_table(findings),
            "numbers": lambda span: _physics_numbers(findings, span),
            "slips": lambda span: slip_blocks(
                [slip for slip in slips if _within(slip.where, span)], placed=True
            ),
            "figure": lambda place: _figure(place, names),
            "errata": lambda class_: errata_table(slips, class_),
        },
    )


def place_of(where: str) -> tuple[int, int]:
    """Return the section and number of the first problem named in a place.

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


def _physics_numbers(findings: Sequence[Finding], span: str) -> str:
    here = [finding for finding in findings if _within(finding.published.problem, span)]
    rows = []
    for finding in sorted(here, key=lambda finding: place_of(finding.published.problem)):
        row = finding.published
        rows.append([f"`{row.quantity}`", row.problem, row.inputs, *compared(finding)])
    return markdown_table(["quantity", "where", "for", "text", "computed", "verdict"], rows, left=3)


def _figure(place: str, tables: Sequence[str]) -> str:
    """Return a figure with its caption and links, given its number and the caption."""
    number, *words = place.split()
    name, caption = f"figure_{number.replace('.', '_')}", " ".join(words)
    behind = [f"{table}.csv" for table in tables if table.startswith(name)]
    links = ", ".join(f"[{file}]({file})" for file in [*behind, f"{name}.svg"])
    return f"![{caption}]({name}.png)\n\n**Figure {number}.** {caption} Files: {links}."
