"""Markdown tables of computed numbers, with the printed number where it differs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from decimal import ROUND_HALF_UP, Decimal
from typing import Any


def markdown_table(header: Sequence[str], rows: Iterable[Sequence[Any]], *, left: int = 1) -> str:
    """Return a table in Markdown, the first `left` columns flush left, the others right.

    >>> print(markdown_table(["p", "W"], [["1/2", 0.5]]))
    | p | W |
    |:--|--:|
    | 1/2 | 0.5 |
    """
    ruler = [":--" if column < left else "--:" for column in range(len(header))]
    lines = [_line(header), f"|{'|'.join(ruler)}|", *map(_line, rows)]
    return "\n".join(lines)


def _line(cells: Iterable[Any]) -> str:
    return f"| {' | '.join(str(cell).replace('|', '&#124;') for cell in cells)} |"


def rounded(value: Decimal, decimals: int) -> str:
    """Return a number to that many decimals, with halves rounded up as in the text.

    >>> rounded(Decimal("0.0625"), 3), rounded(Decimal(-2), 1)
    ('0.063', '-2.0')
    """
    return f"{value.quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP):f}"


def short(value: float | Decimal) -> str:
    """Return a number with at most six significant digits.

    >>> short(Decimal("0.5925925925925926")), short(120.0)
    ('0.592593', '120')
    """
    return f"{float(value):.6g}"


def beside(computed: Decimal, printed: Decimal | None, decimals: int) -> str:
    """Return a computed number, and the printed one if it is not the same when rounded.

    >>> beside(Decimal("15.97"), Decimal("15.9"), 1), beside(Decimal("2.33"), Decimal("2.3"), 1)
    ('16.0 (text: 15.9)', '2.3')
    """
    text = rounded(computed, decimals)
    if printed is None:
        return text
    places = -int(printed.as_tuple().exponent)
    return text if Decimal(rounded(computed, places)) == printed else f"{text} (text: {printed})"
