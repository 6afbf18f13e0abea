"""A list as people type it: a name on each line, perhaps with numbers after it, and no header."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from evenbreak.files.encoding import content_of, text_of
from evenbreak.files.header import Header
from evenbreak.files.player_names import same_name
from evenbreak.files.problems import Problems, quoted
from evenbreak.files.spreadsheet import is_spreadsheet
from evenbreak.files.text_table import Texts, TextTable, read_table
from evenbreak.files.typed_line import TypedLine, typed_line

_RATING_DIGITS = 3
"""A number after a blank that is as long as this is a rating rather than part of a name."""

_HIGHEST_PLACE = 256
"""A number in front of a name that is higher than this is no place on a list."""

_LONGEST_LINE = 1000
"""Letters of a line: far more than a name and its numbers have."""

_WRITE_IT = "write a player on each line, such as Ann Lee,612, or make player,rating the first line"


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
    most = len(numbers)
    for number, line in enumerate(lines, 1):
        if len(line) > _LONGEST_LINE:
            has = f"{quoted(line)} has {len(line):,} letters"
            problems.add(number, f"{has}, which is no name; {_WRITE_IT}")
    found = _lines([line if len(line) <= _LONGEST_LINE else "" for line in lines], most)
    warnings = _fronts(found, problems)
    rows = _with_numbers_after_blanks(found, most)
    _refuse_other_text(rows, problems)
    if not rows and not len(problems):
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
        (*text.warnings, *warnings, *_doubts(rows, source)),
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


def _lines(lines: Sequence[str], most: int) -> list[TypedLine]:
    """Return the lines that are not empty; a number in front needs no sign if all have one."""

    def read(*, numbered: bool) -> list[TypedLine]:
        every = (typed_line(k, text, most, numbered=numbered) for k, text in enumerate(lines, 1))
        return [one for one in every if one.name]

    rows = read(numbered=True)
    counted = [one.front for one in rows] == list(range(1, len(rows) + 1))
    return rows if counted else read(numbered=False)


def _fronts(rows: Sequence[TypedLine], problems: Problems) -> list[str]:
    """Return a warning if places in front of the names are left out; refuse what is no place."""
    numbered = [one for one in rows if one.front is not None]
    fronts = [one.front or 0 for one in numbered]
    if fronts == list(range(1, len(fronts) + 1)):
        return []
    if fronts != sorted(set(fronts)) or fronts[-1] > _HIGHEST_PLACE:
        first = next(
            one
            for k, one in enumerate(numbered)
            if fronts[k] > _HIGHEST_PLACE or (k and fronts[k] <= fronts[k - 1])
        )
        problems.add(
            first.number,
            f"the number {first.front} in front of {quoted(first.name)} is no place in that order; "
            f"sort the lines or leave the numbers out, and {_WRITE_IT}",
        )
        return []
    one = numbered[0]
    return [
        f"{problems.source}:{one.number}: the number {one.front} in front of {quoted(one.name)} is "
        "left out, and so are the others; the order is that of the lines"
    ]


def _with_numbers_after_blanks(rows: list[TypedLine], most: int) -> list[TypedLine]:
    """Return the lines, those with a rating after a blank split: Ann Lee 612, but not Player 7."""
    split = [one.split_at_blanks(most) for one in rows]
    if not all(one.cells for one in split):
        split = [
            after if len(after.cells and after.cells[0]) >= _RATING_DIGITS else one
            for one, after in zip(rows, split, strict=True)
        ]
    names = Counter(same_name(one.name) for one in split)
    return [
        after if names[same_name(after.name)] == 1 else one
        for one, after in zip(rows, split, strict=True)
    ]


def _refuse_other_text(rows: list[TypedLine], problems: Problems) -> None:
    """Refuse lines that look like a title or a slip, and those that could mean two ratings."""
    rated = any(one.cells for one in rows)
    for one in rows:
        slip = rated and not one.cells and re.search(r",|[0-9]{2}", one.name)
        if one.left_over or slip:
            problems.add(one.number, f"{quoted(one.name)} is not a name and a rating; {_WRITE_IT}")


def _doubts(rows: list[TypedLine], source: str) -> list[str]:
    """Return a warning for each kind of line that could mean something else."""
    kinds: dict[str, list[str]] = {}
    for one in (row for row in rows if not row.left_over):
        at, rating = f"{source}:{one.number}: ", one.cells[0] if one.cells else ""
        if one.after_blank:
            whole = quoted(f"{one.name} {rating}")
            said = f"{at}{whole} is read as {one.name} with the rating {rating}"
            kinds.setdefault("split", []).append(said)
        elif re.search(r"^\W*[0-9]" if one.cells else r"[0-9()\[\]]", one.name):
            said = f"{at}{quoted(one.name)} is taken as a name"
            kinds.setdefault("name", []).append(said)
        if rating and float(rating.replace(",", ".")) <= 0:
            said = f"{at}{quoted(one.name)} has the rating {rating}; leave it out if it means none"
            kinds.setdefault("low", []).append(said)
    return [
        said[0] + (f", and so are {len(said) - 1} more" if said[1:] else "")
        for said in kinds.values()
    ]
