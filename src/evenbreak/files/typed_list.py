"""A list as people type it: a name on each line, perhaps with numbers after it, and no header."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from evenbreak.files.encoding import content_of, text_of
from evenbreak.files.header import Header
from evenbreak.files.player_names import clean_name, same_name
from evenbreak.files.problems import Problems, quoted
from evenbreak.files.spreadsheet import is_spreadsheet
from evenbreak.files.text_table import Texts, TextTable, read_table

_NUMBER = re.compile(r"[-+]?[0-9]+(?:[.,][0-9]+)?", re.ASCII)
_AFTER_BLANKS = re.compile(r"(.*?[^\s0-9].*?)((?:\s+[0-9]+(?:[.,][0-9]+)?)+)", re.ASCII)
_RATED = re.compile(rf"[,;\t]\s*{_NUMBER.pattern}\s*", re.ASCII)
_NUMBERED = re.compile(r"\s*([0-9]+)[.)]\s+", re.ASCII)
_RATING_DIGITS = 3
"""A number after a blank that is as long as this is a rating rather than part of a name."""


class _Line(NamedTuple):
    """A line: where it is, the name, the numbers after it, and how they were set apart."""

    number: int
    name: str
    cells: tuple[str, ...]
    after_blank: bool = False


def read_players(
    path: str | Path,
    required: Mapping[str, Sequence[str]],
    optional: Mapping[str, Sequence[str]],
    *,
    numbers: Sequence[str] = ("rating",),
) -> TextTable:
    r"""Read a list of players: a table with a header, or a player on each line.

    Parameters
    ----------
    path
        the file; '-' is standard input, which must have a header.
    required, optional
        the columns of the table, as for `read_table`; `player` is among them.
    numbers
        the columns of the numbers that may follow a name on its line, in this order.

    Raises
    ------
    DataError
        as `read_table` does.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "tonight.txt"
    ...     _ = path.write_text("Ann Lee, 612\nBo Diaz 540\n\nCy\n")
    ...     table = read_players(path, {"player": ()}, {"rating": ()})
    >>> table.cells("player"), table.cells("rating"), table.lines
    (['Ann Lee', 'Bo Diaz', 'Cy'], ['612', '540', ''], array([1, 2, 4]))
    """
    if str(path) == "-":
        return read_table(path, required, optional, rows="players")
    source, content = content_of(path)
    if is_spreadsheet(content):
        return read_table(path, required, optional, rows="players")
    text = text_of(content, source)
    lines = text.body.decode(text.encoding).splitlines()
    header = Header(required, optional, {})
    if _has_header(lines, header):
        return read_table(path, required, optional, rows="players")
    problems = Problems(source)
    found = [
        _line(number, line, len(numbers)) for number, line in enumerate(_without_numbers(lines), 1)
    ]
    rows = _with_numbers_after_blanks([one for one in found if one.name], len(numbers))
    _refuse_other_text(rows, problems)
    if not rows:
        problems.add(None, "names nobody; write one player on each line")
    columns = {name: Texts.of([""] * len(rows)) for name in header.columns}
    columns["player"] = Texts.of([one.name for one in rows])
    for k, name in enumerate(numbers):
        columns[name] = Texts.of([one.cells[k] if k < len(one.cells) else "" for one in rows])
    stated = {name for name in numbers if any(columns[name].distinct)}
    return TextTable(
        source,
        np.array([one.number for one in rows], dtype=np.int64),
        columns,
        frozenset({"player", *stated}),
        problems,
        (*text.warnings, *_taken_as_ratings(rows, source)),
        content,
        {name: name for name in ("player", *stated)},
    )


def _has_header(lines: Sequence[str], header: Header) -> bool:
    """Return whether the first line that is not empty has a title by which players are known."""
    first = next((line for line in lines if line.strip()), "")
    return any(
        "player" in header.places(first.split(separator), 1, Problems(""))[0]
        for separator in ",;\t"
    )


def _without_numbers(lines: Sequence[str]) -> list[str]:
    """Return the lines without 1., 2., ... in front, if all that are not empty have them."""
    numbered = [_NUMBERED.match(line) for line in lines if line.strip()]
    counts = [int(found[1]) if found else None for found in numbered]
    if counts != list(range(1, len(counts) + 1)):
        return list(lines)
    return [_NUMBERED.sub("", line) for line in lines]


def _line(number: int, text: str, most: int) -> _Line:
    """Return a name and the numbers after it; what else has commas is a name, such as Lee, Ann."""
    for separator in "\t;,":
        name, *cells = (cell.strip() for cell in text.split(separator))
        if cells and len(cells) <= most and all(not c or _NUMBER.fullmatch(c) for c in cells):
            return _Line(number, clean_name(name), tuple(cells))
    return _Line(number, clean_name(text), ())


def _with_numbers_after_blanks(rows: list[_Line], most: int) -> list[_Line]:
    """Return the lines, those with a rating after a blank split: Ann Lee 612, but not Player 7."""
    parts = [None if one.cells else _AFTER_BLANKS.fullmatch(one.name) for one in rows]
    cells = [tuple(part[2].split()) if part else () for part in parts]
    cells = [each if len(each) <= most else () for each in cells]
    if not all(one.cells or each for one, each in zip(rows, cells, strict=True)):
        cells = [each if each and len(each[0]) >= _RATING_DIGITS else () for each in cells]
    split = [
        one._replace(name=part[1], cells=each, after_blank=True) if part and each else one
        for one, part, each in zip(rows, parts, cells, strict=True)
    ]
    names = Counter(same_name(one.name) for one in split)
    return [
        after if names[same_name(after.name)] == 1 else one
        for one, after in zip(rows, split, strict=True)
    ]


def _refuse_other_text(rows: list[_Line], problems: Problems) -> None:
    """Refuse lines that look like a title or a slip."""
    some_have_numbers = any(one.cells for one in rows)
    for one in rows:
        if one.cells or not re.search(r"[,;\t]", one.name):
            continue
        if some_have_numbers or _RATED.search(one.name):
            problems.add(
                one.number,
                f"{quoted(one.name)} is not a name and a rating; write it such as Ann Lee,612, or "
                "make player,rating the first line",
            )


def _taken_as_ratings(rows: list[_Line], source: str) -> list[str]:
    """Return a warning where numbers after a blank were taken as ratings."""
    split = [one for one in rows if one.after_blank]
    if not split:
        return []
    one = split[0]
    return [
        f"{source}:{one.number}: {quoted(f'{one.name} {one.cells[0]}')} is read as {one.name} with "
        f"the rating {one.cells[0]}" + (f", and so are {len(split) - 1} more" if split[1:] else "")
    ]
