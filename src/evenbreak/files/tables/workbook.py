"""Reading a workbook in a separate process with a memory limit.

`spreadsheet` starts this file as a program. It imports nothing else of this package, so that it
starts in a moment. Before a sheet is opened, all XML in the workbook is scanned, because the reader
makes room for every cell between the first and the last, however few are filled.
"""

from __future__ import annotations

import datetime as dt
import io
import json
import re
import sys
import zipfile
import zlib
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any
from xml.parsers import expat

AS_READER = "--read-workbook"
"""The first argument that makes a bundled program read a workbook."""

MOST_BYTES = 400_000_000
"""The largest size of an unpacked workbook."""

MOST_CELLS = 20_000_000
"""The most cells in a sheet, including empty ones between others."""

MOST_MEMORY = 3 << 29
"""How much memory reading a workbook may use, in bytes, if the system can limit it."""

_MOST_ROWS, _MOST_COLUMNS = 1_048_576, 16_384  # of a sheet in Excel and in LibreOffice
_PIECE = 1 << 16
_CELL = re.compile(r"([A-Za-z]{1,3})([0-9]{1,7})", re.ASCII)
_NUMBER = re.compile(r"[0-9]{1,7}", re.ASCII)
_DAMAGE = (zipfile.BadZipFile, zlib.error, EOFError, ValueError, RuntimeError, OSError)

UNREADABLE = "can't be read as a workbook. Save it again as .xlsx or .ods, or as CSV."
TOO_MUCH = "takes too much memory or time to read. Save the table as CSV."
_FAR = "has cells far away from the others. Delete them."


class UnreadableError(Exception):
    """Why a workbook can't be read."""


def read(content: bytes) -> list[tuple[str, list[int], list[list[str]]]]:
    """Return a workbook's visible sheets: the name, the rows' numbers, their cells as text.

    Raises UnreadableError if it isn't a workbook, is damaged or locked, or would fill the memory.
    """
    from python_calamine import CalamineWorkbook, SheetTypeEnum, SheetVisibleEnum

    _look_through(content)
    try:
        book = CalamineWorkbook.from_filelike(io.BytesIO(content))
        shown = [
            sheet.name
            for sheet in book.sheets_metadata
            if sheet.visible == SheetVisibleEnum.Visible and sheet.typ == SheetTypeEnum.WorkSheet
        ]
        return [_sheet(book.get_sheet_by_name(name)) for name in shown]
    except MemoryError:
        raise
    except BaseException as error:  # damage can also end in a PanicException of the reader
        if not isinstance(error, Exception) and type(error).__name__ != "PanicException":
            raise
        raise UnreadableError(UNREADABLE) from None


