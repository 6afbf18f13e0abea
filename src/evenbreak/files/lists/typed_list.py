"""A list as people type it: a name on each line, perhaps with numbers around it, and no header.

A line is taken apart only where its signs leave no doubt. What is left over is the name, and where
that still has numbers or signs of a list in it, the line is doubted or refused, never guessed at.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from evenbreak.files.tables.header import Header
from evenbreak.files.tables.names import clean_name, same_name
from evenbreak.files.tables.problems import Problems, quoted, warning
from evenbreak.files.tables.rows import content_of, fingerprint, is_spreadsheet, text_of
from evenbreak.files.tables.schema import Schema
from evenbreak.files.tables.table import Texts, TextTable
from evenbreak.words import say

_ONE = r"[0-9]+(?:[.,][0-9]{1,2})?"
_NUMBER = rf"[-+]?{_ONE}"
_PICTURES = r"\u2600-\u27bf\U0001f000-\U0001faff\ufe0f"
_AROUND = re.compile(rf"^[\s*•·‣◦▪●○–—{_PICTURES}-]+(?=\S)|[\s{_PICTURES}]+$")
_MARKED = re.compile(
    r"(?:(?:no\.?|nr\.?|#|№)\s*([0-9]{1,3})\b\s*[.):\]]?"  # no. 3, #3
    r"|[(\[]\s*([0-9]{1,3})\s*[)\]]"  # (3)
    r"|([0-9]{1,3})\s*(?:[.):\]]|[-–—](?=\s)))"  # 3. 3) 3: 3 -
    r"\s*(?=[^\s0-9])",
    re.IGNORECASE,
)
_PLAIN = re.compile(r"([0-9]+)\s+(?=[^\s0-9])")
_COLUMN_IN_FRONT = re.compile(r"([0-9]+)\t(?=[^\t]*[^\s0-9][^\t]*(?:\t|$))")
_TRAILING = re.compile(r"[\s,;|]+$")
_APART = (
    re.compile(rf"(.*[^\s,;:(\[])[\s,;:]*[(\[]\s*({_ONE})\s*[)\]]"),  # Ann (560)
    re.compile(rf"(.*[^\s:=+/–—-])\s*(?:[:=–—]|\s-\s|-\s)\s*({_ONE})"),  # Ann: 560, Ann – 560
)
_AFTER_BLANKS = re.compile(r"(.*?[^\s0-9].*?)((?:\s+[0-9](?:[0-9.,]*[0-9])?)+)")
_LEFT_OVER = re.compile(
    r"[;|\t=±]|\+/-|[0-9]\s*[,:]|[,:]\s*[0-9]|[(\[]\s*[0-9]|\s[-–—]+\s*[0-9]|^[0-9]{3}"
)


@dataclass(frozen=True)
class TypedLine:
    """A line: where it is, the name, the numbers after it, and how they were set apart.

    Parameters
    ----------
    number
        of the line.
    name
        what is left without the numbers that are set apart by a sign.
    cells
        the numbers after the name.
    front
        the number in front of the name, None if there is none.
    after_blank
        whether a mere blank sets the numbers apart.
    joined
        whether only a comma stands between a number in the name and the next: 92,5 or 1,612.
    """

    number: int
    name: str
    cells: tuple[str, ...] = ()
    front: int | None = None
    after_blank: bool = False
    joined: bool = False

    @property
    def left_over(self) -> bool:
        """Whether there are signs of a list in the name, or a number could be two: 1,612."""
        several = self.joined and re.search(r"\s[0-9]+\s+[0-9]+$", self.name)
        grouped = self.after_blank and not all(re.fullmatch(_ONE, cell) for cell in self.cells)
        return bool(_LEFT_OVER.search(self.name) or several or grouped)

    def split_at_blanks(self, most: int) -> TypedLine:
        """Return the line with up to so many numbers after blanks set apart from its name.

        >>> TypedLine(1, "Ann Lee 612").split_at_blanks(1).cells
        ('612',)
        """
        text = f"{self.name},{self.cells[0]}" if self.joined else self.name
        parts = None if self.cells and not self.joined else _AFTER_BLANKS.fullmatch(text)
        cells = tuple(parts[2].split()) if parts else ()
        if parts is None or len(cells) > most:
            return self
        return replace(
            self, name=parts[1].rstrip(" ,;:/"), cells=cells, after_blank=True, joined=False
        )


def typed_line(number: int, text: str, most: int, *, numbered: bool = False) -> TypedLine:
    """Return what a line says.

    Parameters
    ----------
    number
        of the line.
    text
        the line.
    most
        how many numbers may follow a name.
    numbered
        whether a number in front needs no sign after it, as all lines have one.

    >>> found = typed_line(1, "2) Łukasz Żak - 620", 1)
    >>> found.front, found.name, found.cells
    (2, 'Łukasz Żak', ('620',))
    >>> typed_line(1, "LEE, Ann (560)", 1).name
    'LEE, Ann'
    """
    rest = _AROUND.sub("", re.sub(r"[^\S\t]+", " ", text))
    front = None
    rest = _TRAILING.sub("", rest)  # an empty cell after the last that is filled
    number_in_front = (
        _MARKED.match(rest)
        or _COLUMN_IN_FRONT.match(rest)
        or (_PLAIN.match(rest) if numbered else None)
    )
    if number_in_front:
        front, rest = (
            int(next(filter(None, number_in_front.groups()))),
            rest[number_in_front.end() :],
        )
    name, cells, joined = _apart(rest.strip(), most)
    # A column in between is no part of the name, and clean_name would hide where it began.
    clean = "\t".join(map(clean_name, name.split("\t")))
    return TypedLine(number, clean, cells, front, joined=joined)


def _apart(text: str, most: int) -> tuple[str, tuple[str, ...], bool]:
    """Return the name, the numbers that a sign sets apart from it, and whether they may be one."""
    for separator in "\t;|,":
        name, *cells = (cell.strip() for cell in text.split(separator))
        if cells and len(cells) <= most and all(not c or re.fullmatch(_NUMBER, c) for c in cells):
            joined = separator == "," and bool(re.search(r"\s[0-9]+,[0-9.]+$", text))
            return name, tuple(cells), joined
    for pattern in _APART:
        if parts := pattern.fullmatch(text):
            return parts[1], (parts[2],), False
    return text, (), False


_RATING_DIGITS = 3
"""A number after a blank that is as long as this is a rating rather than part of a name."""

_HIGHEST_PLACE = 256
"""A number in front of a name that is higher than this is no place on a list."""

_LONGEST_LINE = 1000
"""Letters of a line: far more than a name and its numbers have."""

_WRITE_IT = say(
    "write a player on each line, such as Ann Lee,612, or make player,rating the first line"
)


def read_players(
    path: str | Path, schema: Schema, *, numbers: Sequence[str] = ("rating",)
) -> TextTable:
    r"""Read a list of players: a table with a header, or a player on each line.

    Parameters
    ----------
    path
        the file; '-' is standard input, which must have a header.
    schema
        the columns of the table; `player` is among them.
    numbers
        the columns of the numbers that may follow a name on its line, in this order.

    Raises
    ------
    DataError
        as `read_table` does.

    >>> import tempfile, pathlib
    >>> from evenbreak.files.tables.schema import Text
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "tonight.txt"
    ...     _ = path.write_text("Ann Lee, 612\nBo Diaz 540\n\nCy\n")
    ...     table = read_players(path, Schema("players", player=Text(), rating=Text()))
    >>> table.cells("player"), table.cells("rating"), table.lines
    (['Ann Lee', 'Bo Diaz', 'Cy'], ['612', '540', ''], array([1, 2, 4]))
    """
    if str(path) == "-":
        return schema.text(path)
    source, content = content_of(path)
    if is_spreadsheet(content):
        return schema.text(path)
    text = text_of(content, source)
    lines = text.read().splitlines()
    header = schema.header()
    if _has_header(lines, header):
        return schema.text(path)
    problems = Problems(source)
    most = len(numbers)
    for number, line in enumerate(lines, 1):
        if len(line) > _LONGEST_LINE:
            problems.add(
                number,
                "{line} has {n:,} letters, which is no name; {remedy}",
                line=quoted(line),
                n=len(line),
                remedy=_WRITE_IT,
            )
    typed = _lines([line if len(line) <= _LONGEST_LINE else "" for line in lines], most)
    warnings = _fronts(typed, problems)
    rows = _with_numbers_after_blanks(typed, most)
    _refuse_other_text(rows, problems)
    if not rows and not len(problems):
        problems.add(None, "names nobody; write one player on each line")
    columns = {name: Texts.of([""] * len(rows)) for name in schema.columns}
    columns["player"] = Texts.of([row.name for row in rows])
    for k, name in enumerate(numbers):
        columns[name] = Texts.of([row.cells[k] if k < len(row.cells) else "" for row in rows])
    stated = {name for name in numbers if any(columns[name].distinct)}
    return TextTable(
        source,
        np.array([row.number for row in rows], dtype=np.int64),
        columns,
        frozenset({"player", *stated}),
        problems,
        (*text.warnings, *warnings, *_doubts(rows, source)),
        fingerprint(content),
        {name: name for name in ("player", *stated)},
    )


def _has_header(lines: Sequence[str], header: Header) -> bool:
    """Return whether the first line that is not empty has a title by which players are known."""
    first = next((line for line in lines if line.strip()), "")
    return any(
        header.has("player", header.places(first.split(separator), 1, Problems(""))[0])
        for separator in ",;\t"
    )


def _lines(lines: Sequence[str], most: int) -> list[TypedLine]:
    """Return the lines that are not empty; a number in front needs no sign if all have one."""

    def read(*, numbered: bool) -> list[TypedLine]:
        every = (typed_line(k, text, most, numbered=numbered) for k, text in enumerate(lines, 1))
        return [row for row in every if row.name]

    rows = read(numbered=True)
    counted = [row.front for row in rows] == list(range(1, len(rows) + 1))
    return rows if counted else read(numbered=False)


def _fronts(rows: Sequence[TypedLine], problems: Problems) -> list[str]:
    """Return a warning if places in front of the names are left out; refuse what is no place."""
    numbered = [row for row in rows if row.front is not None]
    fronts = [row.front or 0 for row in numbered]
    if fronts == list(range(1, len(fronts) + 1)):
        return []
    if fronts != sorted(set(fronts)) or fronts[-1] > _HIGHEST_PLACE:
        first = next(
            row
            for k, row in enumerate(numbered)
            if fronts[k] > _HIGHEST_PLACE or (k and fronts[k] <= fronts[k - 1])
        )
        problems.add(
            first.number,
            "the number {n} in front of {name} is no place in that order; sort the lines or leave "
            "the numbers out, and {remedy}",
            n=first.front,
            name=quoted(first.name),
            remedy=_WRITE_IT,
        )
        return []
    first = numbered[0]
    left_out = say(
        "the number {n} in front of {name} is left out, and so are the others; the order is that "
        "of the lines",
        n=first.front,
        name=quoted(first.name),
    )
    return [warning(problems.source, first.number, left_out)]


def _with_numbers_after_blanks(rows: list[TypedLine], most: int) -> list[TypedLine]:
    """Return the lines, those with a rating after a blank split: Ann Lee 612, but not Player 7."""
    split = [row.split_at_blanks(most) for row in rows]
    if not all(row.cells for row in split):
        split = [
            after if len(after.cells and after.cells[0]) >= _RATING_DIGITS else row
            for row, after in zip(rows, split, strict=True)
        ]
    names = Counter(same_name(row.name) for row in split)
    return [
        after if names[same_name(after.name)] == 1 else row
        for row, after in zip(rows, split, strict=True)
    ]


def _refuse_other_text(rows: list[TypedLine], problems: Problems) -> None:
    """Refuse lines that look like a title or a slip, and those that could mean two ratings."""
    rated = any(row.cells for row in rows)
    for row in rows:
        slip = rated and not row.cells and re.search(r",|[0-9]{2}", row.name)
        if row.left_over or slip:
            problems.add(
                row.number,
                "{text} is not a name and a rating; {remedy}",
                text=quoted(row.name),
                remedy=_WRITE_IT,
            )


def _doubts(rows: list[TypedLine], source: str) -> list[str]:
    """Return a warning for each kind of line that could mean something else."""
    kinds: dict[str, list[tuple[int, str]]] = {}
    for row in (row for row in rows if not row.left_over):
        rating, quote = row.cells[0] if row.cells else "", quoted(row.name)
        if row.after_blank:
            doubt = say(
                "{text} is read as {name} with the rating {rating}",
                text=quoted(f"{row.name} {rating}"),
                name=row.name,
                rating=rating,
            )
            kinds.setdefault("split", []).append((row.number, doubt))
        elif re.search(r"^\W*[0-9]" if row.cells else r"[0-9()\[\]]", row.name):
            doubt = say("{name} is taken as a name", name=quote)
            kinds.setdefault("name", []).append((row.number, doubt))
        if rating and float(rating.replace(",", ".")) <= 0:
            doubt = say(
                "{name} has the rating {rating}; leave it out if it means none",
                name=quote,
                rating=rating,
            )
            kinds.setdefault("low", []).append((row.number, doubt))
    return [
        warning(source, line, "{doubt}, and so are {n} more", doubt=doubt, n=len(others))
        if others
        else warning(source, line, doubt)
        for (line, doubt), *others in kinds.values()
    ]
