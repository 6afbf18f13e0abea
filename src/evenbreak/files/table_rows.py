"""Where the table of a file begins: its header, the rows below, and what stands above.

A CSV file, a workbook and the export of another program all become rows here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain
from typing import NamedTuple

from evenbreak.files.csv_rows import Rows, csv_rows, first_rows
from evenbreak.files.encoding import text_of
from evenbreak.files.header import Header, quoted_list
from evenbreak.files.problems import quoted
from evenbreak.files.spreadsheet import Sheet, is_spreadsheet, sheets_of

SAMPLE = 2000
"""How many rows are looked at to guess what the columns are."""


class Export(NamedTuple):
    """The matches in a file that another program saved.

    Parameters
    ----------
    sheet
        a header and a row for each match; their lines count the matches.
    warnings
        what was left out or changed, a line each.
    """

    sheet: Sheet
    warnings: list[str]


class TableRows(NamedTuple):
    """The rows of a file, from the header on.

    Parameters
    ----------
    titles, line
        the header, and the line where it begins; no titles where the file has no rows.
    body
        the rows below it.
    unreadable
        the lines that cannot be split into cells; complete once `body` has been used up.
    warnings
        what to know about how the file was read, a line each.
    sample
        the first rows below the header.
    """

    titles: list[str]
    line: int
    body: Iterator[Rows]
    unreadable: list[int]
    warnings: list[str]
    sample: list[list[str]]


def table_rows(
    content: bytes,
    source: str,
    header: Header,
    exported: Callable[[bytes, str], Export | None] | None = None,
) -> TableRows:
    """Return the rows of a file, whatever format it has.

    Parameters
    ----------
    content, source
        its bytes, and what it is called in messages.
    header
        what is looked for.
    exported
        reads the exports of other programs; None for what is no such file.

    Raises
    ------
    DataError
        if the file holds no table at all.
    """
    if is_spreadsheet(content):
        return _of_workbook(sheets_of(content, source), source, header)
    export = None if exported is None else exported(content, source)
    if export is not None:
        rows = _of_sheet(export.sheet, source, header)
        return rows._replace(warnings=[*export.warnings, *rows.warnings])
    return _of_text(content, source, header)


def _of_text(content: bytes, source: str, header: Header) -> TableRows:
    body, encoding, warnings = text_of(content, source)
    tried = first_rows(body, encoding)
    fits = {separator: header.best(rows) for separator, (_, rows) in tried.items()}
    separator = max(fits, key=fits.__getitem__)
    unreadable: list[int] = []
    parts = csv_rows(body, encoding, separator, unreadable)
    lines, rows = next(parts)
    if not rows:
        return TableRows([], 0, parts, unreadable, warnings, [])
    at = -fits[separator].above
    # What cannot be split is no problem above the header.
    unreadable[:] = [line for line in unreadable if line > lines[at]]
    below = chain([(lines[at + 1 :], rows[at + 1 :])], parts)
    warnings += _skipped(lines[: at + 1], rows[:at], source)
    return TableRows(
        rows[at], lines[at], below, unreadable, warnings, rows[at + 1 : at + 1 + SAMPLE]
    )


def _of_workbook(sheets: list[Sheet], source: str, header: Header) -> TableRows:
    """Return the rows of the first sheet whose header fits."""
    fits = [header.best(sheet.rows) for sheet in sheets]
    complete = [sheet for sheet, fit in zip(sheets, fits, strict=True) if fit.complete]
    likely = max(zip(sheets, fits, strict=True), key=lambda pair: pair[1].known)[0]
    sheet = complete[0] if complete else likely
    rows = _of_sheet(sheet, source, header)
    if len(complete) < 2:
        return rows
    others = quoted_list([other.name for other in complete[1:]])
    also, it = ("has", "it") if len(complete) == 2 else ("have", "them")
    warning = (
        f"{source}: only the sheet {quoted(sheet.name)} is read, although {others} {also} such a "
        f"table too; to read {it}, save each sheet as a file of its own"
    )
    return rows._replace(warnings=[warning, *rows.warnings])


def _of_sheet(sheet: Sheet, source: str, header: Header) -> TableRows:
    at = -header.best(sheet.rows).above
    lines, rows = sheet.lines, sheet.rows
    below: Rows = lines[at + 1 :], rows[at + 1 :]
    warnings = _skipped(lines[: at + 1], rows[:at], source)
    return TableRows(rows[at], lines[at], iter([below]), [], warnings, below[1][:SAMPLE])


def _skipped(lines: list[int], rows: list[list[str]], source: str) -> list[str]:
    """Return a note of the rows above the header, whose line is the last of `lines`."""
    texts = [" ".join(filter(None, map(str.strip, row))) for row in rows]
    if not any(texts):
        return []
    above = "the line above it is" if len(rows) == 1 else f"{len(rows)} lines above it are"
    shown = quoted_list([text for text in texts if text])
    return [f"{source}:{lines[-1]}: the header is in this line; {above} not used: {shown}"]
