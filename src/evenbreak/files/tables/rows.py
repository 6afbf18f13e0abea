"""A file's rows, from its bytes: text in any encoding, CSV, workbooks, other programs' files.

Whatever its format, a file becomes a header and rows of cells here, each with its line.
"""

from __future__ import annotations

import codecs
import csv
import hashlib
import io
import json
import os
import re
import stat
import subprocess
import sys
from collections.abc import Callable, Iterator
from itertools import chain
from pathlib import Path
from typing import BinaryIO, NamedTuple, TypeAlias

from evenbreak.errors import DataError
from evenbreak.files.tables import workbook
from evenbreak.files.tables.header import Fit, Header
from evenbreak.files.tables.problems import (
    form_warning,
    printable,
    quoted,
    quoted_list,
    refusal,
    warning,
)
from evenbreak.words import say_count

MAGIC = {
    b"\xd0\xcf\x11\xe0": "an old or locked Excel workbook. Save it as .xlsx without a password.",
    b"%PDF": "a PDF document. Save the table as CSV or .xlsx.",
    b"\x89PNG": "a picture. Save the table as CSV or .xlsx.",
    b"\xff\xd8\xff": "a picture. Save the table as CSV or .xlsx.",
    b"<!DOCTYPE": "a web page. Save the table as CSV or .xlsx.",
    b"<html": "a web page. Save the table as CSV or .xlsx.",
}


MOST_BYTES = 256 << 20
"""The largest file held in memory: some five million matches."""

PIECE = 1 << 20
"""How much of a larger file is read at a time."""

Content: TypeAlias = bytes | Path
"""A file's content: its bytes, or if it's larger than `MOST_BYTES`, the file itself."""


class Text(NamedTuple):
    """A file's text; `warnings` says whether its encoding was a guess."""

    body: Content
    encoding: str
    warnings: list[str]

    def read(self) -> str:
        """Return all of the content."""
        with _stream(self.body) as stream:
            return stream.read().decode(self.encoding)


def content_of(path: str | Path) -> tuple[str, bytes]:
    """Return what messages call a file, and its bytes; '-' is standard input.

    Raises DataError if there is no such file, or if it is larger than any league's list.
    """
    source, content = table_content(path)
    if isinstance(content, Path):
        raise _too_large(source)
    return source, content


