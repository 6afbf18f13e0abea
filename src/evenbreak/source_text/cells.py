"""The package's tables, and numbers and tables as files: the same bytes on every machine."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import ROUND_HALF_EVEN, ROUND_HALF_UP, Context, Decimal
from importlib.resources import files
from typing import Any, TypeAlias

from evenbreak.files.csv_writer import csv_lines

_DIGITS = Context(prec=10, rounding=ROUND_HALF_EVEN)

Records: TypeAlias = Iterator[Mapping[str, Any]]
"""Rows, computed one at a time."""

Rows: TypeAlias = Sequence[Mapping[str, Any]]
"""A table's rows, each a mapping from column names; a cell may be missing."""

Tables: TypeAlias = Mapping[str, Rows]
"""Tables by file name, without `.csv`."""


def number_cell(value: Any) -> Decimal:
    """Return a number with ten significant digits.

    >>> number_cell(1 / 3), number_cell(0.1 + 0.2), number_cell(16)
    (Decimal('0.3333333333'), Decimal('0.3'), Decimal('16'))
    """
    return _plain(_DIGITS.create_decimal(_sure(value)))


def difference_cell(computed: Any, printed: Decimal) -> Decimal:
    """Return computed - printed to ten decimals; machines differ only beyond that.

    >>> difference_cell(0.1 + 0.2, Decimal("0.3")), difference_cell(0.25, Decimal("0.2"))
    (Decimal('0'), Decimal('0.05'))
    """
    difference = _sure(computed) - printed
    return _plain(difference.quantize(Decimal("1e-10"), ROUND_HALF_EVEN))


def fixed_cell(value: Any) -> Decimal:
    """Return a number with six decimals, with ties rounded the same way on every machine.

    >>> fixed_cell(2**-7), fixed_cell(2**-7 + 1e-18)
    (Decimal('0.007812'), Decimal('0.007812'))
    """
    return _sure(value).quantize(Decimal("0.000001"), ROUND_HALF_EVEN)


def record(inputs: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Return a point on a curve as a row: its inputs exactly, its values with six decimals.

    Text and None are unchanged.

    >>> record({"line": "a", "p": 0.1}, {"w": 1 / 3})
    {'line': 'a', 'p': Decimal('0.1'), 'w': Decimal('0.333333')}
    """
    exact = {name: _cell(value, number_cell) for name, value in inputs.items()}
    return exact | {name: _cell(value, fixed_cell) for name, value in values.items()}


def csv_bytes(rows: Rows) -> bytes:
    r"""Return a table as a file.

    >>> csv_bytes([{"p": Decimal("0.5")}, {"p": None, "note": "even"}])
    b'p,note\n0.5,\n,even\n'
    """
    names = list(dict.fromkeys(name for row in rows for name in row))
    return "".join(csv_lines(names, ([row.get(name) for name in names] for row in rows))).encode()


def packaged_rows(path: str) -> list[list[str]]:
    """Return the rows of one of this package's CSV files, without its header.

    >>> packaged_rows("section5/diagram_arcs.csv")[0]
    ['figure_5_2', 'S1', 'W1', 'p_1']
    """
    text = files("evenbreak.source_text").joinpath(path).read_text("utf-8")
    return list(csv.reader(text.splitlines()))[1:]


def _cell(value: Any, shown: Any) -> Any:
    return value if value is None or isinstance(value, str) else shown(value)


def _sure(value: Any) -> Decimal:
    """Return the digits that are the same on every machine; ties are rounded from these."""
    number = float(value)
    return Decimal(f"{number:.14g}") if abs(number) >= 1e-14 else Decimal(0)


def _plain(value: Decimal) -> Decimal:
    """Return a decimal without trailing zeros, and zero without a sign."""
    value = value.normalize()
    if value == 0:
        return Decimal(0)
    return value.quantize(Decimal(1)) if value.as_tuple().exponent > 0 else value  # type: ignore[operator]


def markdown_table(header: Sequence[str], rows: Iterable[Sequence[Any]], *, left: int = 1) -> str:
    """Return a table in Markdown, with the first `left` columns flush left and the others right.

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
    """Return a number with that many decimals, with halves rounded up as in the text.

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
    """Return a computed number, followed by the printed one if they differ when rounded.

    >>> beside(Decimal("15.97"), Decimal("15.9"), 1), beside(Decimal("2.33"), Decimal("2.3"), 1)
    ('16.0 (text: 15.9)', '2.3')
    """
    text = rounded(computed, decimals)
    if printed is None:
        return text
    places = -int(printed.as_tuple().exponent)
    return text if Decimal(rounded(computed, places)) == printed else f"{text} (text: {printed})"