def _look_through(content: bytes) -> None:
    """Reject a file that isn't a workbook, or that would fill the memory."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            parts = archive.infolist()
            names, size = {part.filename for part in parts}, sum(part.file_size for part in parts)
            if "content.xml" not in names and "[Content_Types].xml" not in names:
                raise UnreadableError(
                    "is a zip archive, but not an .xlsx or .ods workbook. Save it as CSV."
                )
            if "xl/workbook.bin" in names:
                raise UnreadableError("is a binary workbook (.xlsb). Save it as .xlsx or as CSV.")
            if size > MOST_BYTES:
                raise UnreadableError(f"holds {size:,} bytes once unpacked. Save the table as CSV.")
            for part in parts:
                with archive.open(part) as file:
                    _look_at(file, lenient=part.filename.lower().endswith(".vml"))
    except _DAMAGE:
        raise UnreadableError(UNREADABLE) from None


def _look_at(file: Any, *, lenient: bool) -> None:
    """Scan a part of a workbook if it is XML; in old drawings of notes, it may be invalid."""
    piece = file.read(_PIECE)
    if not piece.lstrip(b"\xef\xbb\xbf\xff\xfe\0 \t\r\n").startswith(b"<"):
        return
    bounds = _Bounds()
    try:
        while piece:
            bounds.parser.Parse(piece, False)
            piece = file.read(_PIECE)
        bounds.parser.Parse(b"", True)
    except expat.ExpatError:
        if not lenient:
            raise UnreadableError(UNREADABLE) from None


class _Bounds:
    """Where a sheet's cells are, as its XML is read; rejects cells that are too far away."""

    def __init__(self) -> None:
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.StartDoctypeDeclHandler = self._refuse
        self.elements: dict[str, Callable[[Mapping[str, str]], None]] = {
            "sheetData": self._sheet,
            "row": self._row,
            "c": self._cell,
            "table": self._sheet,
            "table-row": self._row_of_ods,
            "table-cell": self._cell_of_ods,
            "covered-table-cell": self._cell_of_ods,
            "p": self._text_of_ods,
        }
        self._sheet({})
        self.in_sheet = False

    def _refuse(self, *_: object) -> None:
        raise UnreadableError(UNREADABLE)  # a definition may expand to more than was sent

    def _start(self, name: str, attributes: Mapping[str, str]) -> None:
        element = self.elements.get(name if ":" not in name else name.rpartition(":")[2])
        if element is not None:
            element(attributes)

    def _sheet(self, _: Mapping[str, str]) -> None:
        self.in_sheet = True
        self.row = self.column = 0
        self.rows = self.columns = 1  # that the last element stands for
        self.top, self.bottom = _MOST_ROWS, 0
        self.left, self.right = _MOST_COLUMNS, 0

    def _row(self, attributes: Mapping[str, str]) -> None:
        self.row = _number(attributes.get("r"), self.row + 1, _MOST_ROWS)
        self.column = 0

    def _cell(self, attributes: Mapping[str, str]) -> None:
        if not self.in_sheet:
            return
        reference = attributes.get("r")
        if reference is None:
            self.column += 1
        else:
            cell = _CELL.fullmatch(reference)
            if cell is None:
                raise UnreadableError(_FAR if reference[:1].isalpha() else UNREADABLE)
            letters, row = cell.groups()
            self.column, self.row = column_of(letters), int(row)
        self._fill()

    def _row_of_ods(self, attributes: Mapping[str, str]) -> None:
        self.rows = _number(attributes.get("table:number-rows-repeated"), 1, _MOST_ROWS)
        self.row, self.column = self.row + self.rows, 0

    def _cell_of_ods(self, attributes: Mapping[str, str]) -> None:
        self.columns = _number(attributes.get("table:number-columns-repeated"), 1, _MOST_COLUMNS)
        self.column += self.columns
        if any(key.endswith(("value-type", "formula")) for key in attributes):
            self._fill()

    def _text_of_ods(self, _: Mapping[str, str]) -> None:
        if self.in_sheet and self.column:
            self._fill()

    def _fill(self) -> None:
        """Record the filled cells that end here."""
        top, left = self.row - self.rows + 1, self.column - self.columns + 1
        inside = self.top <= top and self.row <= self.bottom
        if inside and self.left <= left and self.column <= self.right:
            return
        self.top, self.bottom = min(self.top, top), max(self.bottom, self.row)
        self.left, self.right = min(self.left, left), max(self.right, self.column)
        area = (self.bottom - self.top + 1) * (self.right - self.left + 1)
        if self.bottom > _MOST_ROWS or self.right > _MOST_COLUMNS or area > MOST_CELLS:
            raise UnreadableError(_FAR)


def _number(text: str | None, usual: int, most: int) -> int:
    """Return a row, or a repeat count, if a sheet can have that many."""
    if text is None:
        return usual
    if not _NUMBER.fullmatch(text) or not 1 <= int(text) <= most:
        raise UnreadableError(_FAR)
    return int(text)


@cache
def column_of(letters: str) -> int:
    """Return a column's number.

    >>> column_of("A"), column_of("XFD")
    (1, 16384)
    """
    number = 0
    for letter in letters.upper():
        number = 26 * number + ord(letter) - ord("A") + 1
    return number


def _sheet(sheet: Any) -> tuple[str, list[int], list[list[str]]]:
    first = sheet.start[0] + 1 if sheet.start else 1
    texts = ([text_of(cell) for cell in row] for row in sheet.to_python())
    filled = [(line, row) for line, row in enumerate(texts, first) if any(row)]
    return sheet.name, [line for line, _ in filled], [row for _, row in filled]


def text_of(cell: Any) -> str:
    """Return what a cell would be in a CSV file.

    >>> text_of(1500.0), text_of(1.234), text_of(dt.time(7, 5)), text_of(True)
    ('1500', '1.2340', '7:05', 'yes')
    """
    match cell:
        case bool():
            return "yes" if cell else "no"
        case float() if cell.is_integer() and abs(cell) < 1e15:
            return str(int(cell))
        case float():
            text = repr(cell)
            # Of three decimals it could not be said whether they group thousands.
            return f"{text}0" if len(text.rpartition(".")[2]) == 3 else text
        case dt.timedelta():
            minutes = int(cell.total_seconds()) // 60
            return f"{minutes // 60}:{minutes % 60:02}"
        case dt.time():
            return f"{cell.hour}:{cell.minute:02}"
        case dt.datetime():
            return cell.date().isoformat()
        case _:
            return str(cell).strip()


def _limit_memory(most: int) -> None:
    if sys.platform == "win32":
        return
    import resource

    try:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    except (OSError, ValueError):  # a lower limit holds already, or this system has none
        return


def main() -> None:
    """Read the workbook from stdin, and write its sheets, or why it can't be read, as JSON."""
    _limit_memory(int(sys.argv[1]))
    sys.path[:] = sys.argv[2:]
    try:
        answer: dict[str, Any] = {"sheets": read(sys.stdin.buffer.read())}
    except UnreadableError as error:
        answer = {"problem": str(error)}
    except MemoryError:
        answer = {"problem": TOO_MUCH}
    json.dump(answer, sys.stdout)


if __name__ == "__main__":
    main()