def table_content(path: str | Path) -> tuple[str, Content]:
    """Return the same for a file that may be too large to hold in memory."""
    if str(path) == "-":
        if sys.stdin is None:
            raise refusal("stdin", "is closed. Name a file, or pipe one into the command.")
        return "stdin", _no_larger(sys.stdin.buffer.read(MOST_BYTES + 1), "stdin")
    source = printable(str(path))
    try:
        with Path(path).open("rb") as file:
            # What is no file proper, such as a pipe, may have no end.
            state = os.fstat(file.fileno())
            if stat.S_ISREG(state.st_mode) and state.st_size > MOST_BYTES:
                return source, Path(path)
            content = file.read(MOST_BYTES + 1)
    except FileNotFoundError:
        raise refusal(source, "there's no such file. Check its name.") from None
    except IsADirectoryError:
        raise refusal(source, "is a folder. Name a file in it.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise refusal(source, "can't be read ({reason}). Check the file.", reason=reason) from None
    return source, _no_larger(content, source)


def _no_larger(content: bytes, source: str) -> bytes:
    if len(content) > MOST_BYTES:
        raise _too_large(source)
    return content


def _too_large(source: str) -> DataError:
    return refusal(
        source,
        "is larger than {most} MB. Name a table saved as CSV, which may be larger, or split it up.",
        most=MOST_BYTES >> 20,
    )


def _stream(content: Content) -> BinaryIO:
    return io.BytesIO(content) if isinstance(content, bytes) else content.open("rb")


def pieces_of(content: Content) -> Iterator[bytes]:
    """Yield a file's content, piece by piece."""
    if isinstance(content, bytes):
        yield content
        return
    with _stream(content) as stream:
        while piece := stream.read(PIECE):
            yield piece


def fingerprint(content: Content) -> str:
    """Return the SHA-256 of a file's content."""
    made = hashlib.sha256()
    for piece in pieces_of(content):
        made.update(piece)
    return made.hexdigest()


def head_of(content: Content) -> bytes:
    """Return the beginning of a file's content."""
    if isinstance(content, bytes):
        return content[:1024]
    with content.open("rb") as stream:
        return stream.read(1024)


def text_of(content: Content, source: str) -> Text:
    r"""Return a file's text: UTF-8, UTF-16 with a byte order mark, or else Windows-1252.

    Raises DataError if there is no text.

    >>> text_of("\ufeffZoë".encode("utf-16-be"), "r.csv").read()
    'Zoë'
    """
    head = head_of(content)
    for magic, kind in MAGIC.items():
        if head.startswith(magic):
            raise refusal(source, "is {kind}", kind=kind)
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encoding = "utf-16"
        wrong, nul, blank = _looked_through(content, encoding)
        if wrong:
            raise refusal(source, "is damaged UTF-16 text. Save the file again, in UTF-8.")
    else:
        encoding = "utf-8-sig"
        wrong, nul, blank = _looked_through(content, encoding)
    if nul:
        raise refusal(source, "holds a NUL byte. Save the file as CSV, in UTF-8.", nul)
    warnings: list[str] = []
    if wrong:
        # After the mark of UTF-8 a byte that is not UTF-8 is damage, not another encoding.
        encoding = "ascii" if head.startswith(codecs.BOM_UTF8) else "cp1252"
        also, _, blank = _looked_through(content, encoding)
        if also:
            raise refusal(source, "is neither UTF-8 nor Windows-1252 text. Save it as UTF-8.", also)
        warnings = [
            form_warning(
                source, wrong, "isn't UTF-8. It was read as Windows-1252, so check the accents."
            )
        ]
    if blank:
        raise refusal(source, "is empty. Write a header line, then one line for each row.")
    return Text(content, encoding, warnings)


def _looked_through(content: Content, encoding: str) -> tuple[int, int, bool]:
    """Return the lines of the first undecodable byte and the first NUL, and whether it's empty.

    A line is 0 if there is none. The whole file is searched for NULs, whatever else is wrong.
    """
    decoder = codecs.getincrementaldecoder(encoding)()
    wide = encoding == "utf-16"
    wrong = nul = before = 0
    blank = True
    for piece in chain(pieces_of(content), [b""]):
        text = ""
        if not wrong:
            try:
                text = decoder.decode(piece, final=not piece)
            except UnicodeDecodeError as error:
                wrong = before + error.object[: error.start].count(b"\n") + 1
        blank = blank and not text.strip()
        if not nul and ("\0" in text if wide else b"\0" in piece):
            above = text.partition("\0")[0] if wide else piece.partition(b"\0")[0].decode("latin-1")
            nul = before + above.count("\n") + 1
        before += text.count("\n") if wide else piece.count(b"\n")
    return wrong, nul, blank


ROWS_AT_A_TIME = 1024  # few enough to stay in the processor's cache
SEPARATORS = (",", ";", "\t")

Rows = tuple[list[int], list[list[str]]]
"""Some rows: the line where each starts, and its cells."""

_DECLARED = re.compile(rb'(?:\xef\xbb\xbf)?"?sep=([^\w\s"\x80-\xff]|\t)"?[ \t]*(?=[\r\n])', re.I)
"""A first line with which Excel declares the separator, such as sep=;"""


def first_rows(content: Content, encoding: str) -> dict[str, Rows]:
    """Return the first rows for each separator, or only for the one that a first line declares."""
    declared = _declared(content, encoding)
    separators = (declared[1].decode(),) if declared else SEPARATORS
    return {separator: next(csv_rows(content, encoding, separator, [])) for separator in separators}


def _declared(content: Content, encoding: str) -> re.Match[bytes] | None:
    """Return the first line, if it declares the separator."""
    head = head_of(content)
    if encoding == "utf-16":
        head = head[: len(head) // 2 * 2].decode(encoding, "ignore").encode("utf-8", "ignore")
    return _DECLARED.match(head)


def csv_rows(
    content: Content, encoding: str, separator: str, unreadable: list[int]
) -> Iterator[Rows]:
    """Yield the rows that aren't blank, `ROWS_AT_A_TIME` at a time.

    Lines that can't be split into cells are added to `unreadable`. A first line that declares the
    separator is read as a blank line, so that lines keep their numbers.
    """
    declared = _declared(content, encoding)
    lines: list[int] = []
    rows: list[list[str]] = []
    line = 1
    ended = False
    with io.TextIOWrapper(_stream(content), encoding=encoding, newline="") as text:
        if declared:
            text.read(len(declared[0].decode("utf-8-sig")))
        reader = csv.reader(text, delimiter=separator, skipinitialspace=True, strict=True)
        while not ended:
            try:
                for row in reader:
                    if any(row):
                        lines.append(line)
                        rows.append(row)
                    line = reader.line_num + 1
                    if len(rows) == ROWS_AT_A_TIME:
                        yield lines, rows
                        lines, rows = [], []
                ended = True
            except csv.Error:
                unreadable.append(line)
                line = reader.line_num + 1
    yield lines, rows


PATIENCE = 60.0
"""How many seconds reading a workbook may take."""

_ZIP = b"PK\x03\x04"


class Sheet(NamedTuple):
    """A sheet's nonblank rows, with their line numbers from 1 up."""

    name: str
    lines: list[int]
    rows: list[list[str]]


def is_spreadsheet(content: bytes) -> bool:
    """Return whether a file may be a workbook: a zip archive."""
    return content.startswith(_ZIP)


def sheets_of(content: bytes, source: str) -> list[Sheet]:
    """Return a workbook's visible sheets, except empty ones.

    Numbers are written as they are (1500, not 1500.0), dates as 2024-09-03, times of day as 7:05,
    which is what a spreadsheet makes of a score of 7:5. It is read in a separate process, so that a
    workbook that uses up all the memory ends only that process. Raises DataError if the file isn't
    a workbook, or is damaged, locked, too large, or empty.
    """
    # -I and -S: nothing from the current folder or the environment is imported there.
    bundled = getattr(sys, "frozen", False)  # there is no Python but the program itself
    how = [workbook.AS_READER] if bundled else ["-I", "-S", workbook.__file__]
    words = [sys.executable, *how, str(workbook.MOST_MEMORY), *sys.path]
    try:
        done = subprocess.run(  # noqa: S603
            words, input=content, capture_output=True, timeout=PATIENCE, check=True
        )
        answer = json.loads(done.stdout)
    except (subprocess.SubprocessError, MemoryError):
        answer = {"problem": workbook.TOO_MUCH}
    except OSError as error:
        answer = {"problem": f"can't be read now ({error.strerror}). Try again."}
    if "problem" in answer:
        raise refusal(source, answer["problem"])
    sheets = [Sheet(*sheet) for sheet in answer["sheets"] if sheet[2]]
    if not sheets:
        raise refusal(source, "has no sheet with anything in it. Write a header and rows.")
    return sheets


SAMPLE = 2000
"""How many rows are used to guess what the columns are."""


class Export(NamedTuple):
    """The matches in a file saved by another program; their line numbers count matches."""

    sheet: Sheet
    warnings: list[str]


class TableRows(NamedTuple):
    """A file's rows, starting with the header; no titles if it has no header.

    `unreadable` are lines that can't be split into cells, complete once `body` is used up.
    """

    titles: list[str]
    line: int
    body: Iterator[Rows]
    unreadable: list[int]
    warnings: list[str]
    sample: list[list[str]]


def table_rows(
    content: Content,
    source: str,
    header: Header,
    exported: Callable[[bytes, str], Export | None] | None = None,
) -> TableRows:
    """Return the rows of a file in any format; raise DataError if it holds no table.

    `exported` reads other programs' exports, and returns None for other files.
    """
    if isinstance(content, Path):
        # Only a table of text can be read piece by piece.
        if head_of(content).removeprefix(codecs.BOM_UTF8).lstrip().startswith((_ZIP, b"{", b"[")):
            raise _too_large(source)
        return _of_text(content, source, header)
    if is_spreadsheet(content):
        return _of_workbook(sheets_of(content, source), source, header)
    export = None if exported is None else exported(content, source)
    if export is not None:
        rows = _of_sheet(export.sheet, source, header)
        return rows._replace(warnings=[*export.warnings, *rows.warnings])
    return _of_text(content, source, header)


def _of_text(content: Content, source: str, header: Header) -> TableRows:
    body, encoding, warnings = text_of(content, source)
    tried = first_rows(body, encoding)
    fits = {separator: header.best(rows) for separator, (_, rows) in tried.items()}
    separator = max(fits, key=fits.__getitem__)
    unreadable: list[int] = []
    parts = csv_rows(body, encoding, separator, unreadable)
    lines, rows = next(parts)
    if not rows:
        return TableRows([], 0, parts, unreadable, warnings, [])
    fit = fits[separator]
    line, below = lines[fit.below - 1], fit.below
    # What cannot be split is no problem above the header.
    unreadable[:] = [one for one in unreadable if one > line]
    body_rows = chain([(lines[below:], rows[below:])], parts)
    warnings += _skipped(lines, rows, fit, source)
    titles, sample = [*header.titles(rows, fit)], rows[below : below + SAMPLE]
    return TableRows(titles, line, body_rows, unreadable, warnings, sample)


def _of_workbook(sheets: list[Sheet], source: str, header: Header) -> TableRows:
    """Return the rows of the first sheet whose header fits."""
    fits = [header.best(sheet.rows) for sheet in sheets]
    complete = [sheet for sheet, fit in zip(sheets, fits, strict=True) if fit.complete]
    likely = max(zip(sheets, fits, strict=True), key=lambda pair: pair[1].known)[0]
    sheet = complete[0] if complete else likely
    rows = _of_sheet(sheet, source, header)
    if len(complete) < 2:
        return rows
    also = say_count(
        "only sheet {sheet} is read, although {others} has a table like it; to read that one "
        "too, save each sheet as its own file",
        "only sheet {sheet} is read, although {others} have tables like it; to read those too, "
        "save each sheet as its own file",
        len(complete) - 1,
        sheet=quoted(sheet.name),
        others=quoted_list([another.name for another in complete[1:]]),
    )
    return rows._replace(warnings=[warning(source, None, also), *rows.warnings])


def _of_sheet(sheet: Sheet, source: str, header: Header) -> TableRows:
    fit = header.best(sheet.rows)
    lines, rows = sheet.lines, sheet.rows
    below: Rows = lines[fit.below :], rows[fit.below :]
    warnings = _skipped(lines, rows, fit, source)
    titles, line = [*header.titles(rows, fit)], lines[fit.below - 1]
    return TableRows(titles, line, iter([below]), [], warnings, below[1][:SAMPLE])


def _skipped(lines: list[int], rows: list[list[str]], fit: Fit, source: str) -> list[str]:
    """Return a note about the rows above the header."""
    rows = rows[: -fit.above]
    texts = [" ".join(filter(None, map(str.strip, row))) for row in rows]
    if not any(texts):
        return []
    header = say_count(
        "the header is in this line; the line above it was ignored: {texts}",
        "the header is in this line; {n} lines above it were ignored: {texts}",
        len(rows),
        texts=quoted_list([text for text in texts if text]),
    )
    return [form_warning(source, lines[len(rows)], header)]
