"""Reading a list of players from a file: a table with a header, or one player per line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from evenbreak.files.lists.pasted import Reading, choice_words, readings
from evenbreak.files.tables.header import Header
from evenbreak.files.tables.problems import Problems, quoted, warning
from evenbreak.files.tables.rows import content_of, fingerprint, is_spreadsheet, text_of
from evenbreak.files.tables.schema import Schema
from evenbreak.files.tables.table import Texts, TextTable
from evenbreak.words import say

_LONGEST_LINE = 1000
"""The longest line read, in characters: far longer than a name and its numbers."""

_WRITE_IT = say(
    "Write one player per line, such as Ann Lee,612, or make player,rating the first line."
)


def read_players(
    path: str | Path, schema: Schema, *, numbers: Sequence[str] = ("rating",)
) -> TextTable:
    r"""Read a list of players: a table with a header, or one player per line.

    `numbers` are the columns for the numbers that may follow a name, in order. Standard input, '-',
    must have a header. Raises DataError as `read_table` does.

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
    if has_header(lines, header):
        return schema.text(path)
    problems = Problems(source)
    most = len(numbers)
    for number, line in enumerate(lines, 1):
        if len(line) > _LONGEST_LINE:
            problems.add(
                number,
                "{line} has {n:,} characters, too many for a name. {remedy}",
                line=quoted(line),
                n=len(line),
                remedy=_WRITE_IT,
            )
    read = readings([line if len(line) <= _LONGEST_LINE else "" for line in lines], most)
    for one in read:
        if one.doubt:
            problems.add(one.number, doubt_words(one))
    rows = [(one.number, player) for one in read for player in one.players]
    if not rows and not len(problems):
        problems.add(None, "has no names. Write one player per line.")
    columns = {name: Texts.of([""] * len(rows)) for name in schema.columns}
    columns["player"] = Texts.of([player.name for _, player in rows])
    for k, name in enumerate(numbers):
        cells = [player.cells[k] if k < len(player.cells) else "" for _, player in rows]
        columns[name] = Texts.of(cells)
    stated = {name for name in numbers if any(columns[name].distinct)}
    return TextTable(
        source,
        np.array([number for number, _ in rows], dtype=np.int64),
        columns,
        frozenset({"player", *stated}),
        problems,
        (*text.warnings, *_left_out(read, source)),
        fingerprint(content),
        {name: name for name in ("player", *stated)},
    )


def has_header(lines: Sequence[str], header: Header) -> bool:
    """Return whether the first nonempty line has a title used for players."""
    first = next((line for line in lines if line.strip()), "")
    return any(
        header.has("player", header.places(first.split(separator), 1, Problems(""))[0])
        for separator in ",;\t"
    )


def typed_lines(content: bytes, schema: Schema) -> list[str] | None:
    r"""Return the lines of a list without a header; None if it is a table or a workbook.

    >>> from evenbreak.files.lists.roster import ROSTER
    >>> typed_lines(b"Ann Lee 612\nBo", ROSTER), typed_lines(b"player,rating\nAnn,612", ROSTER)
    (['Ann Lee 612', 'Bo'], None)
    """
    if is_spreadsheet(content):
        return None
    lines = text_of(content, "").read().splitlines()
    too_long = any(len(line) > _LONGEST_LINE for line in lines)
    return None if too_long or has_header(lines, schema.header()) else lines


def doubt_words(one: Reading) -> str:
    """Return why a line is doubtful, and how to write each possible meaning.

    >>> doubt_words(readings(["Ann Lee 612 Downtown", "Bo"])[0])
    "'Ann Lee 612 Downtown': this may be more than a name and a rating. Write: Ann Lee, 612."
    """
    clear = [choice_words(choice) for choice in one.choices if choice]
    if not clear or not one.players:
        return one.doubt
    text, doubt = quoted(one.text), one.doubt
    return say("{text}: {doubt}. Write: {clear}.", text=text, doubt=doubt, clear=clear[0])


def _left_out(read: Sequence[Reading], source: str) -> list[str]:
    """Return the lines that aren't players, and the players that may be misread."""
    found: list[str] = []
    for one in read:
        for player in one.players:
            rating = player.cells[0] if player.cells else ""
            if rating and float(rating.replace(",", ".")) <= 0:
                low = say(
                    "{name} has a rating of {rating}. Leave it out if it means no rating.",
                    name=quoted(player.name),
                    rating=rating,
                )
                found.append(warning(source, one.number, low))
        if not one.players and not one.doubt:
            title = say(
                "{text} was left out, because it looks like a heading", text=quoted(one.text)
            )
            found.append(warning(source, one.number, title))
    numbered = [one for one in read if one.front is not None]
    if [one.front for one in numbered] != list(range(1, len(numbered) + 1)):
        first = numbered[0]
        left_out = say(
            "the numbers in front of names, such as the {n} before {name}, were left out; the "
            "players are in the order of the lines",
            n=first.front,
            name=quoted(first.players[0].name),
        )
        found.append(warning(source, first.number, left_out))
    return found
