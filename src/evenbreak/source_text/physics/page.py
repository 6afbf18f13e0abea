"""The page that shows sections 1 to 4: prose from `page.md`, numbers and figures from here.

In the prose `{{numbers 3.6 3.9}}` stands for the numbers of P3.6 to P3.9, `{{slips 3.6 3.9}}` for
what is wrong in them or to be remarked, 3.0 for what section 3 says before its first problem.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from importlib.resources import files

from evenbreak.source_text.physics.chosen import CAPTIONS
from evenbreak.source_text.physics.numbers import PhysicsFinding, place_of
from evenbreak.source_text.published import physics_errata
from evenbreak.source_text.section5.index import errata_table, slip_block
from evenbreak.source_text.section5.markdown import markdown_table, short
from evenbreak.source_text.section5.rows import number_cell

_PLACE = re.compile(r"\{\{(\w+)(?: ([^}]*))?\}\}")


def physics_page(found: Sequence[PhysicsFinding], tables: Iterable[str]) -> str:
    """Return the page in Markdown.

    Parameters
    ----------
    found
        all numbers of sections 1 to 4 with what is computed.
    tables
        the names of the tables of sections 1 to 4, which are linked under their figures.
    """
    names = list(tables)
    blocks: Mapping[str, Callable[[str], str]] = {
        "verdicts": lambda _: _verdicts(found),
        "numbers": lambda span: _numbers(found, span),
        "slips": _slips,
        "figure": lambda number: _figure(number, names),
        "errata": lambda class_: errata_table(physics_errata(), class_),
    }
    template = files("evenbreak.source_text.physics").joinpath("page.md").read_text("utf-8")
    page = _PLACE.sub(lambda place: blocks[place[1]](place[2] or ""), template)
    # Problems without slips leave an empty paragraph.
    return re.sub(r"\n{3,}", "\n\n", page)


def _within(where: str, span: str) -> bool:
    first, last = map(place_of, span.split())
    return first <= place_of(where) <= last


def _verdicts(found: Sequence[PhysicsFinding]) -> str:
    count = Counter(finding.verdict for finding in found)
    return markdown_table(
        ["verdict", "numbers"], [*sorted(count.items()), ["all", sum(count.values())]]
    )


def _numbers(found: Sequence[PhysicsFinding], span: str) -> str:
    here = [finding for finding in found if _within(finding.published.problem, span)]
    rows = [
        [
            f"`{row.quantity}`",
            row.problem,
            row.inputs,
            _printed(row.printed),
            "" if computed is None else short(number_cell(computed)),
            "**erratum**" if verdict == "erratum" else verdict,
        ]
        for row, computed, verdict in sorted(here, key=lambda f: place_of(f.published.problem))
    ]
    return markdown_table(["quantity", "where", "for", "text", "computed", "verdict"], rows, left=3)


def _printed(number: Decimal | None) -> str:
    """Return a number as printed: with its digits, or as a fraction where it is one.

    >>> _printed(Decimal("28.10")), _printed(Decimal("-0.7142857142857143")), _printed(None)
    ('28.10', '-5/7', '')
    """
    if number is None:
        return ""
    fraction = Fraction(number).limit_denominator(100)
    long = len(number.as_tuple().digits) > 12
    return (
        str(fraction)
        if long and abs(float(number - Decimal(float(fraction)))) < 1e-12
        else (f"{number:f}")
    )


def _slips(span: str) -> str:
    here = [slip for slip in physics_errata() if _within(slip.where, span)]
    return "\n>\n".join(slip_block(slip).replace("> ", f"> {slip.where}. ", 1) for slip in here)


def _figure(number: str, tables: Sequence[str]) -> str:
    name = f"figure_{number.replace('.', '_')}"
    caption = CAPTIONS[name]
    behind = [f"{table}.csv" for table in tables if table.startswith(name)]
    links = ", ".join(f"[{file}]({file})" for file in [*behind, f"{name}.svg"])
    return f"![{caption}]({name}.png)\n\n**Figure {number}.** {caption} Files: {links}."
