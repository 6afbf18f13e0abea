"""What commands print: JSON, CSV into a pipe, aligned text on a terminal.

All of it without pandas and rich, which would take longer to load than the answer takes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from typing import Any

import click

__all__ = ["SCHEMA_VERSION", "aligned", "chance_text", "csv_text", "print_json", "to_terminal"]

SCHEMA_VERSION = 1


def to_terminal() -> bool:
    """Return whether a person reads the output directly."""
    return sys.stdout is not None and sys.stdout.isatty()


def print_json(value: Any) -> None:
    """Print a value as JSON, in UTF-8 whatever the locale; floats keep every digit."""
    import json

    text = json.dumps(value, ensure_ascii=False, allow_nan=False, indent=2)
    click.echo(f"{text}\n".encode(), nl=False)


def csv_text(columns: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    r"""Return rows of numbers and plain words as CSV, floats with six decimals.

    >>> csv_text(["race_a", "p_win_a"], [[7, 0.5], [8, None]])
    'race_a,p_win_a\n7,0.500000\n8,\n'
    """
    return "".join(",".join(map(_cell, row)) + "\n" for row in [columns, *rows])


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.6f}" if isinstance(value, float) else str(value)


def aligned(rows: Sequence[Sequence[str]], *, left: int = 1) -> str:
    """Return rows of words as columns, the first `left` of them flush left, the others right.

    >>> print(aligned([["hill-hill", "0.2"], ["shutout", "0.0123"]]), end="")
      hill-hill     0.2
      shutout    0.0123
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for row in rows:
        cells = [
            cell.ljust(width) if place < left else cell.rjust(width)
            for place, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  " + "  ".join(cells).rstrip() + "\n")
    return "".join(lines)


def chance_text(p: float) -> str:
    """Return a probability for a person to read.

    >>> chance_text(0.65263), chance_text(1.234e-9), chance_text(1 - 1e-9)
    ('0.6526', '1.2e-09', '1.0000')
    """
    return f"{p:.2g}" if 0.0 < p < 5e-5 else f"{p:.4f}"
