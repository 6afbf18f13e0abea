"""Text as rows of cells: which separator it uses, and in which line each row begins."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator

ROWS_AT_A_TIME = 1024  # few enough to stay in the processor's cache
SEPARATORS = (",", ";", "\t")

Rows = tuple[list[int], list[list[str]]]
"""Some rows: the line in which each begins, and its cells."""

_DECLARED = re.compile(rb'(?:\xef\xbb\xbf)?"?sep=([^\w\s"\x80-\xff]|\t)"?[ \t]*(?=[\r\n])', re.I)
"""A first line with which Excel declares the separator, such as sep=;"""


def first_rows(content: bytes, encoding: str) -> dict[str, Rows]:
    """Return the first rows by each separator; by one only where a first line declares it."""
    declared = _DECLARED.match(content)
    separators = (declared[1].decode(),) if declared else SEPARATORS
    return {separator: next(csv_rows(content, encoding, separator, [])) for separator in separators}


def csv_rows(
    content: bytes, encoding: str, separator: str, unreadable: list[int]
) -> Iterator[Rows]:
    """Yield the rows that are not blank, `ROWS_AT_A_TIME` at once.

    Lines that cannot be split into cells are added to `unreadable`. A first line that declares
    the separator reads as a blank one, so that lines keep their numbers.
    """
    declared = _DECLARED.match(content)
    body = content[declared.end() :] if declared else content
    text = io.TextIOWrapper(io.BytesIO(body), encoding=encoding, newline="")
    reader = csv.reader(text, delimiter=separator, skipinitialspace=True, strict=True)
    lines: list[int] = []
    rows: list[list[str]] = []
    line = 1
    ended = False
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
