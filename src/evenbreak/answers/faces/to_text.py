"""An answer on a terminal: paragraphs broken between words, numbers in columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from evenbreak.answers.kit.parts import Content, Part, Quantities, Table
from evenbreak.files.tables.problems import printable

WIDTH = 80
NARROWEST, LONGEST_NAME = 20, 30
"""If a table is too wide, its flush-left columns are wrapped, if that leaves them at least as wide
as the first number; otherwise, after the table is split, at least as wide as the second."""

_GAP = 2
"""How many spaces separate two columns."""


def to_text(answer: Content, *, width: int = WIDTH, verbose: bool = False) -> str:
    """Return an answer as text, without its warnings, which are printed elsewhere.

    A table wider than `width` is split by columns; each part repeats the flush-left columns.
    """
    parts = [answer.heading, *answer.parts, *(answer.details if verbose else ())]
    return "\n\n".join(filter(None, (_shown(part, width, verbose) for part in parts))) + "\n"


def paragraph(text: str, width: int = WIDTH) -> str:
    r"""Return text wrapped between words, including list items.

    >>> print(paragraph("Left out:\n- 11 forfeited matches: no games were played.", 32))
    Left out:
    - 11 forfeited matches: no games
      were played.
    """
    import textwrap

    lines = (
        textwrap.fill(
            printable(line),
            width,
            subsequent_indent="  " if line.startswith("- ") else "",
            break_long_words=False,
            break_on_hyphens=False,
        )
        for line in text.split("\n")
    )
    return "\n".join(lines)


def _shown(part: Part, width: int, verbose: bool) -> str:
    if isinstance(part, str):
        return paragraph(part, width)
    lines = [paragraph(part.title, width) + "\n"] if part.title else []
    if isinstance(part, Quantities):
        lines += _quantities(part, verbose)
    else:
        lines += _table(part, width, verbose)
    return "\n".join(lines)


def _quantities(part: Quantities, verbose: bool) -> Iterator[str]:
    shown = part.shown(verbose=verbose)
    rows = [[printable(one.label), printable(one.text)] for one in shown]
    for line, one in zip(aligned(rows, left=1), shown, strict=True):
        yield f"{line}  {one.note}" if one.note else line


def _table(part: Table, width: int, verbose: bool) -> Iterator[str]:
    shown = part.shown(verbose=verbose)
    heads = _heading_lines([column.words or "" for _, column in shown])
    rows = [[printable(column.text(row[k])) for k, column in shown] for row in part.shown_rows]
    flush = [place for place, (_, column) in enumerate(shown) if column.left]
    broken = [place for place in flush if not shown[place][1].whole]
    cells = _folded([*heads, *rows], broken, width)
    names = next((k for k in range(len(shown)) if k not in flush), len(shown))
    for number, block in enumerate(_blocks(cells, names, width)):
        if number:
            yield ""
        picked = [[row[k] for k in block] for row in cells]
        while not any(picked[0]):  # a line of headings for other columns alone
            del picked[0]
        yield from aligned(picked, flush=[place for place, k in enumerate(block) if k in flush])


def _folded(rows: list[list[str]], flush: Sequence[int], width: int) -> list[list[str]]:
    """Return rows whose flush-left cells are wrapped, if that makes them fit."""
    import textwrap

    wide = [max(map(text_width, column)) for column in zip(*rows, strict=True)]
    over = sum(wide) + _GAP * len(wide) - width
    if over <= 0 or not flush:
        return rows
    room = _room([wide[k] for k in flush], sum(wide[k] for k in flush) - over)
    if room < NARROWEST:
        room = LONGEST_NAME
    folded = []
    for row in rows:
        parts = {
            k: textwrap.wrap(row[k], room, subsequent_indent="  ", break_on_hyphens=False) or [""]
            if text_width(row[k]) > room
            else [row[k]]
            for k in flush
        }
        for line in range(max(map(len, parts.values()))):
            rest = row if line == 0 else [""] * len(row)
            folded.append(
                [
                    "".join(parts[k][line : line + 1]) if k in parts else cell
                    for k, cell in enumerate(rest)
                ]
            )
    return folded


def _room(wide: Sequence[int], total: int) -> int:
    """Return the maximum width of each column so that together they are at most `total` wide.

    >>> _room([30, 10, 40], 60), _room([30, 40], 200)
    (25, 40)
    """
    return max(
        (room for room in range(max(wide) + 1) if sum(min(one, room) for one in wide) <= total),
        default=0,
    )


def _blocks(cells: Sequence[Sequence[str]], names: int, width: int) -> list[list[int]]:
    """Return the columns in each part of a table; the first `names` of them are in every part."""
    wide = [_GAP + max(map(text_width, column)) for column in zip(*cells, strict=True)]
    room = width - sum(wide[:names])
    first, rest = list(range(names)), range(names, len(wide))
    blocks: list[list[int]] = [[]]
    for k in rest:
        if blocks[-1] and sum(wide[j] for j in blocks[-1]) + wide[k] > room:
            blocks.append([])
        blocks[-1].append(k)
    size = -(-len(rest) // len(blocks))  # parts of one size, if those fit too
    even = [list(rest[start : start + size]) for start in range(0, len(rest), size or 1)]
    if all(sum(wide[k] for k in block) <= room for block in even):
        blocks = even or blocks
    return [first + block for block in blocks]


def _heading_lines(headings: Sequence[str]) -> list[list[str]]:
    r"""Return the heading lines; shorter headings are aligned at the bottom.

    >>> _heading_lines(["shot", "you\nmake"])
    [['', 'you'], ['shot', 'make']]
    """
    if not any(headings):
        return []
    parts = [heading.split("\n") for heading in headings]
    tall = max(map(len, parts), default=1)
    padded = [[""] * (tall - len(part)) + part for part in parts]
    return [list(line) for line in zip(*padded, strict=True)]


def aligned(
    rows: Sequence[Sequence[str]], *, left: int = 0, flush: Sequence[int] = ()
) -> Iterator[str]:
    r"""Yield rows as aligned lines: the first `left` columns and those in `flush` are flush left.

    >>> print(*aligned([["hill-hill", "0.2"], ["shutout", "0.0123"]], left=1), sep="\n")
      hill-hill     0.2
      shutout    0.0123
    """
    if not rows:
        return
    widths = [max(map(text_width, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = []
        for place, (cell, width) in enumerate(zip(row, widths, strict=True)):
            gap = " " * (width - text_width(cell))
            cells.append(cell + gap if place < left or place in flush else gap + cell)
        yield ("  " + "  ".join(cells)).rstrip()


def text_width(text: str) -> int:
    """Return the width of a string on a terminal, in columns.

    >>> text_width("Zoë"), text_width("🎱"), text_width("李娜")
    (3, 2, 4)
    """
    if max(text, default="") < "\u0300":  # before the first that combine with others
        return len(text)
    from rich.cells import cell_len  # only now: it takes a while to load

    return cell_len(text)
