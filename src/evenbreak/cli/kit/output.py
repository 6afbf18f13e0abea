"""What commands print: JSON, CSV into a pipe, aligned text on a terminal.

All of it without pandas and rich, which would take longer to load than the answer takes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import click

SCHEMA_VERSION = 1

WIDTH = 80
"""Where sentences on a terminal are broken."""


def to_terminal() -> bool:
    """Return whether a person reads the output directly."""
    return sys.stdout is not None and sys.stdout.isatty()


def say(message: str) -> None:
    """Say something beside the answer: a line on stderr, in letters that print.

    On a terminal the line is broken between words.
    """
    from evenbreak.files.problems import printable

    text = printable(message)
    if sys.stderr is not None and sys.stderr.isatty():
        import textwrap

        # Names of files stay whole, so that they can be copied.
        text = textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False)
    click.echo(text, err=True)


def print_json(value: Any) -> None:
    """Print a value as JSON, in UTF-8 whatever the locale; floats keep every digit."""
    import json

    text = json.dumps(value, ensure_ascii=False, allow_nan=False, indent=2)
    click.echo(f"{text}\n".encode(), nl=False)


def print_quantities(
    answer: Mapping[str, Any],
    *,
    words: Mapping[str, str],
    heading: str,
    text: Callable[[str, Any], str],
    as_json: bool,
) -> None:
    """Print one answer of several quantities, as JSON, CSV or text.

    Parameters
    ----------
    answer
        each quantity by its name: a number, a plain word, or None where there is none.
    words
        what to call those that a terminal shows, in their order; None is not shown.
    heading
        the lines above them, on a terminal.
    text
        a quantity, by its name and value, as a terminal shows it.
    as_json
        whether JSON was asked for.
    """
    if as_json:
        print_json({**answer, "schema_version": SCHEMA_VERSION})
    elif to_terminal():
        shown = [[words[key], text(key, answer[key])] for key in words if answer[key] is not None]
        click.echo(f"{heading}\n\n{aligned(shown)}", nl=False)
    else:
        click.echo(csv_text(["quantity", "value"], answer.items()), nl=False)


def print_table(
    columns: Sequence[str],
    rows: Sequence[Sequence[Any]],
    *,
    headings: Sequence[str],
    heading: str,
    text: Callable[[str, Any], str],
    left: int = 0,
) -> None:
    """Print a table, as CSV into a pipe and as text on a terminal; JSON is the command's own.

    Parameters
    ----------
    columns, rows
        the names and values of the CSV.
    headings
        what a terminal calls the columns; a line break in one makes a second line of them.
    heading
        the lines above the table, on a terminal.
    text
        a value, by its column's name, as a terminal shows it; None is shown empty.
    left
        how many columns are flush left.
    """
    if not to_terminal():
        click.echo(csv_text(columns, rows), nl=False)
        return
    cells = [
        [
            "" if value is None else text(name, value)
            for name, value in zip(columns, row, strict=True)
        ]
        for row in rows
    ]
    click.echo(f"{heading}\n\n{aligned([*heading_lines(headings), *cells], left=left)}", nl=False)


def heading_lines(headings: Sequence[str]) -> list[list[str]]:
    r"""Return the lines of the headings, those of fewer lines at the bottom.

    >>> heading_lines(["shot", "you\nmake"])
    [['', 'you'], ['shot', 'make']]
    """
    parts = [heading.split("\n") for heading in headings]
    tall = max(map(len, parts), default=1)
    padded = [[""] * (tall - len(part)) + part for part in parts]
    return [list(line) for line in zip(*padded, strict=True)]


def paragraphs(text: str) -> str:
    """Return text with each of its lines broken where a terminal of 80 columns ends."""
    import textwrap

    return "\n".join(textwrap.fill(line, WIDTH) for line in text.split("\n"))


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
    widths = [max(map(_width, column)) for column in zip(*rows, strict=True)]
    lines = []
    for row in rows:
        cells = []
        for place, (cell, width) in enumerate(zip(row, widths, strict=True)):
            gap = " " * (width - _width(cell))
            cells.append(cell + gap if place < left else gap + cell)
        lines.append("  " + "  ".join(cells).rstrip() + "\n")
    return "".join(lines)


def _width(text: str) -> int:
    """Return how many columns of a terminal a text takes.

    >>> _width("Zoë"), _width("🎱"), _width("李娜")
    (3, 2, 4)
    """
    if max(text, default="") < "\u0300":  # before the first that combine with others
        return len(text)
    from rich.cells import cell_len  # only now: it takes a while to load

    return cell_len(text)


def chance_text(p: float) -> str:
    """Return a probability for a person to read.

    >>> chance_text(0.65263), chance_text(0.00101), chance_text(1.234e-9), chance_text(1 - 1e-9)
    ('0.6526', '0.0010', '1.2e-09', '1.0000')
    """
    return f"{p:.2g}" if 0.0 < p < 5e-5 else f"{p:.4f}"
