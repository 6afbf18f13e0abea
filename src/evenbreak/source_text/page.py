"""What the two pages share: templates, verdicts and slips."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from importlib.resources import files

from evenbreak.source_text.cells import markdown_table, number_cell, short
from evenbreak.source_text.findings import Finding
from evenbreak.source_text.published import Erratum

_PLACE = re.compile(r"\{\{(\w+)(?:\s([^}]*))?\}\}")

Blocks = Mapping[str, Callable[[str], str]]
"""The function that fills each place of a template, by the first word of the place; it gets the
other words."""


def filled(section: str, blocks: Blocks) -> str:
    """Return the page of a section, its template with every `{{place}}` filled in."""
    template = files(f"evenbreak.source_text.{section}").joinpath("page.md").read_text("utf-8")
    page = _PLACE.sub(lambda place: blocks[place[1]](place[2] or ""), template)
    # A problem without slips leaves an empty paragraph.
    return re.sub(r"\n{3,}", "\n\n", page.replace("[contents]", contents(page)))


def contents(page: str) -> str:
    r"""Return links to the sections of a page.

    >>> print(contents("# Top\n\n## Was it luck? P5.19\n\n### Not this\n\n## Runs\n"))
    - [Was it luck? P5.19](#was-it-luck-p519)
    - [Runs](#runs)
    """
    headings = re.findall(r"^## (.+)$", page, re.MULTILINE)
    return "\n".join(f"- [{heading}](#{_anchor(heading)})" for heading in headings)


def _anchor(heading: str) -> str:
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def verdicts_table(found: Iterable[Finding]) -> str:
    """Return how many numbers have each verdict."""
    count = Counter(finding.verdict for finding in found)
    return markdown_table(
        ["verdict", "numbers"], [*sorted(count.items()), ["all", sum(count.values())]]
    )


def compared(finding: Finding) -> list[str]:
    """Return what the text prints, what is computed and the verdict, as cells of a table.

    What the text has only as a formula or in words stands in parentheses.
    """
    computed, verdict = finding.computed, finding.verdict
    text = printed_text(finding.published.printed)
    return [
        f"({text})" if finding.published.value_is in {"formula", "words"} else text,
        "" if computed is None else short(number_cell(computed)),
        "**erratum**" if verdict == "erratum" else verdict,
    ]


def printed_text(number: Decimal | None) -> str:
    """Return a number as printed: with its digits, or as a fraction where it is one.

    >>> printed_text(Decimal("28.10")), printed_text(Decimal("-0.7142857142857143"))
    ('28.10', '-5/7')
    """
    if number is None:
        return ""
    fraction = Fraction(number).limit_denominator(100)
    exact = abs(float(number - Decimal(float(fraction)))) < 1e-12
    return str(fraction) if exact and len(number.as_tuple().digits) > 12 else f"{number:f}"


def errata_table(slips: Iterable[Erratum], class_: str) -> str:
    """Return all slips of a class, or all remarks, as a table."""
    rows = [
        [slip.where, slip.printed, slip.correct, slip.kind, slip.why]
        for slip in slips
        if slip.class_ == class_
    ]
    right = "right" if class_ == "slip" else "what holds"
    return markdown_table(["where", "the text", right, "kind", "why"], rows, left=5)


def slip_blocks(slips: Sequence[Erratum], *, placed: bool = False) -> str:
    """Return slips as block quotes; `placed` adds where in the text each is."""
    return "\n>\n".join(_slip_block(slip, f"{slip.where}. " if placed else "") for slip in slips)


def _slip_block(slip: Erratum, where: str) -> str:
    names = {"slip": "Slip", "remark": "Remark", "copy": "The copy used"}
    name = names[slip.class_] + (f": {slip.kind}" if slip.class_ != "copy" else "")
    label = "What holds" if slip.class_ == "remark" else "Right"
    right = f" {label}: {slip.correct}." if slip.correct else ""
    return f"> {where}**{name}.** The text: {slip.printed}.{right} {slip.why}"
