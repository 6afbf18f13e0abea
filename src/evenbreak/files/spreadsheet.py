"""The sheets of a workbook (.xlsx or .ods) as rows of text, as a CSV file would have them."""

from __future__ import annotations

import datetime as dt
import io
import re
import zipfile
import zlib
from functools import cache
from typing import Any, NamedTuple

from evenbreak.errors import DataError

MOST_BYTES = 400_000_000
"""The most that a workbook may hold once unpacked."""

MOST_CELLS = 20_000_000
"""The most cells of a sheet, empty ones between others included."""

_ZIP = b"PK\x03\x04"
_CELL = re.compile(rb'<(?:\w+:)?c\b[^>]*?\br="([A-Z]{1,3})([0-9]{1,7})"')
_DAMAGE = (zipfile.BadZipFile, zlib.error, EOFError, ValueError, RuntimeError, OSError)
_UNREADABLE = "cannot be read as a workbook; save it again as .xlsx or .ods, or as CSV"


class Sheet(NamedTuple):
    """The rows of a sheet that are not blank.

    Parameters
    ----------
    name
        what the sheet is called.
    lines
        the number of each row in the sheet, from 1.
    rows
        their cells as text.
    """

    name: str
    lines: list[int]
    rows: list[list[str]]


def is_spreadsheet(content: bytes) -> bool:
    """Return whether a file may be a workbook: a zip archive."""
    return content.startswith(_ZIP)


def sheets_of(content: bytes, source: str) -> list[Sheet]:
    """Return the visible sheets of a workbook that hold anything.

    Numbers are written as they are (1500, not 1500.0), dates as 2024-09-03, times of day as
    7:05, which is what a spreadsheet makes of a score of 7:5.

    Raises
    ------
    DataError
        if the file is no workbook, is damaged or locked, too large, or empty.
    """
    from python_calamine import CalamineWorkbook, SheetTypeEnum, SheetVisibleEnum

    _check_size(content, source)
    try:
        book = CalamineWorkbook.from_filelike(io.BytesIO(content))
        shown = [
            sheet.name
            for sheet in book.sheets_metadata
            if sheet.visible == SheetVisibleEnum.Visible and sheet.typ == SheetTypeEnum.WorkSheet
        ]
        sheets = [_sheet(book.get_sheet_by_name(name)) for name in shown]
    except BaseException as error:  # damage can also end in a PanicException of the reader
        if not isinstance(error, Exception) and type(error).__name__ != "PanicException":
            raise
        raise DataError([f"{source}: {_UNREADABLE}"]) from None
    filled = [sheet for sheet in sheets if sheet.rows]
    if not filled:
        raise DataError([f"{source}: has no sheet with anything in it; write a header and rows"])
    return filled


def _check_size(content: bytes, source: str) -> None:
    """Refuse what is no workbook, and one that would fill the memory."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            names, size = archive.namelist(), sum(one.file_size for one in archive.infolist())
            sheets = [name for name in names if name.startswith("xl/worksheets/")]
            far = size <= MOST_BYTES and any(
                _area(archive.read(name)) > MOST_CELLS for name in sheets
            )
    except _DAMAGE:
        raise DataError([f"{source}: {_UNREADABLE}"]) from None
    if "content.xml" not in names and "[Content_Types].xml" not in names:
        raise DataError(
            [f"{source}: is a zip archive, but no .xlsx or .ods workbook; save it as CSV"]
        )
    if size > MOST_BYTES:
        raise DataError([f"{source}: holds {size:,} bytes once unpacked; save the table as CSV"])
    if far:
        raise DataError([f"{source}: has cells far away from the others; delete them"])


def _area(sheet: bytes) -> int:
    """Return the cells of the rectangle that the cells in the XML of an .xlsx sheet span."""
    cells = [(_column(found[1]), int(found[2])) for found in _CELL.finditer(sheet)]
    if not cells:
        return 0
    columns, rows = zip(*cells, strict=True)
    return int((max(columns) - min(columns) + 1) * (max(rows) - min(rows) + 1))


@cache
def _column(letters: bytes) -> int:
    """Return the number of a column.

    >>> _column(b"A"), _column(b"XFD")
    (1, 16384)
    """
    number = 0
    for letter in letters:
        number = 26 * number + letter - ord("A") + 1
    return number


def _sheet(sheet: Any) -> Sheet:
    first = sheet.start[0] + 1 if sheet.start else 1
    texts = ([_text(cell) for cell in row] for row in sheet.to_python())
    filled = [(line, row) for line, row in enumerate(texts, first) if any(row)]
    return Sheet(sheet.name, [line for line, _ in filled], [row for _, row in filled])


def _text(cell: Any) -> str:
    """Return what a cell would be in a CSV file.

    >>> _text(1500.0), _text(1.234), _text(dt.time(7, 5)), _text(True)
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
